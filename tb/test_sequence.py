# SPDX-License-Identifier: Apache-2.0
"""Sequences: every frame is its own picture; an interruption loses nothing that is finished."""

import shutil
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from raydix import cli, sequence
from raydix.cli import main
from raydix.image import read_image

ROOT = Path(__file__).resolve().parents[1]
OPTIONS = ["--size", "24x18", "--units", "1", "--steps", "2"]  # the build is that of test_cli
FRAMES = 5


@pytest.fixture
def scene(tmp_path):
    """A cut sphere on a turntable of a few frames."""
    text = (ROOT / "scenes" / "sphere.toml").read_text()
    path = tmp_path / "round.toml"
    cut = 'type = "sphere"\nclip = [[-2.0, -2.0, -2.0], [0.3, 0.5, 2.0]]'
    path.write_text(text.replace('type = "sphere"', cut) + f"\n[turntable]\nframes = {FRAMES}\n")
    return path


@pytest.fixture
def rendered(monkeypatch):
    """Numbers of frames that the golden model rendered; it is interrupted before frame ``stop``."""
    honest, asked = sequence.render_golden, []

    def counting(frame, config, threads):
        if len(asked) == counting.stop:
            raise KeyboardInterrupt
        asked.append(frame.camera.eye)
        return honest(frame, config, threads)

    counting.stop = -1
    monkeypatch.setattr(sequence, "render_golden", counting)
    return counting, asked


def names(folder):
    """Files of a folder, those that are hidden too."""
    return sorted(path.name for path in folder.iterdir())


ALL = [*(f"round-{i}.png" for i in range(FRAMES)), "round-frames.json", "round.gif"]


def test_every_frame(scene, tmp_path):
    """A picture for each frame, that of the same camera alone; the preview has them all."""
    out = tmp_path / "out"
    assert main(["render", str(scene), *OPTIONS, "--frames", "--out", str(out)]) == 0
    assert names(out) == ALL
    pictures = [read_image(out / f"round-{i}.png") for i in range(FRAMES)]
    assert len({p.tobytes() for p in pictures}) == FRAMES
    assert main(["render", str(scene), *OPTIONS, "--out", str(tmp_path / "one")]) == 0
    assert (read_image(tmp_path / "one" / "round.png") == pictures[0]).all()
    with Image.open(out / "round.gif") as preview:
        assert preview.n_frames == FRAMES


def test_interrupted_and_resumed(scene, tmp_path, rendered, capsys):
    """What was finished stays whole; --resume makes the other frames only, and the pictures are those of one run."""
    counting, asked = rendered
    out, whole = tmp_path / "out", tmp_path / "whole"
    command = ["render", str(scene), *OPTIONS, "--frames", "--out"]
    counting.stop = 2
    assert main([*command, str(out)]) == 130
    assert "interrupted; nothing half written; --resume goes on" in capsys.readouterr().err
    assert names(out) == ["round-0.png", "round-1.png", "round-frames.json"]
    counting.stop = -1
    asked.clear()
    assert main([*command, str(out), "--resume"]) == 0
    assert len(asked) == FRAMES - 2 and f"2 of {FRAMES} frames are there" in capsys.readouterr().err
    assert names(out) == ALL
    assert main([*command, str(whole)]) == 0
    for name in ALL[:FRAMES]:
        assert (read_image(out / name) == read_image(whole / name)).all()
    asked.clear()
    assert main([*command, str(out), "--resume"]) == 0
    assert not asked


