# SPDX-License-Identifier: Apache-2.0
"""The command ``raydix``."""

import argparse
import json
import os
import shlex
import shutil
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console
from rich.table import Table

from .command import INTEGER, status_of
from .config import Config, ConfigError
from .files import ROOT
from .formats import STEPS_MAX
from .hits import FrameHits
from .image import check_folder, frame_writers, write_files
from .options import add_scene_options, config_of, given, scene_of
from .progress import bars, working
from .rtl import TOP, build, top_parameters
from .scene import Scene

if TYPE_CHECKING:
    from .render import Verdict

THREADS_MAX = 256  # more than a picture has pieces for
WAVE_BYTES = {".vcd": 200_000, ".fst": 14_000}  # a pixel, about: torus, 16x12 and 32x24, eight units, 36 bits


def _add_scene_options(parser: argparse.ArgumentParser) -> None:
    add_scene_options(parser)
    threads = min(os.cpu_count() or 1, THREADS_MAX)
    parser.add_argument("--threads", type=INTEGER, default=threads, metavar="N", help="threads of the golden model")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="raydix", description="Ray casting of analytic surfaces, a few digits of the ray parameter per step."
    )
    commands = parser.add_subparsers(dest="command", required=True)
    render = commands.add_parser("render", help="render a scene: PNG, EXR and npz")
    render.add_argument("scene", type=Path, help="scene file (TOML)")
    _add_scene_options(render)
    render.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder for the pictures")
    render.add_argument("--backend", choices=("golden", "rtl"), default="golden", help="who computes (default: golden)")
    render.add_argument("--wave", type=Path, metavar="FILE", help="with --backend rtl: write a waveform, .vcd or .fst")
    render.add_argument("--frames", action="store_true", help="every frame of the scene's sequence, and a preview")
    render.add_argument("--resume", action="store_true", help="with --frames: only those that are not there yet")
    configure = commands.add_parser("configure", help="the smallest processor that renders a scene")
    configure.add_argument("scene", type=Path, help="scene file (TOML)")
    _add_scene_options(configure)
    configure.add_argument("--json", action="store_true", help="the parameters of rdx_top as JSON")
    verify = commands.add_parser("verify", help="render by golden model and RTL and compare them bit for bit")
    verify.add_argument("scene", type=Path, nargs="+", help="scene files (TOML), with different names")
    _add_scene_options(verify)
    verify.add_argument("--out", type=Path, metavar="DIR", help="folder (default: build/render/<scene>)")
    export = commands.add_parser("export", help="descriptor words and expected hits, for a test bench of your own")
    export.add_argument("scene", type=Path, help="scene file (TOML)")
    _add_scene_options(export)
    export.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder for the files")
    compare = commands.add_parser("compare", help="compare two outputs; exit status 1 if they differ")
    compare.add_argument("a", type=Path, metavar="A", help="an .npz, .exr or .png file, or a folder of render")
    compare.add_argument("b", type=Path, metavar="B", help="another")
    return parser


def _config(args: argparse.Namespace, scene: Scene) -> Config:
    """The configuration asked for."""
    if not 1 <= args.threads <= THREADS_MAX:
        raise ConfigError(f"threads: found {args.threads}; allowed: 1 to {THREADS_MAX}")
    return config_of(args, scene)


def _units(rings: int, units: int) -> str:
    """The step units of one ring, or of several."""
    return f"U = {units}" if rings == 1 else f"U = {rings} × {units}"


def _described(config: Config) -> str:
    """What is built of each ring."""
    parts = [f"n1 = {config.n1}, K = {config.steps}"]
    if config.degree:
        parts.append(f"W = {config.width}, D = {config.degree}, {_units(config.rings, config.units)}")
    if config.vecsum != "none":
        units = _units(config.vector_rings, config.vector_units)
        fewer = f", {config.vector_drop} digits left away" if config.vector_drop else ""
        parts.append(f"vector sums: {config.vecsum}, lanes = {config.lanes}, {units}{fewer}")
    return "; ".join(parts)


@contextmanager
def _progress() -> Iterator[Callable[[str], Callable[[int, int], None]]]:
    """Gives a function that makes one bar after the other; nothing is drawn where stderr is no terminal."""
    with bars() as shown:

        def bar(label: str) -> Callable[[int, int], None]:
            task = shown.add_task(label, total=None)
            return lambda done, total: shown.update(task, completed=done, total=total)

        yield bar


