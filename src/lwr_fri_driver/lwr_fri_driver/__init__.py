# SPDX-License-Identifier: Apache-2.0
"""Drives a real KUKA LWR 4+ over its Fast Research Interface (FRI 1.0, KRC2lr)."""
