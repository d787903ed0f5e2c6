# SPDX-License-Identifier: Apache-2.0
"""Pure converters between the values and common_interfaces messages.

Every converter module has `to_msg` and, where somebody reads the message, `from_msg`.
Numbers go in as exact Python types: unless its field checks are on, rclpy sends
anything else as garbage without a word.
"""