def _build(config: Config, trace: str | None = None) -> None:
    """Build the simulator, with a word about it: it takes a while."""
    described = f"{_described(config)}; about a minute, nothing if it stands"
    with working(f"building the RTL with Verilator ({described})", "raydix"):
        build(config, trace, TOP)


def _say_what_is_seen(scene: Scene, hits: FrameHits) -> None:
    """A word on stderr where not all surfaces are in view, and where rays were given up."""
    hidden = len(scene.surfaces) - len(hits.compiled.surfaces)
    if hidden:
        print(f"raydix: {hidden} of {len(scene.surfaces)} surfaces are out of view", file=sys.stderr)
    lost = hits.counts()["given_up"]
    if lost:
        print(f"raydix: {lost} rays were given up after {STEPS_MAX} steps; roots may be missing", file=sys.stderr)


def _render(args: argparse.Namespace) -> int:
    from .render import render_golden, render_rtl

    scene = scene_of(args, args.scene)
    config = _config(args, scene)
    check_folder(args.out)
    if args.frames:
        return _render_frames(args, scene, config)
    if args.resume:
        raise ConfigError("resume: found for a single frame; allowed: with --frames")
    if args.wave and args.backend != "rtl":
        raise ConfigError(f"wave: found '{args.wave}' with the golden model; allowed: with --backend rtl")
    if args.wave:
        _check_wave(args.wave, scene)
    if args.backend == "rtl":
        _build(config, args.wave.suffix[1:] if args.wave else None)
    with _progress() as bar:
        if args.backend == "golden":
            frame = render_golden(scene, config, args.threads, bar("golden model, rays"))
        else:
            frame = render_rtl(scene, config, bar("RTL, rays"), args.wave)
    _say_what_is_seen(scene, frame.hits)
    for path in write_files(frame_writers(frame, args.out, scene.name)):
        print(path)
    return 0


def _check_wave(wave: Path, scene: Scene) -> None:
    """A word about the size of a waveform. Raises ConfigError and ImageError where it cannot be written."""
    if wave.suffix not in WAVE_BYTES:
        raise ConfigError(f"wave: found '{wave}'; allowed: a file {' or '.join(WAVE_BYTES)}")
    check_folder(wave.parent)
    camera = scene.camera
    size = camera.width * camera.height * WAVE_BYTES[wave.suffix]
    there = next(path for path in (wave.absolute().parent, *wave.absolute().parents) if path.exists())
    free = shutil.disk_usage(there).free
    text = f"{size / 1e9:.1f} GB for {camera.width}×{camera.height} pixels"
    if size > free:
        raise ConfigError(
            f"wave: found about {text}; allowed: less than {free / 1e9:.1f} GB, what is free: a smaller --size"
        )
    if size > 1e9:
        print(f"raydix: the waveform takes about {text}; less: a smaller --size", file=sys.stderr)


def _render_frames(args: argparse.Namespace, scene: Scene, config: Config) -> int:
    """A sequence: a PNG for each frame as soon as it is there, and an animated preview."""
    from .sequence import Kept, render_sequence

    if not scene.cameras:
        raise ConfigError(f"frames: found no sequence in {scene.path}; allowed: a scene with [turntable] or [[frame]]")
    if args.wave:
        raise ConfigError("wave: found with --frames; allowed: with a single frame")
    kept = Kept(scene, config, args.backend, args.out)
    numbers = kept.resume() if args.resume else list(range(len(kept.paths)))
    if len(numbers) < len(kept.paths):
        print(f"raydix: {len(kept.paths) - len(numbers)} of {len(kept.paths)} frames are there", file=sys.stderr)
    if numbers and args.backend == "rtl":
        _build(config)
    with _progress() as bar:
        progress = bar(f"{args.backend}, frames")
        for number, rgb in render_sequence(scene, config, args.backend, numbers, args.threads, progress):
            kept.keep(number, rgb)
    preview = args.out / f"{scene.name}.gif"
    kept.preview(preview)
    for path in (*kept.paths, preview):
        print(path)
    return 0


