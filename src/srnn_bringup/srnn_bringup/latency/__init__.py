# SPDX-License-Identifier: Apache-2.0
"""How long a recorded graph took from a cause to what answers it; out of its bag, pure.

All times are system times of the hosts that sent the messages, as the middleware notes them when
a message is handed to it. On one host they are of one clock.
"""
