# SPDX-License-Identifier: Apache-2.0
"""Programs of scripts/ as modules of a test."""

import importlib
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

SCRIPTS = Path(__file__).resolve().parents[1] / "scripts"


@contextmanager
def scripts(*names: str) -> Iterator[SimpleNamespace]:
    """The names of all these modules together, a later one's before an earlier one's; found as when they are run."""
    sys.path.insert(0, str(SCRIPTS))
    try:
        modules = [importlib.import_module(name) for name in names]
        yield SimpleNamespace(**{name: value for module in modules for name, value in vars(module).items()})
    finally:
        sys.path.remove(str(SCRIPTS))
