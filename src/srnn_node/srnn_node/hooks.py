# SPDX-License-Identifier: Apache-2.0
"""What a node of the workspace overrides."""

from typing import Any

from srnn_msgs_py.health import Health


class Hooks:
    """Does nothing, and is well. The first four raise to refuse a transition."""

    def configure(self, parameters: Any) -> None:
        """Create topics and services, load and compile; nothing may move."""

    def activate(self) -> None:
        """Start working; publishers are open."""

    def deactivate(self) -> None:
        """Come to rest before returning; publishers are still open."""

    def cleanup(self) -> None:
        """Free what `configure` made, except for topics, services and timers."""

    def seconds_to_tick(self) -> float | None:
        """Return the time to the next tick [s], or None; asked only while active."""
        return None

    def on_tick(self) -> None:
        """Do what is due; called only while active. Must not log."""

    def health(self) -> Health:
        """Return severity, one line and counters for /diagnostics."""
        return Health()
