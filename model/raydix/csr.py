# SPDX-License-Identifier: Apache-2.0
"""What is generated from ``rtl/rdx_csr.rdl``: the register block, a C header, HTML, a Python map, tables of the docs.

The Python map is made here, by a walk through the compiled description: PeakRDL's own for Python makes a package of
classes, where names, addresses and fields are all that a host or a test wants.
"""

import argparse
import fcntl
import hashlib
import os
import shutil
import sys
import tempfile
from dataclasses import dataclass
from importlib.machinery import SourceFileLoader
from importlib.metadata import version
from pathlib import Path
from types import ModuleType

from .blocks import markdown_table, replace_block

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "rtl" / "rdx_csr.rdl"
BUILD = ROOT / "build" / "csr"
DOC = ROOT / "docs" / "registers.md"
TOP = "rdx_csr_regs"
ERRORS = "rdx_error_e"
TOOLS = ("systemrdl-compiler", "peakrdl-regblock", "peakrdl-cheader", "peakrdl-html")


@dataclass(frozen=True)
class Generated:
    """Paths of what was generated."""

    rtl: tuple[Path, Path]  # package, module
    header: Path
    html: Path
    python: Path


GENERATED = Generated(
    (BUILD / f"{TOP}_pkg.sv", BUILD / f"{TOP}.sv"), BUILD / "rdx_csr.h", BUILD / "html", BUILD / "rdx_csr_map.py"
)


def elaborated():
    """The compiled description; the compiler writes its complaints to stderr and raises RDLCompileError."""
    from peakrdl_regblock.udps import ALL_UDPS
    from systemrdl import RDLCompiler

    compiler = RDLCompiler()
    for definition in ALL_UDPS:
        compiler.register_udp(definition, soft=True)
    compiler.compile_file(str(SOURCE))
    return compiler.elaborate(TOP)


# ---------------------------------------------------------------- registers as plain data


def _access(field) -> str:
    """How software reaches a field: r, rw, w, or w1c (read; writing 1 clears)."""
    if field.get_property("onwrite") is not None:
        assert field.get_property("onwrite").name == "woclr", field.get_path()
        return "w1c"
    return field.get_property("sw").name


def _fields(register) -> dict:
    fields = {}
    for field in register.fields():
        fields[field.inst_name] = {
            "low": field.low,
            "width": field.width,
            "access": _access(field),
            "reset": field.get_property("reset"),  # None: driven by hardware
            "unit": field.get_property("rdx_unit") or "",
            "text": field.get_property("desc"),
        }
    return fields


def registers(root) -> dict[str, dict]:
    """Name to address, text and fields."""
    return {
        node.inst_name: {"address": node.absolute_address, "text": node.get_property("desc"), "fields": _fields(node)}
        for node in root.top.registers()
    }


def windows(root) -> dict[str, dict]:
    """Name to address, bytes, access and text."""
    from systemrdl.node import MemNode

    return {
        node.inst_name: {
            "address": node.absolute_address,
            "size": node.size,
            "access": node.get_property("sw").name,
            "text": node.get_property("desc"),
        }
        for node in root.top.children()
        if isinstance(node, MemNode)
    }


def errors(root) -> dict[str, tuple[int, str]]:
    """Name to code and meaning."""
    members = root.top.get_child_by_name("ERROR").get_child_by_name("code").get_property("encode").members
    return {name: (member.value, member.rdl_desc) for name, member in members.items()}


def _python(root) -> str:
    """Text of the Python map."""
    lines = [
        "# Generated from rtl/rdx_csr.rdl by raydix.csr.",
        '"""Registers, windows and error codes of rdx_csr."""',
        "",
    ]
    for name, table in (("REGISTERS", registers(root)), ("WINDOWS", windows(root)), ("ERRORS", errors(root))):
        lines += [f"{name} = {{", *(f"    {key!r}: {value!r}," for key, value in table.items()), "}"]
    return "\n".join([*lines, ""])


# ---------------------------------------------------------------- generation


