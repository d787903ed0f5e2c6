# SPDX-License-Identifier: Apache-2.0
"""Row 22: the arm runs into something that nobody knew of; scored by the true contact force."""

from dataclasses import dataclass

from arm_rig import PERIOD, PHYSICS_PER_TICK, Rig, rig
from moving_arm import EDGE, generator, speeds
import numpy as np
import pytest
from segments import MS, line

from lwr_description import Mount
from lwr_sim_bridge.parameters import ContactParameters
from srnn_msgs_py.result import ResultCode

SIZE = 0.04
SURFACES = {5200: 0.002, 1300: 0.004, 54: 0.02, 9: 0.05}
"""Time constants of contact springs [s] by the stiffness that they are measured to have [N/mm]."""

HARDEST = max(SURFACES)

STILL = 0.005
"""What is slower stands still [m/s]."""


@dataclass(frozen=True)
class Collision:
    """A straight way through the plane with something in it."""

    start: tuple[float, float]
    end: tuple[float, float]
    obstacle: dict[str, object]


def random_collision(rng: np.random.Generator) -> Collision:
    """Return a disc or a box, hit from any side, not always squarely."""
    while True:
        start, angle = rng.uniform(-EDGE, EDGE, 2), rng.uniform(0.0, 2.0 * np.pi)
        ahead = np.array((np.cos(angle), np.sin(angle)))
        way = rng.uniform(0.08, 0.15)
        end = start + (way + 0.12) * ahead
        if np.abs(end).max() < EDGE:
            break
    centre = start + (way + SIZE + Mount().tool_radius) * ahead
    askew = rng.uniform(-0.7, 0.7)
    disc = {'shape': 'disc', 'radius': SIZE,
            'center': (centre + askew * SIZE * np.array((-ahead[1], ahead[0]))).tolist()}
    box = {'shape': 'box', 'size': [2.0 * SIZE, 0.3], 'yaw': float(angle + askew) % np.pi,
           'center': centre.tolist()}  # fmt: skip
    return Collision(tuple(start.tolist()), tuple(end.tolist()), (disc, box)[rng.integers(2)])


def run_into(made: Rig) -> tuple[float, float]:
    """Return when the tool touched first and when the arm was told to stop [s]."""
    touched = None
    while True:
        now = made.arm.time
        tick = made.tracker.tick(now, made.arm.sample(int(now * 1e9)))
        assert made.arm.command(tick.command) is None
        made.tips.append(made.arm.tip_truth)
        made.finished += tick.finished
        for _ in range(PHYSICS_PER_TICK):
            made.arm.step()
            if touched is None and made.arm.truth.peak > 0.0:
                touched = made.arm.time
        if made.finished:
            assert touched is not None, 'stopped without a touch'
            return touched, now


def deadline(speed: float, stiffness: int) -> float:
    """Return the time from the first touch to the command that stops the arm [ms].

    The tip itself gives way by 1 mm for 1.4 N. At 0.1 m/s, 75 ms into a soft surface, it is
    5 mm behind its command at most, and pressed with less than 10 N: nothing to stop for yet.
    """
    if speed < 0.1:
        return 150.0
    return 100.0 if speed < 0.2 and stiffness < 10 else 75.0


@pytest.mark.parametrize('speed', [0.05, 0.1, 0.2, 0.249])
@pytest.mark.parametrize('stiffness', SURFACES)
def test_the_arm_stops_soon_softly_and_for_good(ledger, speed, stiffness):
    """On the hardest surface the force goes with the speed instead: 500 N for each m/s."""
    what = f'contact at {speed:.2f} m/s, {stiffness} N/mm'
    deadline_ms = deadline(speed, stiffness)
    strongest = 500.0 * speed if stiffness == HARDEST else 80.0
    for repeat in range(ledger.repeats):
        course = random_collision(generator(what, repeat))
        with ledger.injection(22, what, bound_ms=deadline_ms) as entry:
            contact = ContactParameters(time_constant=SURFACES[stiffness])
            made = rig([course.obstacle], start=course.start, contact=contact)
            assert made.tracker.offer(line(course.start, course.end, speed), 0.0) is None
            touched, stopped = run_into(made)
            entry.reaction_ms = 1e3 * (stopped - touched)
            result, _ = made.finished[0]
            assert result.code is ResultCode.BLOCKED
            made.tips.clear()
            made.run(0.1)
            assert made.present_force() <= 10.0
            made.run(1.0)
            entry.force = made.arm.truth.peak
            assert entry.force <= strongest
            held = np.array((result.values['x'], result.values['y']))
            away = np.hypot(*(np.array(made.tips)[:, :2] - held).T)
            moving = speeds(np.array(made.tips), PERIOD)
            entry.deviation_mm, entry.speed = 1e3 * away.max(), moving.max()
            assert entry.deviation_mm <= 4.0
            # Once it stands it stays.
            assert np.mean(moving[round(0.2 / PERIOD):] < STILL) >= 0.99
            assert made.tracker.counters.contacts == 1
            # Off a soft surface the tip first takes back what it is pressed in.
            late = resumes(made, held, course.start, speed)
            assert late <= (0.15 if stiffness < 10 else 0.1)


def resumes(made: Rig, held: np.ndarray, to: tuple[float, float], speed: float) -> float:
    """Go back to where it came from; return how long the tip stays behind its reference [s]."""
    back = line(tuple(held), to, speed, stamp_ns=2 * MS)
    assert made.tracker.offer(back, 0.0) is None
    asked, followed = [], []
    for _ in range(round(0.4 / PERIOD)):
        made.tick()
        asked.append(np.linalg.norm(made.tracker.reference.velocity))
        followed.append(np.linalg.norm(made.tips[-1] - made.tips[-2]) / PERIOD)
    start, moved = np.argmax(np.array(asked) > STILL), np.argmax(np.array(followed) > STILL)
    assert start * PERIOD <= 0.1
    made.run(back.duration)
    assert made.finished[-1].result.code is ResultCode.DONE
    return (moved - start) * PERIOD
