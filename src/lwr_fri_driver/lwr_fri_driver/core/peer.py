# SPDX-License-Identifier: Apache-2.0
"""Who may be the controller."""

Address = tuple[str, int]


class Peer:
    """The one address that is listened to, until it is forgotten.

    Attributes:
        address: of the controller; None as long as nobody has spoken FRI.
        foreign: packets of others.

    """

    def __init__(self, host: str) -> None:
        """Expect the controller at `host`, or anywhere if that is empty."""
        self.address: Address | None = None
        self.foreign = 0
        self._host = host

    def admits(self, address: Address) -> bool:
        """Tell whether a packet from `address` is looked at, and count it if not."""
        known = self.address or (self._host or address[0], address[1])
        if address == known:
            return True
        self.foreign += 1
        return False

    def adopt(self, address: Address) -> None:
        """Take the sender of a measurement for the controller."""
        self.address = address

    def forget(self) -> None:
        """Let a controller that has fallen silent come back from another port."""
        self.address = None
