# SPDX-License-Identifier: Apache-2.0
"""Why a message is not acted on."""

from enum import Enum


class Refusal(Enum):
    """One rule that a message breaks; the value says it in words."""

    UNSIGNED = 'carries no code'
    ALTERED = 'is not what a holder of the key has sent'
    REPLAYED = 'is older than one that was heard'
    OUTDATED = 'was signed too long ago, or the clocks of sender and listener differ'
    NOT_OWNER = 'comes from another sender than the one in charge'
