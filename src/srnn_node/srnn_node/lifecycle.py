# SPDX-License-Identifier: Apache-2.0
"""The base of every node: a managed node that survives what clients ask of it."""

from collections.abc import Callable
import time
import traceback
from typing import Any, ClassVar, TypeVar

from rcl_interfaces.msg import ParameterDescriptor
from rclpy.lifecycle import LifecyclePublisher, LifecycleState, TransitionCallbackReturn
from rclpy.subscription import Subscription

from srnn_config import Parameters
from srnn_msgs_py.health import Health
from srnn_msgs_py.journal import Deed
from srnn_msgs_py.ros import journal
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic
from srnn_node import garbage
from srnn_node.access import Access, declare_key_file
from srnn_node.diagnostics import HealthReporter
from srnn_node.entities import EntityLedger
from srnn_node.hooks import Hooks
from srnn_node.journal import JournalWriter
from srnn_node.parameters import NoParameters, declare_parameters
from srnn_node.realtime import prefer_thread, unhurried
from srnn_node.reception import Reception
from srnn_node.surviving import SurvivingNode
from srnn_node.unheard import Unheard

SUCCESS = TransitionCallbackReturn.SUCCESS
FAILURE = TransitionCallbackReturn.FAILURE
ERROR = TransitionCallbackReturn.ERROR

STARTING = {
    'autostart': 'Configure and activate without being asked.',
    'paused': 'With autostart: configure, and wait to be activated.',
}
"""Parameters of every node, off unless set."""

V = TypeVar('V')


class WorkspaceNode(Hooks, SurvivingNode):
    """A node of the workspace: override the hooks, raise to refuse a transition.

    Unconfigured and inactive nodes publish nothing but their health. Whatever a
    node creates in `configure` is destroyed for it at clean-up.

    Attributes:
        PARAMETERS: the parameter set that `configure` gets.
        ACTIVE_PRIORITY: SCHED_FIFO priority of the main thread while active, 0 for none.
        failure: why the last transition failed, empty when it did not.
        refused_messages: messages that no converter would take.

    """

    PARAMETERS: ClassVar[type[Parameters]] = NoParameters
    ACTIVE_PRIORITY: ClassVar[int] = 0

    def __init__(self, name: str, **options: Any) -> None:
        """Create the node, unconfigured.

        Args:
            name: default name of the node.
            options: whatever `rclpy.node.Node` takes.

        """
        super().__init__(name, **options)
        self.failure = ''
        self.refused_messages = 0
        self._active = False
        self._journal = JournalWriter(lambda part: None, 0)
        for parameter, text in STARTING.items():
            self.declare_parameter(parameter, False, ParameterDescriptor(description=text))
        declare_key_file(self)
        self._access = Access(self)
        self._reporter = HealthReporter(self, self._health)
        self._unheard = Unheard(self)
        self._ledger = EntityLedger(self)

    # What a node uses.

    def advertise(self, name: str) -> LifecyclePublisher:
        """Return a publisher for a topic of the table; it is silent unless active."""
        return self._access.publisher(topic(name))

    def listen(
        self,
        name: str,
        convert: Callable[[Any], V],
        callback: Callable[[V], None],
        not_in_charge: Callable[[V], None] | None = None,
    ) -> Subscription:
        """Return a subscription to a topic of the table.

        Whatever its sender may not send is dropped and counted before anything else.

        Args:
            name: name of the topic.
            convert: turns a message into a value, or raises MessageError; such
                messages are dropped and counted in `refused_messages`.
            callback: gets the value.
            not_in_charge: gets what a known sender has sent while another is in charge.

        """
        row = topic(name)
        reception = Reception(
            self._access.inlet(row), convert, callback, not_in_charge, self._not_converted
        )
        subscription = self.create_subscription(
            message_type(row.type_name), row.name, reception.receive, profile(row.qos)
        )
        self._unheard.expect(row, subscription)
        return subscription

    def keep_journal(self, name: str) -> None:
        """Begin a journal, to be published on this topic while the node is active."""
        publisher = self.advertise(name)
        self._journal = JournalWriter(
            lambda part: publisher.publish(journal.to_msg(part)),
            time.time_ns(),
            lambda: bool(publisher.is_activated),
        )
        self._journal.note(Deed.CONFIGURED)

    def report_health(self) -> None:
        """Publish the health now, besides once a second."""
        self._reporter.report()

    @property
    def active(self) -> bool:
        """True between a successful activation and the next deactivation."""
        return self._active

    # Transitions.

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Declare and check the parameters, then run the hook."""
        if self._succeeds('configure', self._configure):
            return super().on_configure(state)
        self._destroy_configured()
        return FAILURE

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Keep the garbage collector out, open the publishers, run the hook."""
        garbage.freeze()
        super().on_activate(state)
        if not self._succeeds('activate', self.activate):
            super().on_deactivate(state)
            garbage.thaw()
            return FAILURE
        if self.ACTIVE_PRIORITY:
            prefer_thread(self.ACTIVE_PRIORITY)
        self._active = True
        self._unheard.begin()
        return SUCCESS

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Run the hook, then close the publishers."""
        self._active = False
        self._unheard.end()
        stopped = self._succeeds('deactivate', self.deactivate)
        self._journal.flush()
        garbage.thaw()
        if self.ACTIVE_PRIORITY:
            prefer_thread(0)
        super().on_deactivate(state)
        return SUCCESS if stopped else ERROR

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Run the hook, then destroy what `configure` created."""
        cleaned = self._succeeds('cleanup', self.cleanup)
        self._destroy_configured()
        return SUCCESS if cleaned else ERROR

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Deactivate and clean up as far as the node had come."""
        steps = []
        if state.label == 'active':
            steps.append(self.on_deactivate)
        if state.label in ('active', 'inactive'):
            steps.append(self.on_cleanup)
        results = [step(state) for step in steps]
        return SUCCESS if all(result == SUCCESS for result in results) else ERROR

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Go back to unconfigured after a transition that broke."""
        self._destroy_configured()
        return SUCCESS

    def _configure(self) -> None:
        parameters = declare_parameters(self, self.PARAMETERS)
        self._access = Access.configured(self)
        with unhurried():
            self.configure(parameters)

    def _not_converted(self) -> None:
        self.refused_messages += 1

    def _destroy_configured(self) -> None:
        self._unheard.forget()
        self._ledger.destroy_later_ones()

    def _succeeds(self, transition: str, hook: Callable[[], None]) -> bool:
        self.failure = ''
        try:
            hook()
        except Exception as error:
            self.failure = f'{transition}: {error}' if str(error) else f'{transition}: {error!r}'
            self.get_logger().error(self.failure)
            self.get_logger().debug(traceback.format_exc())
            return False
        return True

    def _health(self) -> Health:
        health = self.health()
        values = {
            'state': self.state,
            'refused_messages': self.refused_messages,
            **health.values,
        }
        told = self._access.extend(Health(health.level, health.message, values))
        return Health(told.level, told.message or self.state, told.values)
