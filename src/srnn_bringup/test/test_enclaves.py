# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st
import pytest

from srnn_bringup.dds_security.enclaves import COMMAND, MEMBERS, access, enclave, markdown_table
from srnn_msgs_py.services import SERVICES
from srnn_msgs_py.topics import NODES, TOPICS, Topic

DOCUMENT = Path(__file__).parents[3] / 'docs' / 'sros2.md'

members = pytest.mark.parametrize('member', MEMBERS)
nodes = pytest.mark.parametrize('node', NODES)
role = st.lists(st.sampled_from((*NODES, 'user', 'view')), unique=True).map(tuple)
name = st.from_regex(r'/?[a-z]{1,9}(/[a-z]{1,9})?', fullmatch=True).filter(
    lambda name: name not in {row.name for row in TOPICS}
)


@st.composite
def new_rows(draw) -> Topic:
    return replace(
        TOPICS[0], name='/new' + draw(name), publishers=draw(role), subscribers=draw(role)
    )


def absolute(name: str) -> str:
    return '/' + name.removeprefix('/')


def of_table(names, table=TOPICS) -> set[str]:
    return set(names) & {absolute(row.name) for row in table}


@nodes
def test_a_node_has_its_rows_of_the_table_and_no_others(node):
    rights = access(node)
    writes = {absolute(row.name) for row in TOPICS if node in row.publishers}
    reads = {absolute(row.name) for row in TOPICS if node in row.subscribers}
    assert set(rights.publishes) - writes == {
        '/rosout', '/parameter_events', f'/{node}/transition_event'
    }  # fmt: skip
    assert writes <= set(rights.publishes)
    assert set(rights.hears) == reads


@given(row=new_rows())
@members
def test_a_new_row_is_a_new_right_of_those_it_names(member, row):
    before, after = access(member), access(member, (*TOPICS, row))
    writer = 'user' if member == COMMAND else member
    writes = {row.name} if writer in row.publishers else set()
    reads = {row.name} if member == COMMAND or member in row.subscribers else set()
    assert set(after.publishes) - set(before.publishes) == writes
    assert set(after.hears) - set(before.hears) == reads
    assert (after.offers, after.calls) == (before.offers, before.calls)
    assert {f'rt{name}' for name in writes} == set(after.dds_publishes) - set(before.dds_publishes)
    assert {f'rt{name}' for name in reads} == set(after.dds_hears) - set(before.dds_hears)


def test_a_row_less_is_a_right_less():
    without = tuple(row for row in TOPICS if row.name != 'segment')
    assert '/segment' in access('planner').publishes
    assert '/segment' not in access('planner', without).publishes


@nodes
def test_nodes_call_nobody_and_offer_what_is_theirs(node):
    rights = access(node)
    assert not rights.calls
    assert all(service.startswith(f'/{node}/') for service in rights.offers)
    assert {f'/{node}/{name}' for name in SERVICES[node]} <= set(rights.offers)


def test_nobody_but_the_tracker_commands_the_arm():
    name = '/forward_position_controller/commands'
    assert [member for member in MEMBERS if name in access(member).publishes] == ['tracker']


def test_the_command_reads_everything_and_calls_everybody():
    rights = access(COMMAND)
    for node in NODES:
        theirs = access(node)
        assert set(theirs.publishes) <= set(rights.hears)
        assert set(theirs.offers) <= set(rights.calls)
    assert of_table(rights.publishes) == {'/waypoints'}


@members
def test_every_question_and_answer_has_its_two_topics(member):
    rights = access(member)
    for service in rights.offers:
        assert f'rq{service}Request' in rights.dds_hears
        assert f'rr{service}Reply' in rights.dds_publishes
    for service in rights.calls:
        assert f'rq{service}Request' in rights.dds_publishes
        assert f'rr{service}Reply' in rights.dds_hears
    count = len(rights.offers) + len(rights.calls) + 1
    assert len(rights.dds_publishes) == len(rights.publishes) + count
    assert len(rights.dds_hears) == len(rights.hears) + count
    assert 'ros_discovery_info' in set(rights.dds_publishes) & set(rights.dds_hears)


def test_services_are_told_of_every_node():
    assert set(SERVICES) == set(NODES)


def test_the_document_shows_the_rights_as_they_are():
    text = DOCUMENT.read_text(encoding='utf-8')
    assert markdown_table() in text
    assert all(enclave(member) in text for member in MEMBERS)
