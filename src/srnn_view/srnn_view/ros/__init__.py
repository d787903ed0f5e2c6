# SPDX-License-Identifier: Apache-2.0
"""What of this package needs ROS."""
