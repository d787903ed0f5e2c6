# SPDX-License-Identifier: Apache-2.0
"""What several nodes of this package share."""
