# SPDX-License-Identifier: Apache-2.0
"""Starts the graph of the workspace and watches it: the `srnn` command and what it needs."""
