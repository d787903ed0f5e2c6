# SPDX-License-Identifier: Apache-2.0
"""The rights of the enclaves are what the nodes really do: nothing is missing, little is spare."""

from collections.abc import Callable, Iterator
from fnmatch import fnmatchcase
from functools import partial

import pytest
from watched_graph import over

from srnn_bringup.arms import ARMS, MOCK
from srnn_bringup.config import Choices, load
from srnn_bringup.dds_security.enclaves import COMMAND, access
from srnn_bringup.live_graph import LiveGraph
from srnn_bringup.observer import Observer
from srnn_bringup.run_recorder import start_recording
from srnn_node.signals import StopRequest

PATIENCE_S = 15.0


@pytest.fixture(scope='module', params=ARMS)
def graph(request: pytest.FixtureRequest) -> Iterator[LiveGraph]:
    configuration = over(request.param, load(Choices()))
    with StopRequest() as stop, LiveGraph(configuration, stop, print) as graph:
        observer = Observer(graph.node, start_recording(configuration))
        graph.configure()
        # The mock arm knows of no contacts, so that one topic has no publisher.
        assert request.param == MOCK or graph.pump.until(observer.connected, PATIENCE_S)
        yield graph


def uses(graph: LiveGraph, member: str) -> list[tuple[Callable[[], set[str]], tuple[str, ...]]]:
    """Return what a member uses by the account of the middleware, and what it may use."""
    rights, node = access(member), graph.node
    return [
        (partial(names, node.get_publisher_names_and_types_by_node, member), rights.publishes),
        (partial(names, node.get_subscriber_names_and_types_by_node, member), rights.hears),
        (partial(names, node.get_service_names_and_types_by_node, member), rights.offers),
        (partial(names, node.get_client_names_and_types_by_node, member), rights.calls),
    ]


def names(query: Callable, member: str) -> set[str]:
    return {name for name, _ in query(member, '/')}


def unused(patterns: tuple[str, ...], used: set[str]) -> list[str]:
    return [p for p in patterns if not any(fnmatchcase(name, p) for name in used)]


def forbidden(used: set[str], patterns: tuple[str, ...]) -> list[str]:
    return [name for name in used if not any(fnmatchcase(name, p) for p in patterns)]


def test_nodes_may_do_what_they_do_and_do_what_they_may(graph):
    for used, patterns in (use for name in graph.names for use in uses(graph, name)):
        settled = partial(lambda used, patterns: not unused(patterns, used()), used, patterns)
        graph.pump.unguarded().until(settled, PATIENCE_S)
        assert unused(patterns, used()) == []
        assert forbidden(used(), patterns) == []


def test_the_command_may_do_what_it_does(graph):
    for used, patterns in uses(graph, COMMAND):
        assert used()
        assert forbidden(used(), patterns) == []
