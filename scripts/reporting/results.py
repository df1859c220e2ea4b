# SPDX-License-Identifier: Apache-2.0
"""Results of the regression as pytest writes them (JUnit XML)."""

import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from pathlib import Path


class ResultsError(RuntimeError):
    """A file of results cannot be read; the text is one line."""


@dataclass
class Module:
    """Tests of one file of ``tb/``."""

    name: str
    passed: int = 0
    failed: int = 0
    skipped: int = 0
    seconds: float = 0.0


@dataclass
class Run:
    """One run of the regression.

    name      of the file: "test", "regress", or the module's
    when      start, ISO 8601
    failures  (test, first line of what it said)
    """

    name: str
    when: str
    modules: list[Module] = field(default_factory=list)
    failures: list[tuple[str, str]] = field(default_factory=list)

    def total(self, field: str) -> float:
        """Sum over the modules of "passed", "failed", "skipped" or "seconds" (of all workers together)."""
        return sum(getattr(module, field) for module in self.modules)


def read_run(path: Path) -> Run:
    """Results of one run. Raises :class:`ResultsError`."""
    try:
        suite = next(ElementTree.parse(path).iter("testsuite"))
    except (OSError, ElementTree.ParseError, StopIteration) as error:
        raise ResultsError(f"{path}: found no results of pytest ({error}); make test writes them") from None
    modules, failures = {}, []
    for case in suite.iter("testcase"):
        name = case.get("classname", "").rpartition(".")[2].removeprefix("test_")
        module = modules.setdefault(name, Module(name))
        try:
            module.seconds += float(case.get("time", 0))
        except ValueError:
            raise ResultsError(f"{path}: found the time {case.get('time')!r}; allowed: seconds") from None
        wrong = [case.find(kind) for kind in ("failure", "error") if case.find(kind) is not None]
        if wrong:
            module.failed += 1
            said = (wrong[0].get("message") or "").strip().splitlines()
            failures.append((f"{name}: {case.get('name')}", said[0] if said else ""))
        elif case.find("skipped") is not None:
            module.skipped += 1
        else:
            module.passed += 1
    ordered = sorted(modules.values(), key=lambda module: (-module.failed, module.name))
    return Run(path.stem, suite.get("timestamp", "")[:19].replace("T", " "), ordered, failures)


def read_runs(folder: Path) -> list[Run]:
    """Every run in ``folder``, the largest first."""
    return sorted(map(read_run, folder.glob("*.xml")), key=lambda run: -len(run.modules))
