# SPDX-License-Identifier: Apache-2.0
"""The driver without sockets, clocks and ROS: state in, state out, time as an argument."""
