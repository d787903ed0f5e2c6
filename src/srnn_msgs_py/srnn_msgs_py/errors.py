# SPDX-License-Identifier: Apache-2.0
"""Errors of the message package."""


class MessageError(ValueError):
    """A message cannot be turned into the value it claims to be, or a value into a message.

    The text names the field, what it holds and what would be valid.
    """


class UnknownTopicError(MessageError, KeyError):
    """No topic of the table has this name; the message lists those that exist."""

    def __str__(self) -> str:
        """Return the message without the quotes that KeyError adds."""
        return str(self.args[0])
