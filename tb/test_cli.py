# SPDX-License-Identifier: Apache-2.0
"""The command line: what it writes, what it refuses, and its exit status."""

import csv
import json
import os
import shlex
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import OpenImageIO as oiio
import pytest

from raydix import cli, image, render
from raydix.cli import main
from raydix.config import Config, ConfigError
from raydix.fit import families, frame_parameters
from raydix.image import CHANNELS
from raydix.scene import load_scene

ROOT = Path(__file__).resolve().parents[1]
RAYDIX = Path(sys.executable).parent / "raydix"
TORUS = (ROOT / "scenes" / "torus.toml").read_text()
SMALL = ["--size", "48x36", "--threads", "1"]


@pytest.fixture(scope="module")
def rendered(tmp_path_factory):
    """A small torus by the golden model, through the installed command."""
    out = tmp_path_factory.mktemp("golden")
    run = subprocess.run(
        [RAYDIX, "render", ROOT / "scenes" / "torus.toml", *SMALL, "--out", out], capture_output=True, text=True
    )
    assert run.returncode == 0, run.stderr
    assert [Path(line).name for line in run.stdout.split()] == ["torus.png", "torus.exr", "torus.npz"]
    return out


def test_npz_is_as_documented(rendered):
    """Names, types and shapes of the arrays, and their values at a miss."""
    data = np.load(rendered / "torus.npz")
    kinds = {name: (data[name].dtype.name, data[name].shape) for name in data.files}
    assert kinds == {
        "depth": ("float64", (36, 48)),
        "t": ("int64", (36, 48)),
        "surface": ("int16", (36, 48)),
        "normal": ("float32", (36, 48, 3)),
        "rgb": ("uint8", (36, 48, 3)),
    }
    miss = data["surface"] == -1
    assert 0 < miss.sum() < miss.size
    assert np.isinf(data["depth"][miss]).all() and (data["t"][miss] == -1).all() and (data["normal"][miss] == 0).all()
    hit = ~miss
    assert ((data["t"][hit] >= 0) & (data["t"][hit] < 1 << 24)).all()
    assert np.allclose(np.linalg.norm(data["normal"][hit], axis=1), 1, atol=1e-6)
    assert (data["depth"][hit] > 4).all() and (data["depth"][hit] < 7).all()


def test_normals_face_the_viewer(rendered):
    """No normal points away from its ray."""
    data = np.load(rendered / "torus.npz")
    eye = np.array([3.0, -4.0, 2.5])
    forward = -eye / np.linalg.norm(eye)
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    pixel = 2 * np.tan(np.radians(15)) / 36
    y, x = np.nonzero(data["surface"] >= 0)
    ray = forward + ((x + 0.5 - 24) * pixel)[:, None] * right + ((18 - y - 0.5) * pixel)[:, None] * up
    assert ((data["normal"][y, x] * ray).sum(axis=1) <= 1e-6).all()


def test_exr_and_png_agree_with_npz(rendered):
    """EXR holds linear colour, depth, normal and surface as named channels; PNG holds rgb, encoded by a table."""
    data = np.load(rendered / "torus.npz")
    exr = oiio.ImageInput.open(str(rendered / "torus.exr"))
    names, pixels = exr.spec().channelnames, exr.read_image("float")
    assert sorted(names) == sorted(CHANNELS)
    plane = {name: pixels[..., i] for i, name in enumerate(names)}
    assert (plane["Z"] == data["depth"].astype(np.float32)).all()
    assert (plane["surface"] == data["surface"]).all()
    for i, axis in enumerate("XYZ"):
        assert (plane[f"normal.{axis}"] == data["normal"][..., i]).all()
    linear = np.stack([plane[c] for c in "RGB"], axis=2).astype(float)
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0) ** (1 / 2.4) - 0.055)
    assert np.abs(encoded * 255 - data["rgb"]).max() <= 0.61
    png = oiio.ImageInput.open(str(rendered / "torus.png"))
    assert (png.read_image("uint8") == data["rgb"]).all()


