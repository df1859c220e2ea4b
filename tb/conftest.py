# SPDX-License-Identifier: Apache-2.0
"""What is asked of a run of the tests by the environment is looked at before the first of them."""

import argparse
import os

import pytest

from raydix.command import SEED


def pytest_configure() -> None:
    """Raises UsageError where SEED is no seed."""
    if text := os.environ.get("SEED"):
        try:
            SEED(text)
        except argparse.ArgumentTypeError as error:
            raise pytest.UsageError(f"SEED: {error}") from None
