# SPDX-License-Identifier: Apache-2.0
"""Coverage of a module by its own test: what Verilator counts, merged over parameter sets, and what is waived.

Points  block   a block of statements or a branch of the module's source, once per place in the source
        toggle  a bit of a port or signal in one direction, 0->1 or 1->0
        bin     a cover property of ``tb/cover/rdx_<module>_cover.sv``, once per instance of its generate loops
"""

import ast
import gzip
import hashlib
import os
import re
import tomllib
from collections.abc import Container, Iterable
from pathlib import Path
from typing import NamedTuple

from .files import ROOT

COVER = ROOT / "tb" / "cover"
MANIFEST = "RAYDIX_COVERAGE"  # environment: scripts/cover.py sets it to a file that names of results are appended to
RESULTS = ROOT / "build" / "coverage"
WAIVERS = ROOT / "tb" / "coverage.toml"
NEEDED = {"module", "kind", "constant", "points", "reason"}  # of a waiver
KINDS = {"line": "block", "branch": "block", "toggle": "toggle", "user": "bin"}
WIDEST = 2048  # bits of a signal in all; wider ones are memories and delay lines

FIELD = re.compile("\x01([^\x02]*)\x02([^\x01']*)")
LOOP = re.compile(r"__BRA__(\d+)__KET__")


class Point(NamedTuple):
    """A place that can be covered; ``name`` tells those of one place apart."""

    kind: str
    module: str
    file: str
    line: int
    column: int
    name: str


# ---------------------------------------------------------------- for the builds and runs of bench.py


def cover_sources(toplevel: str) -> list[Path]:
    """The file of the module's bins, if there is one."""
    file = COVER / f"{toplevel}_cover.sv"
    return [file] if file.exists() else []


def arguments() -> list[str]:
    """What Verilator needs to count points, except for :func:`configuration`."""
    kinds = ["--coverage-line", "--coverage-toggle", "--coverage-user", "--coverage-max-width", str(WIDEST)]
    return [*kinds, f"-I{COVER}"]


def owner(module: str) -> str:
    """The module whose test is that of ``module``: itself, or the one whose name its own begins with (without rdx_)."""
    while not (ROOT / "tb" / f"test_{module}.py").exists() and "_" in module:
        module = module.rpartition("_")[0]
    return module


def configuration(toplevel: str, files: Iterable[Path]) -> str:
    """Text of a .vlt file that leaves out the other modules of ``files``: their own tests count their points."""
    own = {path.stem for path in files if f"rdx_{owner(path.stem.removeprefix('rdx_'))}" == toplevel}
    others = [path for path in files if path.stem not in own | {"rdx_pkg"}]
    return "`verilator_config\n" + "".join(f'coverage_off -file "{path}"\n' for path in others)


def _imports(file: Path) -> set[str]:
    """Names that a Python file imports, and all parts of the names of their modules."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import | ast.ImportFrom):
            names.update(alias.name for alias in node.names)
            names.update((getattr(node, "module", "") or "").split("."))
    return names


def texts(test: str) -> bytes:
    """What a test depends on: its own text and those of the files of ``tb`` and of the model that it imports."""
    files = {path.stem: path for folder in (ROOT / "model" / "raydix", ROOT / "tb") for path in folder.glob("*.py")}
    found, new = set(), {test} & files.keys()
    while new:
        found |= new
        new = set().union(*(_imports(files[name]) for name in new)) & files.keys() - found
    return b"".join(files[name].read_bytes() for name in sorted(found))


def result_file(target: Path, test: str, checks: list[str] | None, seed: int) -> Path:
    """Where the counts of a run are kept: its name depends on the build, the test's texts, the checks and the seed."""
    facts = texts(test) + repr((checks, seed)).encode()
    return RESULTS / f"{target.name}-{hashlib.sha256(facts).hexdigest()[:12]}.dat.gz"


def keep(counts: Path, result: Path) -> None:
    """Compress a run's counts into their place."""
    RESULTS.mkdir(parents=True, exist_ok=True)
    part = result.with_suffix(f".{counts.parent.name}")
    part.write_bytes(gzip.compress(counts.read_bytes(), 5))
    part.replace(result)


def note(result: Path) -> None:
    """Tell ``scripts/cover.py`` of a result: a line in the file that the environment names."""
    with open(os.environ[MANIFEST], "a") as file:
        file.write(f"{result.name}\n")


# ---------------------------------------------------------------- reading and merging


def read(lines: Iterable[str]) -> dict[Point, int]:
    """Points of a coverage file of Verilator and how often each was hit. Raises ValueError where it is no such file."""
    lines = iter(lines)
    if not next(lines, "").startswith("# SystemC::Coverage-3"):
        raise ValueError("not a coverage file of Verilator")
    points: dict[Point, int] = {}
    for line in lines:
        key, _, count = line.rpartition(" ")
        fields = dict(FIELD.findall(key))
        if fields.get("t") not in KINDS:
            raise ValueError(f"unknown kind of point: {line.strip()!r}")
        kind, file, name = KINDS[fields["t"]], Path(fields["f"]), fields["o"]
        if (kind == "bin") != file.stem.endswith("_cover"):
            continue  # ports of a cover module
        if kind == "bin":  # with its place in generate loops
            name = LOOP.sub(r"[\1]", fields["h"].split(".", 2)[2]).replace("__DOT__", ".")
        module = file.stem.removeprefix("rdx_").removesuffix("_cover")
        point = Point(kind, module, str(file), int(fields["l"]), int(fields["n"]), name)
        points[point] = points.get(point, 0) + int(count)
    return points


