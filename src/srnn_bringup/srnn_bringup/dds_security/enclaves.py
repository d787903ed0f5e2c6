# SPDX-License-Identifier: Apache-2.0
"""What each enclave of the graph may say, hear, offer and call, from the topic table."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from srnn_msgs_py.services import SERVICES
from srnn_msgs_py.topics import NODES, TOPICS, Topic

COMMAND = 'srnn'
"""The node of the `srnn` command; it acts for the users and views of the topic table."""

USER = 'user'

MEMBERS = (*NODES, COMMAND)
"""Everyone who has an enclave."""

_PARAMETER_SERVICES = (
    'describe_parameters', 'get_parameter_types', 'get_parameters', 'list_parameters',
    'set_parameters', 'set_parameters_atomically',
)  # fmt: skip
_LIFECYCLE_SERVICES = (
    'change_state', 'get_available_states', 'get_available_transitions', 'get_state',
    'get_transition_graph',
)  # fmt: skip
_TYPE_SERVICE = 'get_type_description'

_LOG = '/rosout'
_PARAMETER_EVENTS = '/parameter_events'

_DISCOVERY = 'ros_discovery_info'
"""Over this DDS topic the participants tell each other of their nodes."""


@dataclass(frozen=True)
class Access:
    """The rights of one enclave, as sorted absolute ROS names; ``*`` is a wildcard.

    Attributes:
        publishes: topics it may write.
        hears: topics it may read.
        offers: services it may answer.
        calls: services it may ask.

    """

    publishes: tuple[str, ...]
    hears: tuple[str, ...]
    offers: tuple[str, ...]
    calls: tuple[str, ...]

    @property
    def dds_publishes(self) -> tuple[str, ...]:
        """DDS topics it may write, sorted."""
        replies = (f'rr{name}Reply' for name in self.offers)
        requests = (f'rq{name}Request' for name in self.calls)
        topics = (f'rt{name}' for name in self.publishes)
        return tuple(sorted({_DISCOVERY, *topics, *replies, *requests}))

    @property
    def dds_hears(self) -> tuple[str, ...]:
        """DDS topics it may read, sorted."""
        requests = (f'rq{name}Request' for name in self.offers)
        replies = (f'rr{name}Reply' for name in self.calls)
        topics = (f'rt{name}' for name in self.hears)
        return tuple(sorted({_DISCOVERY, *topics, *requests, *replies}))


def enclave(member: str) -> str:
    """Return the name of the enclave of a member."""
    return f'/srnn/{member}'


def access(
    member: str,
    topics: Sequence[Topic] = TOPICS,
    services: Mapping[str, tuple[str, ...]] = SERVICES,
) -> Access:
    """Return the rights of a member: its rows of the table, and what its node needs for ROS.

    Args:
        member: a node of the graph, or the command.
        topics: topic table.
        services: private names of the services that nodes offer, by node.

    """
    return _of_command(topics, services) if member == COMMAND else _of_node(
        member, topics, services
    )  # fmt: skip


def markdown_table() -> str:
    """Return the rights of every enclave in Markdown, as docs/sros2.md shows them."""
    lines = ['| enclave | writes | reads | calls |', '|---|---|---|---|']
    for member in MEMBERS:
        rights = access(member)
        ours = {_absolute(row.name) for row in TOPICS}
        writes, reads = (
            ', '.join(f'`{name.removeprefix("/")}`' for name in names if name in ours)
            for names in (rights.publishes, rights.hears)
        )
        calls = 'every service of the nodes' if rights.calls else ''
        lines.append(f'| `{enclave(member)}` | {writes} | {reads} | {calls} |')
    return '\n'.join(lines) + '\n'


def _of_node(
    node: str, topics: Sequence[Topic], services: Mapping[str, tuple[str, ...]]
) -> Access:
    return Access(
        publishes=_names(
            [row.name for row in topics if node in row.publishers],
            [_LOG, _PARAMETER_EVENTS, _transitions(node)],
        ),
        hears=_names([row.name for row in topics if node in row.subscribers]),
        offers=_names(_services_of(node, services)),
        calls=(),
    )


def _of_command(topics: Sequence[Topic], services: Mapping[str, tuple[str, ...]]) -> Access:
    return Access(
        publishes=_names(
            [row.name for row in topics if USER in row.publishers], [_PARAMETER_EVENTS]
        ),
        hears=_names(
            [row.name for row in topics],
            [_LOG, _PARAMETER_EVENTS],
            [_transitions(node) for node in NODES],
        ),
        offers=_names([f'{COMMAND}/{_TYPE_SERVICE}']),
        calls=_names(*(_services_of(node, services) for node in NODES)),
    )


def _services_of(node: str, services: Mapping[str, tuple[str, ...]]) -> list[str]:
    of_ros = (*_PARAMETER_SERVICES, *_LIFECYCLE_SERVICES, _TYPE_SERVICE)
    return [f'{node}/{name}' for name in (*of_ros, *services[node])]


def _transitions(node: str) -> str:
    return f'{node}/transition_event'


def _names(*groups: Sequence[str]) -> tuple[str, ...]:
    return tuple(sorted({_absolute(name) for group in groups for name in group}))


def _absolute(name: str) -> str:
    return name if name.startswith('/') else f'/{name}'