def _configure(args: argparse.Namespace) -> int:
    """Parameters of rdx_top, and what each of them is for."""
    scene = scene_of(args, args.scene)
    config = _config(args, scene)
    values = top_parameters(config)
    if args.json:
        print(json.dumps(values, indent=2))
        return 0
    table = Table("parameter", "value", "because")
    opaque = all(s.opacity == 1 for s in scene.surfaces)
    reasons = {
        "N1": "asked for", "K": "digits of t over N1", "W": "asked for", "U": "asked for",
        "D": {0: "no algebraic surface", 2: "quadrics only", 4: "a quartic"}[config.degree],
        "Rules": f"the {config.rule} rule only",
        "Clip": "a box cuts an algebraic surface" if config.clip else "no box cuts an algebraic surface",
        "HalveStages": "asked for, or two rows of averages a clock",
        "Vecsum": {"none": "no spiral", "helix": "helices only", "general": "spirals that grow, or parts of a turn"}[
            config.vecsum
        ],
        "Lanes": "asked for, or J - 1", "VectorUnits": "asked for", "VectorDrop": "asked for", "Rings": "asked for",
        "VectorRings": "asked for",
        "Surfaces": "surfaces of the scene",
        "Layers": "all surfaces are opaque" if opaque else "roots of the transparent surfaces, and one",
        "MaxWidth": "columns of the picture", "Pixels": "asked for",
    }  # fmt: skip
    for name, value in values.items():
        table.add_row(name, str(value), reasons[name])
    Console().print(table)
    print(" ".join(f"-G{name}={value}" for name, value in values.items()))
    return 0


def _table(verdicts: "dict[str, Verdict]") -> Table:
    """Golden model and RTL side by side, for each scene."""
    table = Table()
    table.add_column("")
    sides, bits = [], []
    for name, verdict in verdicts.items():
        for label, frame in (("golden", verdict.golden), ("RTL", verdict.rtl)):
            table.add_column(f"{name}\n{label}", justify="right")
            sides.append((frame.hits, frame.hits.counts(), frame.t.size))
            bits.append(f"{verdict.hit_bits + verdict.image_bits:,}" if label == "RTL" else "–")
    rows = {
        "time, s": [f"{hits.seconds:.3f}" for hits, _, _ in sides],
        "Mpixel/s": [f"{pixels / hits.seconds / 1e6:.2f}" if counts["rays"] else "–" for hits, counts, pixels in sides],
        "rays": [f"{counts['rays']:,}" for _, counts, _ in sides],
        "rays that hit": [f"{counts['hit_rays']:,}" for _, counts, _ in sides],
        "hits": [f"{counts['hits']:,}" for _, counts, _ in sides],
        "steps per hitting ray": [f"{counts['steps_per_hit']:.3f}" for _, counts, _ in sides],
        "steps per missing ray": [f"{counts['steps_per_miss']:.3f}" for _, counts, _ in sides],
        "cycles": [f"{hits.cycles:,}" if hits.cycles else "–" for hits, _, _ in sides],
        "cycles per ray": [
            f"{hits.cycles / counts['rays']:.4f}" if hits.cycles and counts["rays"] else "–"
            for hits, counts, _ in sides
        ],
        "differing bits": bits,
    }
    for name, values in rows.items():
        table.add_row(name, *values)
    return table


