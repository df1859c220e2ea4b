# SPDX-License-Identifier: Apache-2.0
"""Raydix: golden model, scene compiler and tools of the ray-casting processor in ``rtl/``."""

__version__ = "0.1.0"