@pytest.mark.parametrize(
    ("change", "again"),
    [
        (lambda scene, out: scene.write_text(scene.read_text().replace("color = [0.", "color = [0.1", 1)), FRAMES),
        (lambda scene, out: scene.write_text(scene.read_text().replace("vfov = 30", "vfov = 31", 1)), FRAMES),
        (lambda scene, out: (out / "round-3.png").write_bytes(b"half"), 1),
        (lambda scene, out: (out / "round-1.png").unlink(), 1),
        (lambda scene, out: (out / "round-frames.json").write_text("{"), FRAMES),
        (lambda scene, out: scene.write_text(scene.read_text() + "# a remark\n"), 0),
    ],
    ids=["colour", "camera", "damaged", "missing", "list", "remark"],
)
def test_what_is_rendered_again(scene, tmp_path, rendered, change, again):
    """A frame that was made from something else, or whose picture is not whole; nothing else."""
    _, asked = rendered
    command = ["render", str(scene), *OPTIONS, "--frames", "--out", str(tmp_path / "out")]
    assert main(command) == 0
    change(scene, tmp_path / "out")
    asked.clear()
    assert main([*command, "--resume"]) == 0
    assert len(asked) == again


def test_another_renderer(scene, tmp_path, rendered, monkeypatch):
    """Pictures of another model, or of the RTL, are made again: the digest has sources and back end."""
    _, asked = rendered
    command = ["render", str(scene), *OPTIONS, "--frames", "--out", str(tmp_path / "out")]
    assert main(command) == 0
    asked.clear()
    names = {sequence.version(backend) for backend in ("golden", "rtl")}
    model = tmp_path / "model"
    shutil.copytree(Path(sequence.__file__).parent, model)
    with (model / "halve.py").open("a") as file:
        file.write("# another\n")
    monkeypatch.setattr(sequence, "__file__", str(model / "sequence.py"))
    names |= {sequence.version("golden")}
    assert main([*command, "--resume"]) == 0
    assert len(asked) == FRAMES
    rtl = tmp_path / "rdx_other.sv"
    real = sequence.top_sources
    monkeypatch.setattr(sequence, "top_sources", lambda: [*real(), rtl])
    for text in ("one", "two"):
        rtl.write_text(text)
        names |= {sequence.version("rtl")}
    assert len(names) == 5
    monkeypatch.setattr(sequence, "version", lambda backend: backend)
    for backend, again in (("golden", FRAMES), ("rtl", FRAMES), ("rtl", 0)):
        made = []

        def frames(scene, config, backend, numbers, *_, made=made):
            made += numbers
            return ((number, np.zeros((18, 24, 3), np.uint8)) for number in numbers)

        monkeypatch.setattr(sequence, "render_sequence", frames)
        monkeypatch.setattr(cli, "_build", lambda config: None)
        assert main([*command, "--resume", "--backend", backend]) == 0
        assert len(made) == again


def test_rtl_is_the_same(scene, tmp_path, monkeypatch):
    """The processor's frames, in two runs of it, are the golden model's."""
    monkeypatch.setattr(sequence, "BATCH", 3)
    for side in ("golden", "rtl"):
        out = str(tmp_path / side)
        assert main(["render", str(scene), *OPTIONS, "--frames", "--backend", side, "--out", out]) == 0
    for name in ALL[:FRAMES]:
        assert (read_image(tmp_path / "golden" / name) == read_image(tmp_path / "rtl" / name)).all()


def test_signal(scene, tmp_path):
    """Ctrl-C in the middle: exit status 130, a line, and every file that is there can be read."""
    scene.write_text(scene.read_text().replace(f"frames = {FRAMES}", "frames = 900"))
    out = tmp_path / "out"
    command = [Path(sys.executable).parent / "raydix", "render", scene, "--size", "64x48", "--frames", "--out", out]
    # a shell's background job is told to ignore Ctrl-C, and so would this process be
    heed = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, preexec_fn=heed)
    limit = time.monotonic() + 400
    while not (out / "round-002.png").exists():
        assert process.poll() is None and time.monotonic() < limit
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 130 and "Traceback" not in said and "--resume goes on" in said
    files = names(out)
    assert "round-899.png" not in files and not [name for name in files if name.startswith(".")]
    assert all(np.ptp(read_image(out / name)) for name in files if name.endswith(".png"))


def test_resume_needs_a_sequence(scene, tmp_path, capsys):
    """--resume without --frames is refused."""
    assert main(["render", str(scene), *OPTIONS, "--resume", "--out", str(tmp_path)]) == 2
    assert "resume: found for a single frame; allowed: with --frames" in capsys.readouterr().err