def test_shade_is_lambert_plus_ambient(rendered):
    """Linear colour = (ambient + (1 - ambient) max(0, n·l)) * colour; black where the ray misses."""
    data = np.load(rendered / "torus.npz")
    exr = oiio.ImageInput.open(str(rendered / "torus.exr"))
    pixels = dict(zip(exr.spec().channelnames, np.moveaxis(exr.read_image("float"), 2, 0), strict=True))
    light = np.array([-0.36, -0.48, 0.80])
    light /= np.linalg.norm(light)
    hit = data["surface"] >= 0
    level = np.where(hit, 0.1 + 0.9 * np.maximum(0, data["normal"] @ light), 0)
    for channel, colour in zip("RGB", (0.9, 0.5, 0.2), strict=True):
        assert np.allclose(pixels[channel], level * colour, atol=5e-4)  # fixed point, docs/processor.md


def test_compare(rendered, tmp_path, capsys):
    """Equal outputs: 0. One value changed: 1, and the line says which. Nothing to compare: 2."""
    assert main(["compare", str(rendered), str(rendered)]) == 0
    data = dict(np.load(rendered / "torus.npz"))
    data["t"][18, 10] ^= 1
    np.savez(tmp_path / "torus.npz", **data)
    assert main(["compare", str(rendered / "torus.npz"), str(tmp_path / "torus.npz")]) == 1
    assert "torus.npz t: 1 of 1728 values differ, first at (18, 10)" in capsys.readouterr().out
    assert main(["compare", str(rendered), str(tmp_path)]) == 1
    for bad, words in (
        ("missing", "found no such file or folder; allowed: a file .npz, .exr, .png, or a folder"),
        ("empty", "found a folder without such a file; allowed: a file .npz"),
        ("text.txt", "found the ending '.txt'; allowed: a file .npz"),
        ("text.npz", "not a readable npz file: found no zip archive, or one cut short; allowed: an .npz file as"),
        ("text.png", "not a readable picture: "),
    ):
        path = tmp_path / bad
        if bad == "empty":
            path.mkdir()
        elif bad.startswith("text"):
            path.write_text("no data")
        assert main(["compare", str(rendered), str(path)]) == 2
        said = capsys.readouterr().err
        assert said.startswith(f"raydix: {path}: {words}") and said.count("\n") == 1, said


def test_archive_without_arrays_is_refused(tmp_path, capsys):
    """A zip archive that has no array, or something else than arrays, is no npz file and equal to none."""
    for names, words in (([], "found no array in"), (["a.txt", "b"], "found a.txt, b, no array in")):
        path = tmp_path / "a.npz"
        with zipfile.ZipFile(path, "w") as archive:
            for name in names:
                archive.writestr(name, "text")
        assert main(["compare", str(path), str(path)]) == 2
        assert f"a.npz: {words} the archive; allowed: an .npz file as render" in capsys.readouterr().err


