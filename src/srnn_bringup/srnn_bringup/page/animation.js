// SPDX-License-Identifier: Apache-2.0
// Plays a run: plan, tip and touches over time. Wants `RUN` with lengths in millimetres.
(() => {
  const canvas = document.getElementById('run');
  const slider = document.getElementById('time');
  const button = document.getElementById('play');
  const clock = document.getElementById('clock');
  const speed = document.getElementById('speed');
  const context = canvas.getContext('2d');
  const size = 1000;
  canvas.width = canvas.height = size;
  const scale = size / (2 * RUN.edge);
  const at = ([x, y]) => [size / 2 + x * scale, size / 2 - y * scale];
  let now = RUN.seconds, playing = false, last = 0;

  function path(points, colour, width) {
    if (points.length < 2) return;
    context.beginPath();
    points.forEach((point, n) => context[n ? 'lineTo' : 'moveTo'](...at(point)));
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.lineJoin = context.lineCap = 'round';
    context.stroke();
  }

  function disc(point, radius, fill, stroke) {
    context.beginPath();
    context.arc(...at(point), radius, 0, 2 * Math.PI);
    if (fill) { context.fillStyle = fill; context.fill(); }
    if (stroke) { context.strokeStyle = stroke; context.lineWidth = 2; context.stroke(); }
  }

  function index(times, time) {
    let low = 0, high = times.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time) low = middle + 1; else high = middle;
    }
    return low;
  }

  function draw() {
    context.clearRect(0, 0, size, size);
    for (const outline of RUN.obstacles) {
      context.beginPath();
      outline.forEach((point, n) => context[n ? 'lineTo' : 'moveTo'](...at(point)));
      context.closePath();
      context.fillStyle = '#8d99ae';
      context.fill();
    }
    for (const point of RUN.waypoints) disc(point, RUN.reach * scale, null, '#adb5bd');
    const until = index(RUN.t, now);
    const recent = index(RUN.t, now - 20);
    path(RUN.tip.slice(0, recent), '#cfe3ea', 4);
    path(RUN.tip.slice(recent, until), '#1f6f8b', 6);
    const plan = RUN.plans[index(RUN.sent, now) - 1];
    if (plan) path(plan, '#e08e45', 5);
    RUN.touches.filter(([time]) => time <= now).forEach(([, x, y]) => {
      const [u, v] = at([x, y]);
      context.strokeStyle = '#c1121f';
      context.lineWidth = 6;
      context.beginPath();
      context.moveTo(u - 12, v - 12); context.lineTo(u + 12, v + 12);
      context.moveTo(u - 12, v + 12); context.lineTo(u + 12, v - 12);
      context.stroke();
    });
    RUN.waypoints.forEach((point, n) => {
      disc(point, 18, '#fff', '#2b2d42');
      context.fillStyle = '#2b2d42';
      context.font = '22px system-ui, sans-serif';
      context.textAlign = 'center';
      context.textBaseline = 'middle';
      context.fillText(n + 1, ...at(point));
    });
    if (until) disc(RUN.tip[until - 1], 12, '#2b2d42');
    clock.textContent = `${now.toFixed(1)} s of ${RUN.seconds.toFixed(1)} s`;
    slider.value = now;
  }

  function step(time) {
    if (!playing) return;
    now = Math.min(now + (time - last) / 1000 * Number(speed.value), RUN.seconds);
    last = time;
    if (now >= RUN.seconds) toggle();
    draw();
    requestAnimationFrame(step);
  }

  function toggle() {
    playing = !playing;
    button.textContent = playing ? 'Pause' : 'Play';
    if (playing) {
      if (now >= RUN.seconds) now = 0;
      last = performance.now();
      requestAnimationFrame(step);
    }
  }

  slider.max = RUN.seconds;
  slider.step = 0.01;
  slider.addEventListener('input', () => { now = Number(slider.value); draw(); });
  button.addEventListener('click', toggle);
  draw();
})();
