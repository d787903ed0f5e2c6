# SPDX-License-Identifier: Apache-2.0
"""What the arm does when measurements or commands fail. Simulated time only."""

from collections.abc import Callable
from dataclasses import replace

from arm_rig import PERIOD, PHYSICS_PER_TICK, Rig
from moving_arm import Course, generator, random_course, speeds
import numpy as np
import pytest

from lwr_description import POSITION_MAX
from lwr_tracking.core.failsafe import Condition
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.result import ResultCode

WINDOW = 100
Distort = Callable[[JointSample], JointSample]
Lie = Callable[[np.random.Generator], Distort]


def told(made: Rig, distort: Distort = lambda sample: sample) -> np.ndarray:
    """Run one cycle with a distorted measurement; return the command."""
    sample = distort(made.arm.sample(int(made.arm.time * 1e9)))
    tick = made.tracker.tick(made.arm.time, sample)
    assert made.arm.command(tick.command) is None
    made.arm.step(PHYSICS_PER_TICK)
    made.finished += tick.finished
    made.tips.append(made.arm.tip_truth)
    return tick.command


def deceived(made: Rig, distort: Distort, ticks: int = 100) -> tuple[np.ndarray, float]:
    """Distort all measurements; return the commands and the time until the arm is frozen [ms]."""
    commands, latched = [], np.inf
    for k in range(ticks):
        commands.append(told(made, distort))
        if made.tracker.latched:
            latched = min(latched, k)
    return np.array(commands), 1e3 * PERIOD * latched


def deviation_mm(tips: list[np.ndarray], others: list[np.ndarray] | np.ndarray) -> float:
    return 1e3 * float(np.linalg.norm(np.array(tips) - others, axis=1).max())


def beside_mm(tips: list[np.ndarray], path: list[np.ndarray]) -> float:
    """Return how far the tips are from a path at most, whenever they get there."""
    away = np.linalg.norm(np.array(tips)[:, None] - np.array(path)[None], axis=2)
    return 1e3 * float(away.min(axis=1).max())


def test_without_a_tracker_the_arm_holds_within_20_ms_and_stands_soon(ledger):
    """Row 4: at most 15 mm, at rest within 510 ms."""
    for repeat in range(ledger.repeats):
        course = random_course(generator('killed', repeat))
        with ledger.injection(4, 'tracker killed', bound_ms=20.0) as entry:
            made = course.begin()
            before, tips = made.arm.tip_truth, []
            for ms in range(1000):
                made.arm.step()
                tips.append(made.arm.tip_truth)
                if made.arm.watch.holding and entry.reaction_ms is None:
                    # The last command had been given one period before.
                    entry.reaction_ms = ms + 1 + 1e3 * PERIOD
            entry.deviation_mm = deviation_mm(tips, before)
            moving = speeds(np.array(tips), 0.001)
            entry.speed = moving.max()
            assert entry.deviation_mm <= 15.0
            assert entry.speed <= course.cap()
            assert np.flatnonzero(moving > 0.005).max(initial=0) <= 510
            assert abs(tips[-1][2] - before[2]) <= 0.002
            assert made.arm.watch.holds == 1


def lossy(course: Course, lost: np.ndarray, measured: bool) -> Rig:
    """Return an arm that lost some cycles' commands, with or without the measurements."""
    made = course.begin()
    made.tips.clear()
    for gone in lost:
        if not gone:
            told(made)
            continue
        if not measured:
            made.tracker.tick(made.arm.time, made.arm.sample(int(made.arm.time * 1e9)))
        made.arm.step(PHYSICS_PER_TICK)
        made.tips.append(made.arm.tip_truth)
    return made


@pytest.mark.parametrize('lost', [1, 3, 5])
@pytest.mark.parametrize('measured', [False, True], ids=['commands', 'both'])
def test_a_few_lost_cycles_are_made_up_for(ledger, lost, measured):
    """Row 7: at most 2 mm beside the run without the loss, and nothing of it remains.

    A tracker that was not told either loses the time too, but for two cycles.
    """
    away_mm = beside_mm if measured else deviation_mm
    what = f'{"cycles" if measured else "commands"} lost in a row: {lost}'
    for repeat in range(ledger.repeats):
        course = random_course(generator(what, repeat))
        with ledger.injection(7, what) as entry:
            gone = np.arange(75) < lost
            clean, made = lossy(course, gone & False, measured), lossy(course, gone, measured)
            entry.deviation_mm = away_mm(made.tips, clean.tips)
            entry.speed = speeds(np.array(made.tips), PERIOD).max()
            assert entry.deviation_mm <= 2.0
            assert entry.speed <= course.cap(overshoot=1.25)
            assert made.arm.watch.holds == (lost == 5)
            made.run(course.duration)
            assert [entry.result.code for entry in made.finished] == [ResultCode.DONE]
            assert np.hypot(*(made.tips[-1][:2] - made.tracker.reference.position[:2])) <= 1e-3


@pytest.mark.parametrize('share', [0.05, 0.1, 0.2])
def test_commands_lost_at_random_are_counted_and_made_up_for(ledger, share):
    """Row 7: whatever the share, it is single long gaps that would be dangerous."""
    what = f'{share:.0%} of the commands lost'
    for repeat in range(ledger.repeats):
        rng = generator(what, repeat)
        course = random_course(rng)
        with ledger.injection(7, what) as entry:
            gone = rng.permutation(WINDOW) < round(share * WINDOW)
            clean, made = lossy(course, gone & False, False), lossy(course, gone, False)
            assert made.arm.watch.answered == pytest.approx(1.0 - share)
            entry.deviation_mm = deviation_mm(made.tips, clean.tips)
            entry.speed = speeds(np.array(made.tips), PERIOD).max()
            assert entry.deviation_mm <= 2.0
            assert entry.speed <= course.cap(overshoot=1.25)
            assert not made.tracker.conditions