@pytest.mark.parametrize("ending", [".png", ".exr", ".npz"])
def test_damaged_files_are_refused(rendered, ending, tmp_path, capsys):
    """A file cut short or with flipped bytes is exit status 2 and one line, never 'equal' and never a traceback."""
    whole = (rendered / f"torus{ending}").read_bytes()
    flipped = bytearray(whole)
    for i in range(len(whole) // 3, len(whole) // 3 + 60):
        flipped[i] ^= 0xFF
    for name, content in (("cut", whole[: len(whole) // 2]), ("flipped", bytes(flipped)), ("none", b"")):
        path = tmp_path / f"{name}{ending}"
        path.write_bytes(content)
        status = main(["compare", str(path), str(path)])
        assert status == 2 or (name == "flipped" and status == 0), name  # pixels may be damaged and still readable
        assert main(["compare", str(rendered / f"torus{ending}"), str(path)]) == (1 if status == 0 else 2)
        assert "Traceback" not in capsys.readouterr().err


def test_single_array_is_refused(tmp_path, capsys):
    """An .npy under the name .npz."""
    with (tmp_path / "a.npz").open("wb") as file:
        np.save(file, np.zeros(3))
    assert main(["compare", str(tmp_path / "a.npz"), str(tmp_path / "a.npz")]) == 2
    assert "a.npz: not a readable npz file" in capsys.readouterr().err


@pytest.mark.parametrize("what", ["png", "exr", "missing array", "dtype", "shape", "missing file"])
def test_compare_sees_every_difference(rendered, what, tmp_path, capsys):
    """A changed pixel of a PNG or EXR, a missing array, another type or shape, a missing file: exit status 1."""
    for path in rendered.iterdir():
        shutil.copy(path, tmp_path)
    if what in ("png", "exr"):
        path = tmp_path / f"torus.{what}"
        pixels = image.read_image(path)
        pixels[5, 7, 1] += 1
        names = ("R", "G", "B") if what == "png" else CHANNELS
        image._write_image(path, pixels, names, "uint8" if what == "png" else "float")
    elif what == "missing file":
        (tmp_path / "torus.exr").unlink()
    else:
        data = dict(np.load(tmp_path / "torus.npz"))
        if what == "missing array":
            del data["normal"]
        elif what == "dtype":
            data["depth"] = data["depth"].astype(np.float32)
        else:
            data["t"] = data["t"][:-1]
        np.savez(tmp_path / "torus.npz", **data)
    assert main(["compare", str(rendered), str(tmp_path)]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 1, lines


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--n1", "5"], "n1: found 5; allowed: 1 to 4"),
        (["--steps", "11"], "steps: found 11; allowed: 1 to 10"),
        (["--steps", "0"], "steps: found 0"),
        (["--width", "60"], "width: found 60; allowed: 16 to 48"),
        (["--units", "9"], "units: found 9; allowed: 1 to 8"),
        (["--threads", "0"], "threads: found 0; allowed: 1 to 256"),
        (["--threads", "1000000"], "threads: found 1000000; allowed: 1 to 256"),
        (["--size", "5000x36"], "camera.width"),
        (["--size", "0x36"], "camera.width"),
    ],
)
def test_bad_option_is_refused(options, words, tmp_path, capsys):
    """Exit status 2, one line that says what was found and what is allowed, and no output folder."""
    out = tmp_path / "out"
    assert main(["render", str(ROOT / "scenes" / "torus.toml"), "--out", str(out), *options]) == 2
    assert words in capsys.readouterr().err
    assert not out.exists()


def test_mixed_endings_are_refused(rendered, capsys):
    """An npz against a picture is a mistake of the user, not a difference."""
    assert main(["compare", str(rendered / "torus.npz"), str(rendered / "torus.exr")]) == 2
    assert "allowed: the same ending" in capsys.readouterr().err


def test_export(tmp_path, rendered):
    """words.hex is what the RTL is fed, and hits.csv what it answers."""
    from raydix.compile import compile_scene, descriptor_array

    assert (
        main(["export", str(ROOT / "scenes" / "torus.toml"), *SMALL, "--out", str(tmp_path / "new" / "stimulus")]) == 0
    )
    words = [int(line, 16) for line in (tmp_path / "new" / "stimulus" / "words.hex").read_text().split()]
    compiled = compile_scene(load_scene(ROOT / "scenes" / "torus.toml", 48, 36), Config())
    assert words == [int(w) % 2**64 for w in descriptor_array(compiled)]
    rows = list(csv.DictReader((tmp_path / "new" / "stimulus" / "hits.csv").open()))
    x0, y0, x1, y1 = compiled.surfaces[0].rect
    assert len(rows) == (x1 - x0 + 1) * (y1 - y0 + 1)
    data = np.load(rendered / "torus.npz")
    for row in rows:
        assert int(row["t"]) == max(0, data["t"][int(row["y"]), int(row["x"])])
        assert int(row["hit"]) == (data["t"][int(row["y"]), int(row["x"])] >= 0)
    assert json.loads((tmp_path / "new" / "stimulus" / "parameters.json").read_text())["rdx_core"]["N1"] == 3


@pytest.mark.parametrize(
    ("scene", "given"),
    [("torus", {"D": 4, "Clip": 0, "Layers": 1}), ("hyperboloid", {"D": 2, "Clip": 1}),
     ("glass", {"Surfaces": 3, "Layers": 7}), ("spiral", {"D": 0, "Vecsum": 1, "Clip": 0})],
)  # fmt: skip
def test_configure(scene, given, capsys):
    """The smallest processor for a scene, as a table with reasons, as options for Verilator, and as JSON."""
    path = str(ROOT / "scenes" / f"{scene}.toml")
    assert main(["configure", path, "--size", "100x75", "--beat", "2"]) == 0
    text = capsys.readouterr().out
    assert main(["configure", path, "--size", "100x75", "--beat", "2", "--json"]) == 0
    values = json.loads(capsys.readouterr().out)
    assert text.splitlines()[-1] == " ".join(f"-G{name}={value}" for name, value in values.items())
    assert all(name in text for name in values)
    assert values | given | {"MaxWidth": 100, "Pixels": 2} == values


def test_nothing_in_view(tmp_path, capsys):
    """A camera that looks away gives a picture of the background and says so."""
    scene = tmp_path / "away.toml"
    scene.write_text(TORUS.replace("look_at = [0.0, 0.0, 0.0]", "look_at = [6.0, -8.0, 5.0]"))
    assert main(["render", str(scene), *SMALL, "--out", str(tmp_path / "out")]) == 0
    assert "1 of 1 surfaces are out of view" in capsys.readouterr().err
    assert (np.load(tmp_path / "out" / "away.npz")["surface"] == -1).all()


def test_rays_given_up_are_told(tmp_path, capsys, monkeypatch):
    """Where a ray reached the largest count of steps a word says that roots may be missing; else none."""
    from raydix import hits

    scene = tmp_path / "scene.toml"
    scene.write_text(TORUS)
    assert main(["render", str(scene), *SMALL, "--out", str(tmp_path / "out")]) == 0
    assert "given up" not in capsys.readouterr().err
    monkeypatch.setattr(hits, "STEPS_MAX", 8)  # as many as most rays that hit have taken
    monkeypatch.setattr(cli, "STEPS_MAX", 8)
    assert main(["render", str(scene), *SMALL, "--out", str(tmp_path / "out")]) == 0
    assert "rays were given up after 8 steps; roots may be missing" in capsys.readouterr().err


def test_wave_into_a_new_folder(tmp_path):
    """The folder of a waveform is made; one that cannot be is an error."""
    base = ["render", str(ROOT / "scenes" / "sphere.toml"), "--backend", "rtl", "--size", "8x6", "--units", "1"]
    base += ["--steps", "2", "--out", str(tmp_path / "out"), "--wave"]
    assert main([*base, str(tmp_path / "new" / "a.vcd")]) == 0
    assert (tmp_path / "new" / "a.vcd").stat().st_size < 60_000_000
    (tmp_path / "file").write_text("")
    assert main([*base, str(tmp_path / "file" / "a.vcd")]) == 2


def test_verify(tmp_path, monkeypatch, capsys):
    """Several scenes side by side: 0 differing bits in the table, and both outputs and the difference of each."""
    monkeypatch.chdir(tmp_path)
    scenes = [str(ROOT / "scenes" / f"{name}.toml") for name in ("sphere", "saddle")]
    options = ["--size", "24x18", "--units", "1", "--steps", "2"]
    assert main(["verify", *scenes, *options]) == 0
    text = capsys.readouterr().out
    assert "sphere: 0 bits differ in the hits, 0 in the images" in text
    assert "saddle: 0 bits differ in the hits, 0 in the images" in text
    for name in ("sphere", "saddle"):
        folder = tmp_path / "build" / "render" / name
        assert main(["compare", str(folder / "golden"), str(folder / "rtl")]) == 0
        assert not image.read_image(folder / f"{name}-difference.png").any()
    assert main(["verify", *scenes, *options, "--out", str(tmp_path / "x")]) == 2
    assert main(["verify", scenes[0], scenes[0], *options]) == 2
    assert not (tmp_path / "x").exists()


def test_verify_sees_a_difference(tmp_path, monkeypatch, capsys):
    """One bit of one hit changed on its way from the RTL: exit status 1, a red pixel, the command to follow its ray."""
    honest = render.run_frames

    def faulty(*args, **keywords):
        output = honest(*args, **keywords)
        output.hits.surfaces[0].t[9, 9, 0] ^= 1
        return output

    monkeypatch.setattr(render, "run_frames", faulty)
    sphere = str(ROOT / "scenes" / "sphere.toml")
    options = ["--size", "24x18", "--units", "1", "--steps", "2", "--out", str(tmp_path)]
    assert main(["verify", sphere, *options]) == 1
    said = capsys.readouterr().out
    assert "sphere: 1 bits differ in the hits" in said
    picture = image.read_image(tmp_path / "sphere-difference.png")
    ((y, x),) = np.argwhere((picture == (255, 0, 0)).all(axis=2)).tolist()
    line = next(line for line in said.splitlines() if "step by step: " in line)
    assert line.startswith(f"sphere: the first pixel that differs is {x},{y}; ")
    words = shlex.split(line.split("step by step: ")[1])
    assert [str(Path(words[1]).resolve()), words[2]] == [str(ROOT / "scripts" / "trace_ray.py"), sphere]
    assert words[3:] == ["--pixel", f"{x},{y}", "--surface", "0", "--steps", "2", "--units", "1", "--size", "24x18"]
    # the bit was changed on the way to the picture: the steps themselves are the golden model's
    assert said.endswith(
        "sphere: alone, the ray has the same steps, hits and colour in both: the mistake is before it "
        "(raster, skipping), or comes only beside other rays or surfaces\n"
    )


def test_first_ray_to_follow():
    """That of a hit that differs, of its surface; else of a pixel that differs and has rays; else none."""
    scene = load_scene(ROOT / "scenes" / "glass.toml", 48, 36)
    config = Config(units=1, **families(scene), **frame_parameters(scene))

    def verdict():
        return render.Verdict(render.render_golden(scene, config), render.render_golden(scene, config), 0, 0)

    whole = verdict()
    assert whole.first_ray() is None and not whole.differing().any()
    rects = [hits.surface.rect for hits in whole.rtl.hits.surfaces]
    assert all(x0 > 0 and y0 > 0 for x0, y0, _, _ in rects)
    whole.rtl.rgb[0, 0, 0] ^= 1  # where no surface can be
    assert whole.first_ray() is None and whole.differing().sum() == 1
    x, y = rects[2][0], rects[2][1]
    whole.rtl.normal[y, x, 1] = -0.0 if whole.rtl.normal[y, x, 1] == 0 else 0
    assert whole.first_ray() == (x, y, None) and whole.differing().sum() == 2
    hits = whole.rtl.hits.surfaces[1]
    rows, columns = np.nonzero(hits.t[..., 0] >= 0)
    hits.point[rows[40], columns[40], 0, 2] ^= 4
    hits.enters[rows[7], columns[7], 0] ^= 1
    assert whole.first_ray() == (columns[7] + rects[1][0], rows[7] + rects[1][1], hits.surface.index)
    lost = verdict()
    lost.rtl.hits.surfaces[0].t[:] = -1  # a ray that was skipped has no hit
    assert lost.first_ray() is None


def test_difference_without_a_ray(tmp_path, monkeypatch, capsys):
    """A background of another colour: the first pixel is named, no ray is offered that cannot be followed."""
    honest = render.run_frames

    def faulty(*args, **keywords):
        output = honest(*args, **keywords)
        output.rgb[0, 1, 2, 0] ^= 1
        return output

    monkeypatch.setattr(render, "run_frames", faulty)
    options = ["--size", "24x18", "--units", "1", "--steps", "2", "--out", str(tmp_path)]
    assert main(["verify", str(ROOT / "scenes" / "sphere.toml"), *options]) == 1
    said = capsys.readouterr().out
    assert "the first pixel that differs is 2,1, where no surface can be" in said and "trace_ray" not in said


def test_malformed_options(tmp_path):
    """What argparse refuses is exit status 2 as well."""
    for options in (["--size", "big"], ["--rule", "best"], ["--n1", "three"], []):
        with pytest.raises(SystemExit) as stop:
            main(["render", str(ROOT / "scenes" / "torus.toml"), *options])
        assert stop.value.code == 2


@pytest.mark.parametrize(
    ("old", "new", "key"),
    [
        ('type = "torus"', 'type = "spirals"', "surface[0].type"),
        ("R = 1.0", "R = nan", "R"),
        ("r = 0.4", "radius = 0.4", "radius"),
        ("scale = 1.0", "scale = 0.0", "scale"),
        ("look_at = [0.0, 0.0, 0.0]", "look_at = [3.0, -4.0, 2.5]", "look_at"),
        ("up = [0.0, 0.0, 1.0]", "up = [3.0, -4.0, 2.5]", "up"),
        ("width = 640", "width = 100000", "camera.width"),
        ('type = "torus"\nR = 1.0\nr = 0.4', 'type = "plane"', "clip"),
    ],
)
def test_bad_scene_is_refused(old, new, key, tmp_path):
    """Exit status 2; file, key, found and allowed on stderr; no traceback; nothing written."""
    assert old in TORUS
    scene, out = tmp_path / "bad.toml", tmp_path / "out"
    scene.write_text(TORUS.replace(old, new))
    run = subprocess.run([RAYDIX, "render", scene, "--out", out], capture_output=True, text=True)
    assert run.returncode == 2
    assert str(scene) in run.stderr and key in run.stderr
    assert "found" in run.stderr and "allowed" in run.stderr and "Traceback" not in run.stderr
    assert not out.exists()


def test_too_thin_clip_is_refused(tmp_path, capsys):
    """A clip box that the coordinate words cannot resolve is refused by compile with file and key."""
    scene = tmp_path / "thin.toml"
    scene.write_text(TORUS + "clip = [[-1.5, -1.5, -1e-8], [1.5, 1.5, 1e-8]]\n")
    assert main(["render", str(scene), *SMALL, "--out", str(tmp_path / "out")]) == 2
    assert f"{scene}: surface[0] (torus).clip: found" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_size_of_a_wave(tmp_path, monkeypatch, capsys):
    """Where a waveform takes gigabytes its size is told; more than is free is refused, and nothing is written."""
    scene = SimpleNamespace(camera=SimpleNamespace(width=640, height=480))
    usage = cli.shutil.disk_usage(tmp_path)
    monkeypatch.setattr(cli.shutil, "disk_usage", lambda path: usage._replace(free=int(70e9)))
    cli._check_wave(tmp_path / "new" / "a.vcd", scene)
    assert "the waveform takes about 61.4 GB for 640×480 pixels; less: a smaller --size" in capsys.readouterr().err
    monkeypatch.setattr(cli.shutil, "disk_usage", lambda path: usage._replace(free=int(2e9)))
    with pytest.raises(ConfigError, match="wave: found about 61.4 GB for 640×480 pixels; allowed: less than 2.0 GB"):
        cli._check_wave(tmp_path / "new" / "a.vcd", scene)
    scene.camera.width = 4
    cli._check_wave(tmp_path / "a.fst", scene)
    assert not capsys.readouterr().err and not list(tmp_path.iterdir())


@pytest.mark.parametrize("name", ["wave.vcd", "wave.png", "wave.fst"])
def test_wave(name, tmp_path, capsys):
    """The RTL back end writes a VCD; FST where lz4.h is there; another ending is refused."""
    from raydix.files import has_fst

    wave, out = tmp_path / name, tmp_path / "out"
    command = ["render", str(ROOT / "scenes" / "sphere.toml"), "--backend", "rtl", "--size", "8x6", "--out", str(out)]
    status = main([*command, "--units", "1", "--steps", "2", "--wave", str(wave)])
    if name.endswith("png") or (name.endswith("fst") and not has_fst()):
        assert status == 2 and not wave.exists() and not out.exists()
        said = capsys.readouterr().err
        assert said == f"raydix: wave: found '{wave}'; allowed: a file .vcd or .fst\n"  # before anything is built
    else:
        assert status == 0 and (out / "sphere.png").is_file()
        assert name.endswith("fst") or "u_ring" in wave.read_text()


@pytest.mark.parametrize("command", ["render", "verify", "export"])
def test_unwritable_output(command, tmp_path, monkeypatch, capsys):
    """An output folder that is a file is one clear line that names it, before anything is rendered or built."""
    scene = tmp_path / "s.toml"
    scene.write_text(TORUS)
    monkeypatch.setattr(cli, "_build", None)
    monkeypatch.setattr(cli, "_progress", None)
    for out in (scene, scene / "below"):
        assert main([command, str(tmp_path / "s.toml"), *SMALL, "--out", str(out)]) == 2
        wanted = f"raydix: {scene}: found a file; allowed: a folder, or a name that is not taken\n"
        assert capsys.readouterr().err == wanted


def no_space(*_):
    """A disk that is full half-way through a file."""
    raise OSError(28, "No space left on device")


def test_failed_write_leaves_nothing(tmp_path):
    """If one of several files cannot be written, none has changed and no part of one is left."""
    older = {name: tmp_path / name for name in ("a.png", "b.npz")}
    for path in older.values():
        path.write_text("older")

    def half(work):
        work.write_text("half")
        no_space()

    writers = {older["a.png"]: lambda work: work.write_text("newer"), older["b.npz"]: half}
    with pytest.raises(image.ImageError, match="b.npz: cannot be written: No space left"):
        image.write_files(writers)
    assert sorted(os.listdir(tmp_path)) == ["a.png", "b.npz"]
    assert {path.read_text() for path in older.values()} == {"older"}


def test_folder_in_the_way(rendered, tmp_path, capsys):
    """A folder with the name of one of the files: nothing of the render is written."""
    (tmp_path / "torus.npz").mkdir()
    assert main(["render", str(ROOT / "scenes" / "torus.toml"), *SMALL, "--out", str(tmp_path)]) == 2
    assert "torus.npz: cannot be written: there is a folder of this name" in capsys.readouterr().err
    assert os.listdir(tmp_path) == ["torus.npz"]


def test_picture_cut_short_is_an_error(tmp_path, monkeypatch):
    """A picture whose last bytes cannot be written is not moved into place."""
    monkeypatch.setattr(image.oiio.ImageOutput, "close", lambda self: False)
    with pytest.raises(image.ImageError, match="a.png: cannot be written"):
        image.write_files({tmp_path / "a.png": image.png_writer(np.zeros((4, 4, 3), np.uint8))})
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("missing", ["g++", "perl"])
def test_missing_tool_is_named(missing, tmp_path):
    """Set-up says in one line which tool is missing and how to get it."""
    for tool in {"python3", "g++", "perl", "make", "git", "sh"} - {missing}:
        (tmp_path / tool).symlink_to(sys.executable if tool == "python3" else shutil.which(tool))
    run = subprocess.run(
        ["/bin/sh", ROOT / "scripts" / "preflight.sh", "python3"],
        env={"PATH": str(tmp_path)},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 1
    assert len(run.stderr.splitlines()) == 1
    assert run.stderr.startswith(f"raydix: {missing} is missing") and "apt-get install" in run.stderr