def merge(files: Iterable[Path]) -> dict[Point, int]:
    """Points of any of the files, with the sums of their counts."""
    total: dict[Point, int] = {}
    for file in files:
        with gzip.open(file, "rt") as lines:
            for point, count in read(lines).items():
                total[point] = total.get(point, 0) + count
    return total


# ---------------------------------------------------------------- waivers and gaps


class Waiver(NamedTuple):
    """Points of one kind and module (*: every one) that need not be covered: patterns of their labels, and why.

    constant  True: no legal stimulus reaches them; False: this test does not, and another one does
    """

    module: str
    kind: str
    constant: bool
    points: tuple[re.Pattern, ...]
    reason: str


def label(point: Point, text: dict[str, list[str]]) -> str:
    """What a waiver's pattern is compared with: the line's text of a block, the name of a signal's bit or of a bin."""
    if point.kind == "block":
        if point.file not in text:
            text[point.file] = Path(point.file).read_text().splitlines()
        return text[point.file][point.line - 1].strip()
    return point.name.rsplit(":", 1)[0] if point.kind == "toggle" else point.name


def waivers(file: Path) -> list[Waiver]:
    """Waivers of a TOML file. Raises ValueError, with what is allowed, where a table is not one."""
    found = []
    try:
        tables = tomllib.loads(file.read_text())["waiver"]
    except tomllib.TOMLDecodeError as error:
        raise ValueError(f"{file}: {error}") from error
    for number, table in enumerate(tables, 1):
        kind, constant = table.get("kind"), table.get("constant")
        if set(table) != NEEDED or kind not in KINDS.values() or not isinstance(constant, bool):
            names = "module, kind (block, toggle or bin), constant (true or false), points, reason"
            raise ValueError(f"{file}: waiver {number}: found {', '.join(table)}; needed: {names}")
        if not table["reason"].strip():
            raise ValueError(f"{file}: waiver {number}: a reason is needed")
        try:
            patterns = tuple(map(re.compile, table["points"]))
        except re.error as error:
            raise ValueError(f"{file}: waiver {number}: the pattern {error.pattern!r}: {error}") from error
        found.append(Waiver(table["module"], kind, constant, patterns, table["reason"]))
    return found


def apply(points: dict[Point, int], rules: list[Waiver]) -> tuple[dict[Point, bool], list[str]]:
    """Points that are not hit and waived, with whether they are constant; patterns that waive nothing, as sentences."""
    text: dict[str, list[str]] = {}
    waived: dict[Point, bool] = {}
    idle = []
    modules = {point.module for point in points}
    missed = [point for point, count in points.items() if not count]
    for rule in rules:
        if rule.module not in (*modules, "*"):
            continue  # another run
        mine = [p for p in missed if p.kind == rule.kind and rule.module in (p.module, "*")]
        for pattern in rule.points:
            matching = [p for p in mine if pattern.fullmatch(label(p, text))]
            waived.update((point, rule.constant or waived.get(point, False)) for point in matching)
            if not matching and rule.module != "*":
                idle.append(f"{rule.module}: the waiver of {rule.kind} {pattern.pattern!r} waives nothing")
    return waived, idle


def gaps(points: dict[Point, int], waived: Container[Point]) -> list[str]:
    """A line for each block, signal or bin that is neither hit nor waived: file:line, and which bits."""
    text: dict[str, list[str]] = {}
    found: dict[tuple, list[str]] = {}
    for point in sorted(points):
        if points[point] or point in waived:
            continue
        name, bits = label(point, text), ""
        if point.kind == "toggle":
            name, _, bit = name.rpartition("[") if name.endswith("]") else (name, "", "]")
            bits = f"{bit[:-1]}:{point.name.rsplit(':', 1)[1]}".lstrip(":")
        elif point.kind == "block":
            bits = point.name
        place = str(Path(point.file).relative_to(ROOT)) if point.file.startswith(str(ROOT)) else point.file
        found.setdefault((place, point.line, point.kind, name), []).append(bits)
    return [f"{p}:{line}: {kind} {name} {_shorter(bits)}".rstrip() for (p, line, kind, name), bits in found.items()]


def _shorter(bits: list[str], most: int = 6) -> str:
    """The first few of a long list, and how many there are."""
    return " ".join(bits) if len(bits) <= most else f"{' '.join(bits[:most])} … ({len(bits)})"


class Row(NamedTuple):
    """Counts of one module and kind; those that are waived as constant, and as left to other tests."""

    hit: int
    total: int
    constant: int
    left: int


def rows(points: dict[Point, int], waived: dict[Point, bool]) -> dict[str, dict[str, Row]]:
    """Counts by module and kind."""
    table: dict[str, dict[str, Row]] = {}
    for module in sorted({point.module for point in points}):
        mine = {p: n for p, n in points.items() if p.module == module}
        table[module] = {}
        for kind in ("block", "toggle", "bin"):
            those = [p for p in mine if p.kind == kind]
            why = [waived[p] for p in those if p in waived]
            table[module][kind] = Row(sum(mine[p] > 0 for p in those), len(those), sum(why), len(why) - sum(why))
    return table