def frozen(at: JointSample) -> Distort:
    """Measurements with a new stamp and old content."""
    return lambda sample: replace(at, stamp_ns=sample.stamp_ns)


def repeated(at: JointSample) -> Distort:
    """An old measurement, sent again."""
    return lambda sample: at


def unstamped(at: JointSample) -> Distort:
    """Measurements whose stamp stands still."""
    return lambda sample: replace(sample, stamp_ns=at.stamp_ns)


@pytest.mark.parametrize(
    ('freeze', 'bound_ms'), [(frozen, 20.0), (repeated, 10.0), (unstamped, 10.0)]
)
def test_measurements_that_stand_still_stop_the_arm(ledger, freeze, bound_ms):
    """Row 16: at most 4 mm and 0.25 m/s are commanded; a freeze overshoots by 2 mm.

    Angles that stand still are only suspicious once the command has moved on, which takes
    a slow arm longer.
    """
    what = freeze.__doc__.rstrip('.').lower()
    for repeat in range(ledger.repeats):
        course = random_course(generator(what, repeat))
        with ledger.injection(16, what, bound_ms) as entry:
            made = course.begin()
            at = made.arm.sample(int(made.arm.time * 1e9))
            commands = [told(made, lambda sample, at=at: at)]
            before = made.arm.tip_truth
            made.tips.clear()
            after, wait = deceived(made, freeze(at))
            entry.reaction_ms = wait + 1e3 * PERIOD
            assert made.tracker.conditions == Condition.FROZEN
            steps = np.abs(np.diff([*commands, *after], axis=0)).max(axis=1)
            assert (np.flatnonzero(steps).max(initial=-1) + 1) * PERIOD * course.speed <= 0.004
            entry.deviation_mm = deviation_mm(made.tips, before)
            entry.speed = speeds(np.array(made.tips), PERIOD).max()
            assert entry.deviation_mm <= 6.0 * course.haste
            assert entry.speed <= course.cap()


def with_joint(field: str, lie: Callable[[float, float], float]) -> Lie:
    """Return a lie about one joint; it is told the true value and a number from -1 to 1."""

    def lies(rng: np.random.Generator) -> Distort:
        joint, size = rng.integers(7), rng.uniform(-1.0, 1.0)

        def distort(sample: JointSample) -> JointSample:
            values = getattr(sample, field).copy()
            values[joint] = lie(values[joint], size)
            return replace(sample, **{field: values})

        return distort

    return lies


def of_six_joints(rng: np.random.Generator) -> Distort:
    return lambda sample: replace(sample, position=sample.position[:6])


FARTHEST = POSITION_MAX.max()
LIES: dict[str, Lie] = {
    'NaN among the measured angles': with_joint('position', lambda q, size: np.nan),
    'infinite measured angle': with_joint('position', lambda q, size: size * np.inf),
    'NaN among the external torques': with_joint('external_torque', lambda t, size: np.nan),
    'measured angle jumps': with_joint(
        'position', lambda q, size: q + np.copysign(0.05 + 0.25 * abs(size), size)
    ),
    'measured angle beyond its limits': with_joint(
        'position', lambda q, size: np.copysign((1.01 + 9.0 * abs(size)) * FARTHEST, size)
    ),
    'measurement of six joints': of_six_joints,
}


@pytest.mark.parametrize('what', LIES)
def test_a_measurement_that_is_not_true_is_not_followed(ledger, what):
    """Row 17: the command stays where it is, and the arm comes to rest there."""
    for repeat in range(ledger.repeats):
        rng = generator(what, repeat)
        course = random_course(rng)
        with ledger.injection(17, what, bound_ms=4.0) as entry:
            made = course.begin()
            before = made.arm.tip_truth
            made.tips.clear()
            commands, entry.reaction_ms = deceived(made, LIES[what](rng))
            entry.deviation_mm = deviation_mm(made.tips, before)
            entry.speed = speeds(np.array(made.tips), PERIOD).max()
            assert np.abs(np.diff(commands[1:], axis=0)).max() <= 1e-9
            assert entry.deviation_mm <= 6.0 * course.haste
            assert entry.speed <= course.cap()
            made.tracker.reset()
            made.run(0.5)
            assert not made.tracker.latched
            assert 1e3 * np.linalg.norm(made.arm.tip_truth - before) <= 6.0 * course.haste


@pytest.mark.parametrize(('what', 'leap_s'), [('-10 s', -10.0), ('+1 h', 3600.0)])
def test_a_system_clock_that_is_set_changes_no_command(ledger, what, leap_s):
    """Row 15: the loop runs on the steady clock; stamps only tell one measurement from another."""

    def commands(course: Course, leap_ns: int, when: int) -> tuple[bytes, Rig]:
        made = course.begin()
        made.tips.clear()

        def leaping(k: int) -> Distort:
            add = 10**11 + (leap_ns if k > when else 0)
            return lambda sample: replace(sample, stamp_ns=sample.stamp_ns + add)

        sent = np.array([told(made, leaping(k)) for k in range(250)])
        assert not made.tracker.conditions
        return sent.tobytes(), made

    what = f'system clock set by {what}'
    for repeat in range(ledger.repeats):
        rng = generator(what, repeat)
        course, when = random_course(rng), int(rng.integers(200))
        with ledger.injection(15, what) as entry:
            clean, _ = commands(course, 0, when)
            leapt, made = commands(course, round(leap_s * 1e9), when)
            assert leapt == clean
            entry.deviation_mm, entry.speed = 0.0, speeds(np.array(made.tips), PERIOD).max()
            assert entry.speed <= course.cap()
