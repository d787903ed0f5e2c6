# SPDX-License-Identifier: Apache-2.0
"""Each example runs from anywhere, says what its first sentence promises, and is short."""

from pathlib import Path
import re
import subprocess
import sys

from matplotlib.image import imread
import numpy as np
import pytest

EXAMPLES = Path(__file__).parents[1] / 'examples'
MAX_LINES = 60
LIMIT_S = 300.0


def run(name, folder, *arguments):
    done = subprocess.run(
        [sys.executable, EXAMPLES / f'{name}.py', *arguments],
        cwd=folder, capture_output=True, text=True, timeout=LIMIT_S,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout


def colours(picture):
    """Return the saturated colours of a picture, in steps of a quarter."""
    pixels = imread(picture)[..., :3].reshape(-1, 3)
    saturated = pixels[np.ptp(pixels, axis=1) > 0.5]
    return {tuple(colour) for colour in np.round(4.0 * saturated).astype(int)}


def test_a_plan_is_drawn_with_its_samples_and_starts_where_the_arm_is(tmp_path):
    text = run('plan_and_plot', tmp_path)
    samples, kept = map(int, re.match(r'(\d+) movements imagined, (\d+) of', text).groups())
    assert samples == 40
    assert 0 < kept < samples
    assert 'from [-0.15 -0.1 ]' in text
    # Samples that were kept are green, the segment blue, the way point orange.
    assert len(colours(tmp_path / 'plan.png')) >= 3


def test_one_touch_is_enough_not_to_go_there_and_no_touch_teaches_nothing(tmp_path):
    text = run('learn_from_a_touch', tmp_path)
    before, after = (
        int(re.search(rf'{when}: (\d+) of 20', text)[1]) for when in ('before', 'after')
    )
    assert before >= 15
    assert after <= 5
    assert 'learned: True' in text
    assert 'learned from an undisturbed segment: False' in text


def test_a_world_of_ones_own_is_learned(tmp_path):
    text = run('own_world', tmp_path, '60')
    first, _, last = map(int, re.search(r'\[(\d+), (\d+), (\d+)\]', text).groups())
    assert first > 0
    assert last == 0
    assert len(colours(tmp_path / 'world.png')) >= 2


def test_a_signal_of_ones_own_learns_and_none_does_not(tmp_path):
    rows = {
        name: (int(touches), int(updates))
        for name, touches, updates in re.findall(
            r'^(\w+Signal) +(\d+) +(\d+)', run('own_signal', tmp_path, '40'), re.MULTILINE
        )
    }
    assert list(rows) == ['NoSignal', 'GlobalSignal', 'LocalSignal', 'DeniedSignal']
    untaught, _ = rows.pop('NoSignal')
    for touches, updates in rows.values():
        assert 0 < updates <= touches < untaught / 2


def test_three_dimensions_learn_by_the_same_classes(tmp_path):
    text = run('plan_in_3d', tmp_path)
    (many, before), (some, after) = (
        tuple(map(int, re.search(rf'{when}: (\d+) valid plans, (\d+) mm', text).groups()))
        for when in ('before', 'after')
    )
    assert min(many, some) >= 8
    assert after > before
    assert len(colours(tmp_path / 'plan_3d.png')) >= 2


@pytest.mark.parametrize('file', sorted(EXAMPLES.glob('*.py')), ids=lambda file: file.name)
def test_an_example_is_short_needs_no_ros_and_is_tested_here(file):
    text = file.read_text()
    assert len(text.splitlines()) < MAX_LINES
    assert not re.search(r'^(import|from) (rclpy|\w+_msgs)\b', text, re.MULTILINE)
    assert f"run('{file.stem}'" in Path(__file__).read_text()
