# SPDX-License-Identifier: Apache-2.0
"""What a report reads of a bag in which two graphs have spoken on the topics that all share."""

import pytest
from rcl_interfaces.msg import Log
from rclpy.serialization import serialize_message
import recorded_touch

from srnn_bag import BagWriter
from srnn_bag.attached import PARAMETERS
from srnn_bringup import bag_attachments, cli
from srnn_bringup.bag_recorder import LOG
from srnn_bringup.config import Choices, load
from srnn_bringup.graph import describe, write_parameters
from srnn_bringup.page.bag_run import read_run
from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.ros import diagnostics, segment
from srnn_msgs_py.topics import topic

CONFIGURATION = load(Choices(arm='mock'))


def planner(number: int) -> Health:
    """Return the health of a planner that has planned so many segments."""
    return Health(HealthLevel.WARN, f'worry {number}', {'planned': number})


@pytest.fixture(params=[('/', True), ('/left', True), ('/left', False)])
def bag(request, tmp_path):
    """Return a namespace, and the bag of the graph in it, beside which another one runs.

    The graph has an adapter, or goes by what another one learns.
    """
    namespace, learns = request.param
    own, other = namespace.rstrip('/'), '/right' if namespace == '/' else ''
    at = recorded_touch.BEGIN
    with BagWriter(tmp_path / 'run') as writer:

        def put(name, row, msg):
            if name not in known:
                writer.add_topic(name, row.type_name, row.qos)
            known.add(name)
            writer.write(name, bytes(serialize_message(msg)), at, at, len(known))

        known: set[str] = set()
        put(f'{own}/segment', topic('segment'), segment.to_msg(recorded_touch.plan(1)))
        for number, place in enumerate((own, other), start=1):
            health = diagnostics.to_msg(planner(number), f'{place}/planner', at)
            put('/diagnostics', topic('/diagnostics'), health)
            name = f'{place}/planner'.strip('/').replace('/', '.')
            put(LOG.name, LOG, Log(level=30, name=name, msg=f'warning {number}'))
        files = write_parameters(describe(CONFIGURATION), tmp_path)
        for file in bag_attachments.of_run(CONFIGURATION, files):
            if learns or file.name != PARAMETERS.format('adapter'):
                writer.attach(file.name, file.media_type, file.data, at)
    return namespace, tmp_path / 'run'


def test_a_report_reads_its_own_graph_alone(bag):
    namespace, path = bag
    run = read_run(path)
    assert len(run.sent) == 1, namespace
    assert run.recorder.figures['planned'] == '1'
    assert {event.text for event in run.events} == {'worry 1', 'warning 1'}
    assert run.configuration.network == CONFIGURATION.network


def test_a_bag_that_does_not_tell_how_its_graph_was_started_is_named(tmp_path, capsys):
    path = recorded_touch.write(tmp_path / 'run')
    for line in (['report', str(path)], ['belief', 'list', str(path)]):
        assert cli.main(line) == 2
        said = capsys.readouterr().err
        assert said.startswith(f'srnn {line[0]}: {path}: has no ')
        assert 'record with `srnn record` or --record' in said
