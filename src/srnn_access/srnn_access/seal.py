# SPDX-License-Identifier: Apache-2.0
"""Authentication codes: who knows the key made this message, for this topic."""

import hmac

from srnn_access.key import Key
from srnn_access.mark import CODE_DIGITS


class Seal:
    """Makes and checks the codes of one topic: HMAC-SHA256, the first 128 bits."""

    def __init__(self, key: Key, topic: str) -> None:
        """Use `key` for the topic of this full name."""
        name = topic.encode()
        self._secret = key.secret
        # With its length in front, no name can pass for a name and some content.
        self._prefix = len(name).to_bytes(4, 'little') + name

    def code(self, content: bytes) -> str:
        """Return the code of a message in hex digits.

        Args:
            content: every field of the message, and its mark without the code.

        """
        digest = hmac.digest(self._secret, self._prefix + content, 'sha256')
        return digest.hex()[:CODE_DIGITS]

    def fits(self, code: str, content: bytes) -> bool:
        """Tell whether a code is that of the message, in the same time for all wrong ones."""
        return hmac.compare_digest(code.encode(), self.code(content).encode())
