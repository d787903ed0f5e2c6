# SPDX-License-Identifier: Apache-2.0
"""A run, or an experiment, as one web page that needs nothing else."""
