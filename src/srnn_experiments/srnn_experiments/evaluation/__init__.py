# SPDX-License-Identifier: Apache-2.0
"""The figures of the paper's evaluation, as numbers and captions; nothing is drawn here."""
