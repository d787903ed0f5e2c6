# SPDX-License-Identifier: Apache-2.0
"""DDS security: a keystore, who may do what, and whether the middleware enforces it."""
