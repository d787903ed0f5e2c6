# SPDX-License-Identifier: Apache-2.0
"""`srnn doctor`: what is wrong with a machine, and what to do about it."""
