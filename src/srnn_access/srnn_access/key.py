# SPDX-License-Identifier: Apache-2.0
"""The secret that all nodes of one graph share."""

import hashlib
import secrets
from typing import Self

from srnn_access.errors import KeyValueError

LENGTH = 32
"""Bytes of a key."""


class Key:
    """A secret of 32 bytes, which printing does not reveal."""

    __slots__ = ('secret',)

    def __init__(self, secret: bytes) -> None:
        """Take the bytes as they are.

        Raises:
            KeyValueError: they are more or fewer than 32.

        """
        if len(secret) != LENGTH:
            raise KeyValueError(f'key of {len(secret)} bytes: must be {LENGTH}')
        self.secret = bytes(secret)

    @classmethod
    def random(cls) -> Self:
        """Return a key that nobody has."""
        return cls(secrets.token_bytes(LENGTH))

    @property
    def fingerprint(self) -> str:
        """Eight digits by which people see whether two keys are the same."""
        return hashlib.sha256(b'srnn key ' + self.secret).hexdigest()[:8]

    def __repr__(self) -> str:
        return f'Key({self.fingerprint})'
