# SPDX-License-Identifier: Apache-2.0
"""Recordings of the graph: MCAP files in the layout of rosbag2, written and read."""

from srnn_bag.attached import Attachment
from srnn_bag.errors import BagError
from srnn_bag.mcap_file import Message
from srnn_bag.reader import Bag, open_bag
from srnn_bag.writer import BagWriter

__all__ = ['Attachment', 'Bag', 'BagError', 'BagWriter', 'Message', 'open_bag']
