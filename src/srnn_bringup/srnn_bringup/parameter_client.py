# SPDX-License-Identifier: Apache-2.0
"""Asks a running node what it was told."""

from typing import Any

from rcl_interfaces.srv import GetParameters, ListParameters
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python

OF_ROS = ('use_sim_time', 'start_type_description_service', 'qos_overrides')
"""Parameters, or groups of them, that every node has and that say nothing of ours."""


class ParameterClient:
    """Fetches all parameters of one node, in the background.

    Attributes:
        name: name of the node.

    """

    def __init__(self, node: Node, name: str) -> None:
        """Begin to ask for `node`; have `poll` called while events are handled."""
        self.name = name
        self._names: list[str] = []
        self._list = node.create_client(ListParameters, f'{name}/list_parameters')
        self._get = node.create_client(GetParameters, f'{name}/get_parameters')
        self._answer: Any = None
        self._done = False

    def poll(self) -> dict[str, Any] | None:
        """Take the next step if it can be taken; return the parameters, nested, once."""
        if self._answer is None:
            if self._list.service_is_ready() and self._get.service_is_ready():
                self._answer = self._list.call_async(ListParameters.Request())
        elif self._answer.done() and not self._done:
            return self._take(self._answer.result())
        return None

    def _take(self, result: Any) -> dict[str, Any] | None:
        if isinstance(result, ListParameters.Response):
            names = result.result.names
            self._names = [name for name in names if name.partition('.')[0] not in OF_ROS]
            self._answer = self._get.call_async(GetParameters.Request(names=self._names))
            return None
        values: dict[str, Any] = {}
        for name, value in zip(self._names, result.values, strict=True):
            _put(values, name.split('.'), parameter_value_to_python(value))
        self._done = True
        return values


def _put(tree: dict[str, Any], path: list[str], value: Any) -> None:
    for step in path[:-1]:
        tree = tree.setdefault(step, {})
    tree[path[-1]] = list(value) if hasattr(value, 'tolist') else value
