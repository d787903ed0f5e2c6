# SPDX-License-Identifier: Apache-2.0
"""A running graph as a local web page: the arm, what it plans and what it learns."""
