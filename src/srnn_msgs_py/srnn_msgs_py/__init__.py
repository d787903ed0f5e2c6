# SPDX-License-Identifier: Apache-2.0
"""Everything that crosses a topic: value types here, converters in `srnn_msgs_py.ros`."""
