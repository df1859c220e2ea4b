# SPDX-License-Identifier: Apache-2.0
"""The report page: what it says of renderings and results, and that it works in a browser without network."""

import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from raydix.cli import main
from scripting import SCRIPTS, scripts

ROOT = Path(__file__).resolve().parents[1]
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
MISSING = "chromium is missing (Debian: apt-get install chromium)"
RESULTS = """<testsuites><testsuite name="pytest" timestamp="2026-12-01T10:11:12.13+00:00">
<testcase classname="tb.test_ring" name="a" time="1.5"/><testcase classname="tb.test_ring" name="b" time="0.5"/>
<testcase classname="tb.test_step" name="c[x]" time="2">
<failure message="assert 1 == 2&#10;more">text</failure></testcase>
<testcase classname="tb.test_cli" name="d" time="0"><skipped message="no"/></testcase>
</testsuite></testsuites>"""


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Two small scenes rendered by both sides, one of them made to differ, and results with one failure."""
    folder = tmp_path_factory.mktemp("run")
    options = ["--size", "24x18", "--units", "1", "--steps", "2"]  # the build is that of test_cli
    for name in ("sphere", "saddle"):
        scene, out = ROOT / "scenes" / f"{name}.toml", folder / "render" / name
        assert main(["verify", str(scene), *options, "--out", str(out)]) == 0
    figures = folder / "render" / "saddle" / "saddle.json"
    figures.write_text(re.sub(r'"(pixels|hit_bits)": 0', r'"\1": 3', figures.read_text()))
    (folder / "results").mkdir()
    (folder / "results" / "test.xml").write_text(RESULTS)
    return folder


def report(folder, *options):
    """The command's result."""
    command = [sys.executable, SCRIPTS / "report.py", "--render", folder / "render", "--results", folder / "results"]
    return subprocess.run([*map(str, command), *map(str, options)], capture_output=True, text=True)


@pytest.fixture(scope="module")
def page(run, tmp_path_factory):
    """The page's file."""
    path = tmp_path_factory.mktemp("page") / "report.html"
    done = report(run, "--out", path)
    assert done.returncode == 0, done.stderr
    return path


class Tags(HTMLParser):
    """All tags with their attributes."""

    def __init__(self, text):
        super().__init__()
        self.found = []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        """Note it."""
        self.found.append((tag, dict(attrs)))


def test_needs_nothing_else(page):
    """No file and no network: every address is within the page; nothing is loaded by the style either."""
    text = page.read_text()
    tags = Tags(text).found
    addresses = [a.get(key) for _, a in tags for key in ("src", "href", "srcset", "data") if a.get(key)]
    assert sum(a.startswith("data:image/png") for a in addresses) >= 14
    assert all(a.startswith(("data:", "#")) for a in addresses)
    assert not re.search(r"url\(|@import|fetch\(|XMLHttpRequest", text)
    assert {a["href"][1:] for tag, a in tags if tag == "a"} <= {a.get("id") for _, a in tags}
    assert all(a.get("alt") for tag, a in tags if tag == "img")


def test_says_what_is_wrong(page):
    """The scene that differs, the failed test with its first line, and the line on top."""
    text = re.sub(r"\s+", " ", page.read_text())
    assert "3 pixels differ, 3 bits" in text and text.count("equal in every bit</span>") == 1
    assert "1 of 2 scenes equal in every bit; 2 tests passed, 1 failed" in text
    assert "<code>step: c[x]</code> assert 1 == 2</li>" in text
    assert 'class="verdict bad"' in text


def test_nothing_was_run(tmp_path):
    """Without renderings and results the page says which commands make them."""
    done = report(tmp_path, "--out", tmp_path / "page.html")
    assert done.returncode == 0, done.stderr
    text = (tmp_path / "page.html").read_text()
    assert "make render" in text and "make test" in text and "no scene rendered; no test run" in text


@pytest.mark.parametrize(
    ("damage", "said"),
    [
        (lambda f: (f / "render/sphere/sphere-steps.npz").unlink(), "sphere: found no output of raydix verify"),
        (lambda f: (f / "render/sphere/sphere.json").write_text("{}"), "sphere: found no output of raydix verify"),
        (lambda f: (f / "render/sphere/golden/sphere.png").write_text("x"), "sphere.png: not a readable picture"),
        (lambda f: (f / "render/sphere/sphere.json").write_text("[1]"), "sphere: found no output of raydix verify"),
        (
            lambda f: (f / "render/sphere/golden/sphere.npz").write_text("PKx"),
            "sphere: found no output of raydix verify",
        ),
        (lambda f: (f / "results/test.xml").write_text("<a>"), "test.xml: found no results of pytest"),
        (lambda f: (f / "results/test.xml").write_text(RESULTS.replace("1.5", "x")), "test.xml: found the time 'x'"),
    ],
)
def test_damaged_files(run, tmp_path, damage, said):
    """One line that names the file, exit status 2, and the page of before stays."""
    shutil.copytree(run, tmp_path / "run")
    damage(tmp_path / "run")
    page = tmp_path / "page.html"
    page.write_text("before")
    done = report(tmp_path / "run", "--out", page)
    assert done.returncode == 2 and said in done.stderr and "Traceback" not in done.stderr
    assert len(done.stderr.splitlines()) == 1 and page.read_text() == "before"


