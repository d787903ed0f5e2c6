# SPDX-License-Identifier: Apache-2.0
"""Recorded decisions made again, without middleware, and compared bit for bit."""
