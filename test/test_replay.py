# SPDX-License-Identifier: Apache-2.0
"""What a recorded run has decided is decided again, bit for bit, and every difference is found."""

from collections.abc import Callable, Iterator
import itertools
import json
from pathlib import Path
import re
import subprocess

from browser import BROWSER, Browser
import numpy as np
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import JointState
from srnn_process import SCENE
from std_srvs.srv import Trigger
from watched_graph import PATIENCE_S, Watched

from srnn_bag import Bag, BagWriter, Message, open_bag
from srnn_bag.attached import RUN
from srnn_bringup import cli
from srnn_bringup.config import Choices, load
from srnn_bringup.live_graph import LiveGraph
from srnn_bringup.restarts import Restarts
from srnn_msgs_py.qos import EVENT
from srnn_node.signals import StopRequest
from srnn_replay.counterfactual import learn_again
from srnn_replay.errors import NotReplayableError, OtherVersionError
from srnn_replay.joint_state_bytes import stamp_ns
from srnn_replay.replay import Replay, replay

pytestmark = pytest.mark.slow

RUN_SEGMENTS = 8


@pytest.fixture(scope='module')
def eventful(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the bag of a run with a touch, stops, pauses, and the death of every node."""
    folder = tmp_path_factory.mktemp('run')
    (folder / 'wall.yaml').write_text(SCENE)
    configuration = load(Choices(scene=str(folder / 'wall.yaml'), seed=2))
    with (
        StopRequest() as stop,
        LiveGraph(configuration, stop, lambda _: None, Restarts(), bag=folder / 'bag') as graph,
    ):
        watched = Watched(graph, guarded=True)
        graph.configure()
        graph.activate()
        goes_on(watched, 4)
        for service in ('stop', 'reset', 'pause', 'resume'):
            watched.spin(0.3)
            assert watched.call(Trigger, f'tracker/{service}').success
        goes_on(watched, 2)
        for node in ('adapter', 'planner', 'tracker'):
            watched.kill(node)
            goes_on(watched, 3)
        watched.kill('sim_bridge')
        watched.spin(4.0)
        assert watched.call(Trigger, 'tracker/reset').success
        goes_on(watched, 2)
    return folder / 'bag'


def goes_on(watched: Watched, count: int) -> None:
    before = len(watched.done())
    watched.until(lambda: len(watched.done()) >= before + count, PATIENCE_S)


def decisions(found: Replay) -> dict[str, dict[str, int]]:
    return {verdict.node: dict(verdict.decisions) for verdict in found.verdicts}


def test_all_decisions_come_out_as_they_were_twice(eventful):
    first, again = replay(eventful), replay(eventful)
    assert first.identical, [verdict.words() for verdict in first.verdicts]
    assert decisions(first) == decisions(again)
    counts = decisions(first)
    bag = open_bag(eventful)
    for node, kind, topic in (
        ('tracker', 'commands', '/forward_position_controller/commands'),
        ('tracker', 'paths', '/executed'),
        ('planner', 'segments', '/segment'),
        ('adapter', 'lessons', '/dissonance'),
    ):
        recorded = sum(1 for _ in bag.messages({topic}))
        # Of a process that was killed the last rows of its journal are missing.
        assert recorded - 120 <= counts[node][kind] <= recorded
    assert counts['tracker']['results'] > RUN_SEGMENTS
    assert counts['adapter']['versions of the weights'] >= 3


@pytest.fixture
def changed(eventful: Path, tmp_path: Path) -> Iterator[Callable[..., Path]]:
    """Return a function that writes the bag again with other messages or attachments."""

    def write(
        change: Callable[[Message], Message | None], attachments: dict[str, bytes] | None = None
    ) -> Path:
        bag: Bag = open_bag(eventful)
        with BagWriter(tmp_path / 'changed') as writer:
            for name, data in {**bag.attachments, **(attachments or {})}.items():
                writer.attach(name, 'text/plain', data, 0)
            for topic, type_name in bag.topics.items():
                writer.add_topic(topic, type_name, EVENT)
            for message in bag.messages():
                other = change(message)
                if other is not None:
                    topic, received_ns, sent_ns, sequence, data = other
                    writer.write(topic, data, received_ns, sent_ns, sequence)
        return tmp_path / 'changed'

    return write


def nth(bag: Path, topic: str, number: int) -> Message:
    return next(itertools.islice(open_bag(bag).messages({topic}), number, None))


def test_one_flipped_bit_in_one_plan_is_found_and_named(eventful, changed, capsys):
    chosen = nth(eventful, '/segment', 2)
    data = bytearray(chosen.data)
    place = data.find(np.float64(0.0).tobytes(), 200)
    data[place + 6] ^= 1
    bag = changed(lambda m: m._replace(data=bytes(data)) if m == chosen else m)
    told = bag.parent / 'found.json'
    assert cli.main(['replay', str(bag), '--json', str(told)]) == 1
    out = capsys.readouterr().out
    (line,) = [line for line in out.splitlines() if line.startswith('planner: ')]
    assert f'segment {stamp_ns(chosen.data)} differs after 2 segments: ' in line
    assert 'recorded ' in line
    assert 'replayed ' in line
    found = json.loads(told.read_text())
    nodes = {node['node']: node for node in found['nodes']}
    assert not found['identical']
    assert not nodes['planner']['identical']
    assert 'recorded ' in nodes['planner']['difference']


def test_one_flipped_bit_in_one_command_is_found(eventful, changed):
    chosen = nth(eventful, '/forward_position_controller/commands', 300)
    data = bytearray(chosen.data)
    data[-8] ^= 1
    found = replay(changed(lambda m: m._replace(data=bytes(data)) if m == chosen else m))
    (tracker,) = [verdict for verdict in found.verdicts if verdict.node == 'tracker']
    assert tracker.decisions['commands'] == 300
    assert tracker.difference.where == '[6]'
    assert not found.identical


def test_joint_states_may_name_their_joints_in_any_order(eventful, changed):
    def turned(message: Message) -> Message:
        if 'joint_states' not in message.topic or message.sequence % 7:
            return message
        msg = deserialize_message(message.data, JointState)
        for values in (msg.name, msg.position, msg.velocity, msg.effort):
            values.reverse()
        return message._replace(data=bytes(serialize_message(msg)))

    found = replay(changed(turned))
    assert found.identical, [verdict.words() for verdict in found.verdicts]
    assert decisions(found) == decisions(replay(eventful))


def test_a_bag_that_lacks_an_input_says_which(eventful, changed):
    chosen = nth(eventful, '/joint_states', 500)
    words = f'lacks joint states {stamp_ns(chosen.data)}, which it has answered$'
    with pytest.raises(NotReplayableError, match=words):
        replay(changed(lambda m: None if m == chosen else m))


def test_who_began_to_record_too_late_is_told_how_to_record(eventful, changed):
    begun = nth(eventful, '/joint_states', 500)
    late = changed(
        lambda m: None if m.topic == begun.topic and m.received_ns < begun.received_ns else m
    )
    with pytest.raises(NotReplayableError, match='answered; record from the start with --record'):
        replay(late)


def test_a_bag_that_lacks_a_part_of_a_journal_is_refused(eventful, changed):
    chosen = nth(eventful, '/planner/journal', 3)
    with pytest.raises(NotReplayableError, match='planner: its journal lacks rows'):
        replay(changed(lambda m: None if m == chosen else m))


def test_a_bag_of_another_version_is_refused(eventful, changed):
    run = json.loads(open_bag(eventful).attachments[RUN])
    run['versions'].update(code='0123456789abcdef', commit='abc')
    bag = changed(lambda m: m, {RUN: json.dumps(run).encode()})
    with pytest.raises(OtherVersionError, match=r'commit abc\): code 0123456789abcdef, here '):
        replay(bag)


QUIET = (
    '--headless', '--no-sandbox', '--disable-gpu', '--disable-background-networking',
    '--disable-component-update', '--disable-sync', '--no-first-run', '--enable-logging=stderr',
    '--virtual-time-budget=3000',
)  # fmt: skip


def test_the_run_becomes_one_page(eventful, tmp_path):
    assert cli.main(['report', str(eventful), '--out', str(tmp_path / 'run.html')]) == 0
    text = (tmp_path / 'run.html').read_text()
    bag = open_bag(eventful)
    done = sum(1 for _ in bag.messages({'/executed'}))
    assert f'<b>{done}</b><span>segments</span>' in text
    assert text.count('<rect ') > done
    for words in ('touch: ', 'FAULT: ', 'planning a segment', 'scene wall'):
        assert words in text
    assert 'http' not in text.replace('http://www.w3.org/2000/svg', '')


@pytest.mark.skipif(BROWSER is None, reason='this machine has no Chromium')
def test_the_page_plays_in_a_browser_without_an_error(eventful, tmp_path):
    page = tmp_path / 'run.html'
    assert cli.main(['report', str(eventful), '--out', str(page)]) == 0
    text = page.read_text().replace(
        '</body>', "<script>document.getElementById('play').click()</script></body>"
    )
    page.write_text(text)
    done = subprocess.run(
        [BROWSER, *QUIET, f'--user-data-dir={tmp_path}/profile', '--dump-dom', page.as_uri()],
        capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    assert 'CONSOLE' not in done.stderr, done.stderr
    (clock,) = re.findall(r'id="clock">([^<]*)<', done.stdout)
    assert re.fullmatch(r'\d+\.\d s of \d+\.\d s', clock)


@pytest.mark.skipif(BROWSER is None, reason='this machine has no Chromium')
def test_all_figures_of_the_page_are_seen_on_a_phone(eventful, tmp_path):
    page = tmp_path / 'run.html'
    assert cli.main(['report', str(eventful), '--out', str(page)]) == 0
    with Browser(tmp_path, 390, 844) as browser:
        browser.open(page.as_uri())
        browser.until('document.querySelectorAll("td.n").length', 30.0)
        places = browser.evaluate(
            '[...document.querySelectorAll("td.n")].map(n => n.getBoundingClientRect().right)'
        )
        assert 0.0 < min(places) < max(places) <= 390.0
        assert browser.evaluate('document.documentElement.scrollWidth') <= 390
        assert not browser.complaints


def test_a_bag_without_attachments_is_replayed_by_whoever_knows_the_run(eventful, tmp_path):
    """As one of `ros2 bag record`: topics, and nothing else."""
    bag = open_bag(eventful)
    with BagWriter(tmp_path / 'bare') as writer:
        for topic, type_name in bag.topics.items():
            writer.add_topic(topic, type_name, EVENT)
        for topic, received_ns, sent_ns, sequence, data in bag.messages():
            writer.write(topic, data, received_ns, sent_ns, sequence)
    with pytest.raises(NotReplayableError, match='say by --scene how the graph was started'):
        replay(tmp_path / 'bare')
    scene = ['--scene', str(eventful.parent / 'wall.yaml'), '--seed', '2']
    assert cli.main(['replay', str(tmp_path / 'bare'), *scene]) == 0
    assert cli.main(['replay', str(tmp_path / 'bare'), *scene[:3], '3']) == 1


def test_the_same_experience_with_the_same_parameters_gives_the_same_weights(tmp_path):
    (tmp_path / 'wall.yaml').write_text(SCENE)
    arguments = ['--scene', str(tmp_path / 'wall.yaml'), '--segments', '6', '--seed', '2']
    weights, picture = tmp_path / 'weights.npz', tmp_path / 'demo.png'
    files = ['--save-weights', str(weights), '--picture', str(picture)]
    assert cli.main(['demo', *arguments, *files, '--record', str(tmp_path / 'bag')]) == 0
    again = tmp_path / 'again.npz'
    told = tmp_path / 'found.json'
    changes = ['--signal', 'local', '--save-weights', str(again), '--json', str(told)]
    assert cli.main(['replay', str(tmp_path / 'bag'), *changes]) == 0
    found = json.loads(told.read_text())
    assert found['recorded'] == found['would']
    assert found['changes'] == {'learning.signal': 'local'}
    assert again.read_bytes() == weights.read_bytes()
    quiet = learn_again(tmp_path / 'bag', {'learning.signal': 'none'})
    assert not quiet.updates
    assert quiet.largest_change == 0.0
    with pytest.raises(NotReplayableError, match='network.dimensions: 3: .* has 2'):
        learn_again(tmp_path / 'bag', {'network.dimensions': 3})
