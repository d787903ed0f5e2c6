# SPDX-License-Identifier: Apache-2.0
"""What the machine has to offer: processors, clock, disk, caches, ports, rendering."""

from collections.abc import Iterator, Mapping
from importlib.util import find_spec
from pathlib import Path
from socket import SOCK_DGRAM, SOCK_STREAM
import sys
import tempfile

from srnn_bringup.doctor import probes
from srnn_bringup.doctor.defaults import defaults
from srnn_bringup.doctor.finding import Finding, Verdict, judged
from srnn_bringup.options import VIEW_PORT

CPUS = 2
"""With fewer, planning delays the control of the arm."""

GIB, MIB = 1 << 30, 1 << 20
FREE, FREE_LEAST = GIB, 64 * MIB
"""What recordings want, and what nothing works without [bytes]."""

FRI_PORT = 49938


def machine(environ: Mapping[str, str]) -> Iterator[Finding]:
    """Yield what the machine has to offer."""
    yield from _processors()
    yield _clock()
    for subject, place in (
        ('disk', Path.cwd()), ('disk for parameters', Path(tempfile.gettempdir())),
    ):  # fmt: skip
        yield _disk(subject, place)
    yield from _caches(environ)
    yield from _ports()
    yield _rendering()


def _processors() -> Iterator[Finding]:
    count, load_now = probes.cpus(), probes.load()
    yield judged(
        count < CPUS, 'processors', f'{count} (wanted: {CPUS})',
        'give this process more of them: taskset, or the limits of its container',
    )
    yield judged(
        load_now > count, 'load', f'{load_now:.1f} processes want {count} processors',
        'end what else runs here, before times are measured or an arm is moved',
    )


def _clock() -> Finding:
    if probes.clock_is_kept():
        return Finding('clock', Verdict.OK, 'kept right')
    words = 'the kernel knows of nobody who keeps it right; needed by a graph on several hosts'
    return Finding('clock', Verdict.WARN, words, 'for these, run chronyd or ptp4l on each')


def _disk(subject: str, place: Path) -> Finding:
    if not probes.writable(place):
        advice = 'go to a directory of yours' if subject == 'disk' else 'set TMPDIR to another'
        # Recordings and pictures can go elsewhere; parameters of the nodes cannot.
        verdict = Verdict.WARN if subject == 'disk' else Verdict.FAIL
        return Finding(subject, verdict, f'{place} cannot be written to', advice)
    free = probes.free_bytes(place)
    words = f'{free / GIB:.1f} GiB free in {place}'
    if free < FREE_LEAST:
        return Finding(subject, Verdict.FAIL, words, 'make room')
    return judged(free < FREE, subject, words, 'make room before anything is recorded')


def _caches(environ: Mapping[str, str]) -> Iterator[Finding]:
    home = Path(environ.get('HOME') or '~').expanduser()
    user = Path(environ.get('XDG_CACHE_HOME') or home / '.cache')
    chosen = environ.get('NUMBA_CACHE_DIR')
    places = [Path(chosen)] if chosen else [_beside_kernels(), user / 'numba']
    # Numba takes the first that it can write to, and does not import without one.
    place = next(filter(probes.writable, places), None)
    if place is None:
        words = f'compiled code cannot be kept in {" or ".join(map(str, places))}'
        advice = 'set NUMBA_CACHE_DIR to a directory of yours'
        yield Finding('numba cache', Verdict.FAIL, words, advice)
    else:
        yield Finding('numba cache', Verdict.OK, f'{place}')
    for subject, variable, place in (
        ('matplotlib cache', 'MPLCONFIGDIR', user / 'matplotlib'),
        ('ROS log', 'ROS_LOG_DIR', Path(environ.get('ROS_HOME') or home / '.ros') / 'log'),
    ):
        place = Path(environ.get(variable) or place)
        bad = not probes.writable(place)
        words = f'{place} cannot be written to' if bad else f'{place}'
        yield judged(bad, subject, words, f'set {variable} to a directory of yours')


def _beside_kernels() -> Path:
    spec = find_spec('lwr_tracking')
    return Path(spec.origin if spec and spec.origin else __file__).parent / '__pycache__'


def _ports() -> Iterator[Finding]:
    told = defaults()
    # If it is not known, the finding on the configuration tells.
    fri = FRI_PORT if isinstance(told, Finding) else told.fri.fri.link.port
    for subject, kind, port, advice in (
        ('port of FRI', SOCK_DGRAM, fri, 'end its owner (ss -lunp) before srnn up --arm fri'),
        ('port of the view', SOCK_STREAM, VIEW_PORT, 'choose another: --view PORT'),
    ):
        refusal = probes.port_refusal(kind, port)
        protocol = 'UDP' if kind is SOCK_DGRAM else 'TCP'
        words = f'{protocol} {port} {refusal or "is free"}'
        yield judged(bool(refusal), subject, words, advice)


def _rendering() -> Finding:
    failure = probes.drawing_failure()
    if failure:
        advice = f'{sys.executable} -m pip install --force-reinstall matplotlib'
        return Finding('rendering', Verdict.WARN, f'no pictures: {failure}', advice)
    found = ', '.join(probes.gl_libraries()) or 'none'
    words = f'pictures need no screen; without one MuJoCo could render by: {found}'
    return Finding('rendering', Verdict.OK, words)
