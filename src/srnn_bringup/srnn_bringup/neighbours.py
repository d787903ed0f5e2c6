# SPDX-License-Identifier: Apache-2.0
"""The nodes that share the namespace of a node."""

from rclpy.node import Node


def neighbours(node: Node) -> list[str]:
    """Return their names, those of two of one name twice."""
    seen = node.get_node_names_and_namespaces()
    return [name for name, namespace in seen if namespace == node.get_namespace()]
