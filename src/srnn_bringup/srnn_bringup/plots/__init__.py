# SPDX-License-Identifier: Apache-2.0
"""How things are drawn; every picture shows plain numbers that were computed elsewhere."""
