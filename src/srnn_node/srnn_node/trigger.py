# SPDX-License-Identifier: Apache-2.0
"""Services that ask for one thing, and are told in words what was done or why it was not."""

from collections.abc import Callable

from rclpy.node import Node
from std_srvs.srv import Trigger

from srnn_node.errors import NotNowError


def offer(node: Node, name: str, action: Callable[[], str], *errors: type[Exception]) -> None:
    """Let everybody ask for an action.

    Args:
        node: whose service it is.
        name: name of the service, without that of the node.
        action: returns what was done; raises NotNowError to refuse.
        errors: other errors of the action that are a refusal.

    """
    refusals: tuple[type[Exception], ...] = NotNowError, *errors

    def answer(_: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        try:
            response.message, response.success = action(), True
        except refusals as error:
            response.message, response.success = str(error), False
        return response

    node.create_service(Trigger, f'~/{name}', answer)
