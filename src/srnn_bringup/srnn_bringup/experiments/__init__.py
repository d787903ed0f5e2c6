# SPDX-License-Identifier: Apache-2.0
"""`srnn experiment`: trials on simulated time, their figures and reports."""