def _verify(args: argparse.Namespace) -> int:
    from .render import verify, write_verdict

    if args.out and len(args.scene) > 1:
        raise ConfigError(f"out: found a folder for {len(args.scene)} scenes; allowed: with one scene")
    work = []
    for path in args.scene:
        scene = scene_of(args, path)
        work.append((scene, _config(args, scene), args.out or Path("build", "render", scene.name)))
    names = [scene.name for scene, _, _ in work]
    if len(set(names)) < len(names):
        raise ConfigError(f"scene: found the names {', '.join(names)}; allowed: files with different names")
    for _, _, out in work:
        check_folder(out)
    verdicts: dict[str, Verdict] = {}
    for scene, config, out in work:
        _build(config)
        with _progress() as bar:
            bars = bar(f"{scene.name}: golden model, rays"), bar(f"{scene.name}: RTL, rays")
            verdict = verify(scene, config, args.threads, bars)
        write_verdict(verdict, out, scene.name, config)
        _say_what_is_seen(scene, verdict.golden.hits)
        verdicts[scene.name] = verdict
        print(f"{scene.name}, {scene.camera.width}×{scene.camera.height}, {config.rule} rule: {_described(config)}")
    shown = list(verdicts.items())
    for i in range(0, len(shown), 2):  # two scenes fit a terminal of 80 columns
        Console().print(_table(dict(shown[i : i + 2])))
    for verdict, (scene, config, out) in zip(verdicts.values(), work, strict=True):
        print(
            f"{scene.name}: {verdict.hit_bits} bits differ in the hits, {verdict.image_bits} in the images; "
            f"pictures: {out}/golden, {out}/rtl, {out}/{scene.name}-difference.png"
        )
        if verdict.hit_bits or verdict.image_bits:
            print(f"{scene.name}: {_replay(verdict, config, scene, args)}", flush=True)
            if where := _localise(verdict, config, scene, out):
                print(f"{scene.name}: {where}")
    return int(any(v.hit_bits or v.image_bits for v in verdicts.values()))


def _replay(verdict: "Verdict", config: Config, scene: Scene, args: argparse.Namespace) -> str:
    """The first ray that differs, with the command that follows it through both, in the same design."""
    ray = verdict.first_ray()
    if ray is None:
        y, x = divmod(int(verdict.differing().argmax()), scene.camera.width)
        return f"the first pixel that differs is {x},{y}, where no surface can be: the mistake is behind the rings"
    x, y, surface = ray
    options = argparse.Namespace(**vars(args) | {"units": config.units})  # those of trace_ray are 1 if not given
    words = [_from_here(Path(sys.executable)), _from_here(ROOT / "scripts" / "trace_ray.py"), str(scene.path)]
    words += ["--pixel", f"{x},{y}", *([] if surface is None else ["--surface", str(surface)]), *given(options)]
    return f"the first pixel that differs is {x},{y}; step by step: {shlex.join(words)}"


def _localise(verdict: "Verdict", config: Config, scene: Scene, out: Path) -> str:
    """The first step and signal in which the first ray that differs does; empty where no ray does."""
    from .localise import follow_both, surfaces_at
    from .rtl import RtlError

    ray = verdict.first_ray()
    if ray is None:
        return ""
    x, y, number = ray
    compiled = verdict.golden.hits.compiled
    _build(config, "vcd")
    for surface in surfaces_at(compiled, x, y, number):
        wave = out / f"{scene.name}-{x}-{y}-surface{surface.index}.vcd"
        try:
            with working(f"following the ray on surface {surface.index}"):
                first = follow_both(scene, compiled, surface, config, x, y, wave).first
        except RtlError as error:
            return f"surface {surface.index}, the ray alone: {error}; waveform: {wave}"
        if first:
            return f"RTL and golden model differ: surface {surface.index}, {first}; waveform: {wave}"
    return (
        "alone, the ray has the same steps, hits and colour in both: the mistake is before it (raster, skipping), "
        "or comes only beside other rays or surfaces"
    )


def _from_here(path: Path) -> str:
    """A path as one would type it."""
    return str(path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path)


def _export(args: argparse.Namespace) -> int:
    from .export import export

    scene = scene_of(args, args.scene)
    config = _config(args, scene)
    check_folder(args.out)
    with _progress() as bar:
        paths = export(scene, config, args.out, bar("golden model, rays"))
    print("\n".join(map(str, paths)))
    return 0


def _compare(args: argparse.Namespace) -> int:
    from .compare import compare

    lines = compare(args.a, args.b)
    print("\n".join(lines) if lines else "equal")
    return int(bool(lines))


def main(argv: list[str] | None = None) -> int:
    """Run the command line. Exit status: 0 fine, 1 outputs differ, 2 bad input, 130 interrupted."""
    args = _parser().parse_args(argv)
    commands = {"render": _render, "verify": _verify, "export": _export, "compare": _compare, "configure": _configure}
    more = "; --resume goes on" if getattr(args, "frames", False) else ""
    return status_of(lambda: commands[args.command](args), "raydix", more)


if __name__ == "__main__":
    sys.exit(main())