def test_steps_of_both_sides(run):
    """The heat maps' steps: those of the golden model are as many as it counted; RTL's only where a ray left a ring."""
    import json

    data = np.load(run / "render" / "sphere" / "sphere-steps.npz")
    figures = json.loads((run / "render" / "sphere" / "sphere.json").read_text())
    assert data["golden"].shape == (18, 24) and data["golden"].sum() == figures["golden"]["steps"] > 0
    assert 0 < data["rtl"].sum() == figures["rtl"]["steps"] <= figures["golden"]["steps"]
    assert (data["rtl"] <= data["golden"]).all()


def test_colours():
    """Depth: the nearest pixel is the lightest, a miss has its own colour. Normals: z upwards is blue."""
    with scripts("reporting.gallery") as gallery:
        picture, legend = gallery.depth_picture(np.array([[1.0, 2.0, np.inf]]))
        assert picture[0, 0].tolist() == [255] * 3 and picture[0, 1].tolist() == [40] * 3
        assert tuple(picture[0, 2]) == gallery.MISS and "1" in legend and "2" in legend
        picture, _ = gallery.normal_picture(np.array([[[0, 0, 1.0], [0, 0, 0]]]), np.array([[0, -1]]))
        assert picture[0, 0].tolist() == [128, 128, 255] and tuple(picture[0, 1]) == gallery.MISS
        picture, _ = gallery.steps_picture(np.array([[0, 1, 8]]), 8)
        assert tuple(picture[0, 0]) == gallery.MISS and picture[0, 2, 0] > 200 > picture[0, 1, 0]


@pytest.fixture(scope="module")
def browser():
    """Headless Chromium without network."""
    if not CHROMIUM:
        pytest.skip(MISSING)
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield started
        started.close()


@pytest.fixture
def opened(browser, page):
    """A function that opens the page in a window of a size; anything but files is refused and noted, as are errors."""
    contexts, wrong = [], []

    def at(width, height, **options):
        context = browser.new_context(viewport={"width": width, "height": height}, offline=True, **options)
        contexts.append(context)
        tab = context.new_page()
        tab.on("pageerror", lambda error: wrong.append(str(error)))
        tab.on("requestfailed", lambda request: wrong.append(request.url))
        tab.goto(page.as_uri())
        return tab

    yield at
    for context in contexts:
        context.close()
    assert not wrong


@pytest.mark.parametrize(("width", "height"), [(360, 740), (1280, 900)])
def test_fits_the_window(opened, width, height):
    """Nothing sticks out sideways, text is large enough, and every picture is shown whole."""
    tab = opened(width, height)
    assert tab.evaluate("document.documentElement.scrollWidth") <= width
    assert tab.evaluate("parseFloat(getComputedStyle(document.body).fontSize)") >= 16
    for stage in tab.query_selector_all(".stage"):
        box = stage.bounding_box()
        assert box["x"] >= 0 and box["x"] + box["width"] <= width and box["width"] >= min(300, 0.8 * width)
    small = "[...document.querySelectorAll('.card button')].filter(b => b.getBoundingClientRect().height < 28).length"
    assert tab.evaluate(small) == 0


def test_slider(opened):
    """The wipe follows the slider: what is on top ends where it stands."""
    tab = opened(1280, 900)
    card = tab.locator(".card").first
    for value in (0, 30, 100):
        move = f"s => {{ s.value = {value}; s.dispatchEvent(new Event('input')); }}"
        card.locator("input[type=range]").evaluate(move)
        clip = card.locator(".over").evaluate("i => getComputedStyle(i).clipPath")
        assert f"calc(100% - {value}%)" in clip or f"{100 - value}%" in clip or (value == 100 and clip == "inset(0px)")


def test_views(opened):
    """Each button shows its view alone, with what its colours stand for; the first one the picture again."""
    tab = opened(1280, 900)
    card = tab.locator(".card").first
    buttons = card.locator(".tabs button")
    names = ["picture", "difference", "depth", "normals", "steps, golden model", "steps, RTL"]
    assert buttons.all_inner_texts() == names
    for i in range(1, 6):
        buttons.nth(i).click()
        shown = card.locator(".view").evaluate_all("views => views.map(v => !v.hidden)")
        assert shown == [j == i - 1 for j in range(5)]
        assert len(card.locator(".legend").inner_text().strip()) > 8
        assert not card.locator(".wipe").is_visible()
    buttons.nth(0).click()
    assert not any(card.locator(".view").evaluate_all("views => views.map(v => !v.hidden)"))
    assert card.locator(".wipe").is_visible()


def test_flicker(opened):
    """The picture on top comes and goes until the button is pressed again."""
    tab = opened(1280, 900)
    card = tab.locator(".card").first
    button, over = card.locator(".flicker"), card.locator(".over")
    button.click()
    over.wait_for(state="hidden", timeout=5000)
    over.wait_for(state="visible", timeout=5000)
    button.click()
    assert button.get_attribute("aria-pressed") == "false" and over.is_visible()
    tab.wait_for_timeout(900)
    assert over.is_visible()


def test_pictures_are_the_files(opened, run):
    """What the browser decodes is what was rendered."""
    from raydix.image import read_image

    tab = opened(1280, 900)
    script = """i => { const c = document.createElement('canvas'); c.width = i.naturalWidth; c.height = i.naturalHeight;
      const x = c.getContext('2d'); x.drawImage(i, 0, 0); return [...x.getImageData(0, 0, c.width, c.height).data]; }"""
    for name in ("sphere", "saddle"):
        for kind, side in (("over", "golden"), ("under", "rtl")):
            data = tab.locator(f".card[data-scene={name}] .{kind}").evaluate(script)
            rgb = np.array(data, np.uint8).reshape(18, 24, 4)[..., :3]
            assert (rgb == read_image(run / "render" / name / side / f"{name}.png")).all()