def _export(folder: Path) -> None:
    """Write everything into ``folder``, with the names of GENERATED."""
    from peakrdl_cheader.exporter import CHeaderExporter
    from peakrdl_html import HTMLExporter
    from peakrdl_regblock import RegblockExporter
    from peakrdl_regblock.cpuif.axi4lite import AXI4Lite_Cpuif_flattened

    root = elaborated()
    RegblockExporter().export(
        root, str(folder), cpuif_cls=AXI4Lite_Cpuif_flattened, default_reset_activelow=True, err_if_bad_addr=True,
        err_if_bad_rw=True, reuse_hwif_typedefs=False,
    )  # fmt: skip
    CHeaderExporter().export(root, str(folder / GENERATED.header.name), reuse_typedefs=False)
    HTMLExporter(generate_source_links=False).export(root, str(folder / GENERATED.html.name))
    (folder / GENERATED.python.name).write_text(_python(root))


def generate() -> Generated:
    """Generate into ``build/csr``, unless the same was done before; the paths."""
    facts = [SOURCE.read_bytes(), Path(__file__).read_bytes(), repr([version(tool) for tool in TOOLS]).encode()]
    digest = hashlib.sha256(b"".join(facts)).hexdigest()
    stamp = BUILD / "digest"
    paths = (*GENERATED.rtl, GENERATED.header, GENERATED.html, GENERATED.python)
    BUILD.mkdir(parents=True, exist_ok=True)
    with open(BUILD.parent / "csr.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # a second process waits for the first one
        if stamp.exists() and stamp.read_text() == digest and all(path.exists() for path in paths):
            return GENERATED
        stamp.unlink(missing_ok=True)
        with tempfile.TemporaryDirectory(prefix="csr-", dir=BUILD.parent) as folder:
            _export(Path(folder))
            for path in paths:
                if path.is_dir():
                    shutil.rmtree(path)
                os.replace(Path(folder, path.name), path)
        stamp.write_text(digest)
    return GENERATED


def address_map() -> ModuleType:
    """The generated Python map, imported: REGISTERS, WINDOWS, ERRORS."""
    loader = SourceFileLoader("rdx_csr_map", str(generate().python))
    module = ModuleType(loader.name)
    loader.exec_module(module)
    return module


# ---------------------------------------------------------------- tables of docs/registers.md

ACCESS = {"r": "read", "w": "write", "rw": "read, write", "w1c": "read, write 1 to clear"}


def _register_table(root) -> str:
    rows = []
    for name, register in registers(root).items():
        rows.append([f"`{register['address']:#05x}`", f"**{name}**", "", "", "", register["text"]])
        for field, f in register["fields"].items():
            bits = f"{f['low'] + f['width'] - 1}:{f['low']}" if f["width"] > 1 else str(f["low"])
            reset = "–" if f["reset"] is None else f"{f['reset']:#x}"
            text = f["text"] + (f" ({f['unit']})" if f["unit"] else "")
            rows.append(["", f"`{field}`", bits, ACCESS[f["access"]], reset, text])
    return markdown_table(("address", "register, field", "bits", "access", "reset", "meaning"), rows)


def _window_table(root) -> str:
    rows = [
        [f"`{w['address']:#07x}`", f"**{name}**", f"{w['size'] // 1024} KiB", ACCESS[w["access"]], w["text"]]
        for name, w in windows(root).items()
    ]
    return markdown_table(("address", "window", "size", "access", "meaning"), rows)


def _error_table(root) -> str:
    rows = [[str(code), f"`{name}`", text] for name, (code, text) in errors(root).items()]
    return markdown_table(("code", "name", "meaning"), rows)


def drift(write: bool = False) -> bool:
    """Whether a table of docs/registers.md differs from the description; with ``write`` they are brought up to date."""
    root = elaborated()
    stale = False
    for name, make in (("registers", _register_table), ("windows", _window_table), ("errors", _error_table)):
        begin, end = f"<!-- BEGIN generated: {name} -->\n", f"<!-- END generated: {name} -->\n"
        stale |= replace_block(DOC, begin, end, "\n" + make(root) + "\n", write)
    return stale


def main() -> int:
    """Command line of the generator."""
    parser = argparse.ArgumentParser(description="registers: generate build/csr; check, or write, docs/registers.md")
    parser.add_argument("--write", action="store_true", help="bring docs/registers.md up to date")
    args = parser.parse_args()
    made = generate()
    for path in (*made.rtl, made.header, made.html, made.python):
        print(path.relative_to(ROOT))
    stale = drift(args.write)
    if stale:
        print(f"{'written' if args.write else 'differs'}: {DOC.relative_to(ROOT)}")
    return int(stale and not args.write)


if __name__ == "__main__":
    sys.exit(main())
