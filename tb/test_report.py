# SPDX-License-Identifier: Apache-2.0
"""The report page: its figures are those of their sources, and it works in a browser, on a phone, without network."""

import json
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from raydix.cli import main
from raydix.compile import compile_scene
from raydix.config import Config
from raydix.golden import trace_golden
from raydix.image import read_image
from raydix.scene import load_scene
from scripting import SCRIPTS, scripts

ROOT = Path(__file__).resolve().parents[1]
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
MISSING = "chromium is missing (Debian: apt-get install chromium): the report's page was seen in no browser"
PHONE, DESK = (360, 740), (1280, 900)

# Chapters that show parts of docs/: the page's generated blocks, and the files of its plots; if there, those of build/.
CHAPTERS = {
    "benchmarks": (["beaten", "clocks"], [f"bench/{n}|benchmark-{n}" for n in ("torus", "hyperboloid", "spiral")]),
    "exploration": (["goals"], ["explore/explore|exploration"]),
    "synthesis": (["synthesis"], []),
    "realtime": (["speed", "skips"], []),
    "stress": (["stress"], ["|stress-algebraic", "|stress-spirals"]),
    "coverage": (["coverage"], []),
    "mutants": (["mutants"], []),
    "formal": (["proofs"], []),
}
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
    """The command's result. Folders are made."""
    for name in ("render", "results"):
        (folder / name).mkdir(exist_ok=True)
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


@pytest.mark.parametrize("option", ["--render", "--results"])
@pytest.mark.parametrize(("given", "found"), [("file", "the file '"), ("nowhere", "'")])
def test_no_folder(tmp_path, option, given, found):
    """A file, or nothing, in place of a folder: one line, exit status 2, no page."""
    (tmp_path / "file").write_text("")
    done = report(tmp_path, option, tmp_path / given, "--out", tmp_path / "page.html")
    said = done.stderr.splitlines()[-1]
    assert done.returncode == 2 and not (tmp_path / "page.html").exists() and "Traceback" not in done.stderr
    assert said.endswith(f"{option}: found {found}{tmp_path / given}'; allowed: a folder that is there")


@pytest.mark.parametrize(("text", "said"), [(None, "No such file"), ("none", "found no generated block 'goals'")])
def test_no_table(tmp_path, monkeypatch, capsys, text, said):
    """Without a page of docs/, or its table, there is no report: one line that names the page."""
    with scripts("reporting.documents") as documents, scripts("report") as program:
        chapter = next(c for c in documents.CHAPTERS if c.page == "exploration.md")
        monkeypatch.setitem(documents.section.__globals__, "DOCS", tmp_path)
        monkeypatch.setitem(program.page.__globals__, "CHAPTERS", [chapter])
        if text:
            (tmp_path / "exploration.md").write_text(text)
        monkeypatch.setattr(sys, "argv", ["report.py", "--out", str(tmp_path / "page.html")])
        assert program.main() == 2
    wrong = capsys.readouterr().err
    assert said in wrong and "exploration.md" in wrong and len(wrong.splitlines()) == 1
    assert not (tmp_path / "page.html").exists()


def test_no_plot(tmp_path, monkeypatch):
    """A picture that was never drawn: its chapter says which, and the command that draws it."""
    with scripts("reporting.documents") as documents, scripts("report") as program:
        chapter = next(c for c in documents.CHAPTERS if c.page == "exploration.md")
        lost = type(chapter)(**{**vars(chapter), "plots": ("build/nothing.png|docs/images/lost.png", chapter.plots[0])})
        monkeypatch.setitem(program.page.__globals__, "CHAPTERS", [lost])
        text = program.page(tmp_path, tmp_path)
    assert "No picture yet of lost: <code>make explore ARGS=--write</code>." in text
    assert text.count('class="plot"') == 1


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
    """Headless Chromium without network. CI installs it, so there it must be."""
    if not CHROMIUM:
        (pytest.fail if os.environ.get("CI") else pytest.skip)(MISSING)
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield started
        started.close()


@pytest.fixture
def opened(browser, page):
    """A function that opens a page in a window of a size; what it loads beside itself is noted, and errors."""
    contexts, wrong = [], []

    def at(width, height, file=page):
        context = browser.new_context(viewport={"width": width, "height": height}, offline=True)
        contexts.append(context)
        tab = context.new_page()
        tab.on("pageerror", lambda error: wrong.append(str(error)))
        tab.on("request", lambda request: wrong.append(request.url))
        tab.on("requestfailed", lambda request: wrong.append(request.url))
        tab.goto(file.as_uri())
        tab.evaluate("document.querySelectorAll('details').forEach(d => d.open = true)")
        tab.evaluate("Promise.all([...document.images].map(i => i.decode()))")  # it fails where one cannot be decoded
        assert [wrong.pop(0)] == [file.as_uri()]
        return tab

    yield at
    for context in contexts:
        context.close()
    assert not [url for url in wrong if not url.startswith("data:")]


PIXELS = """i => { const c = document.createElement('canvas'); c.width = i.naturalWidth; c.height = i.naturalHeight;
  const x = c.getContext('2d'); x.drawImage(i, 0, 0); return [...x.getImageData(0, 0, c.width, c.height).data]; }"""
ROWS = "rows => rows.map(r => [...r.cells].map(c => c.innerText.trim()))"


def pixels(image):
    """What the browser decodes of an image of a scene: int64 (18, 24, 3)."""
    return np.array(image.evaluate(PIXELS), np.int64).reshape(18, 24, 4)[..., :3]


@pytest.mark.parametrize(("width", "height"), [PHONE, DESK])
def test_fits_the_window(opened, width, height):
    """Nothing sticks out sideways, every text is large enough, and every picture of a scene is shown whole."""
    tab = opened(width, height)
    assert tab.evaluate("document.documentElement.scrollWidth") <= width
    assert tab.evaluate("parseFloat(getComputedStyle(document.body).fontSize)") >= 16
    small = """[...document.querySelectorAll('body *')].filter(e => e.checkVisibility() && e.innerText?.trim()
      && parseFloat(getComputedStyle(e).fontSize) < 12.5).map(e => e.outerHTML)"""
    assert tab.evaluate(small) == []
    for stage in tab.query_selector_all(".stage"):
        box = stage.bounding_box()
        assert box["x"] >= 0 and box["x"] + box["width"] <= width and box["width"] >= min(300, 0.8 * width)
    small = "[...document.querySelectorAll('.card button')].filter(b => b.getBoundingClientRect().height < 28).length"
    assert tab.evaluate(small) == 0


@pytest.mark.parametrize(("width", "height"), [PHONE, DESK])
@pytest.mark.parametrize("anchor", ["gallery", "regression", *CHAPTERS])
def test_chapter_fits(opened, anchor, width, height):
    """A link to each chapter in sight; its texts begin in the window, plots are whole, what is wider moves by itself,
    a table with the names of its rows in sight."""
    tab = opened(width, height)
    box = tab.locator(f"nav a[href='#{anchor}']").bounding_box()
    assert box["x"] >= 0 and box["x"] + box["width"] <= width
    chapter = tab.locator(f"section#{anchor}")
    for part in chapter.locator(":is(h2, h3, p, summary, li):visible").all():
        box = part.bounding_box()
        assert box["width"] > 0 and box["x"] >= 0 and box["x"] + box["width"] <= width, part.inner_text()
    for plot in chapter.locator(".plot").all():
        box = plot.bounding_box()
        assert box["x"] >= 0 and box["x"] + box["width"] <= width
    tab.evaluate("document.querySelectorAll('.scroll').forEach(s => s.scrollLeft = s.scrollWidth)")
    for table in chapter.locator(".scroll table").all():
        first, last = (table.locator(f"tr:last-child td:{i}-child").bounding_box() for i in ("first", "last"))
        assert 0 <= first["x"] < last["x"] and last["x"] + last["width"] <= width + 1
    assert tab.evaluate("scrollX") == 0


LETTERS = "i => i.getBoundingClientRect().width / Math.min(i.naturalWidth, 960)"  # how large they are, as drawn 1


@pytest.mark.parametrize(("width", "height"), [PHONE, DESK])
def test_plots(opened, width, height):
    """Nearly as large as they were drawn, on a phone when tapped, the tapped place in sight; whole by another tap."""
    tab = opened(width, height)
    assert tab.locator(".plot").count() and tab.locator(".tap").first.is_visible() == (width < 864)
    for plot in tab.locator(".plot").all():
        if width < 864:
            whole = plot.bounding_box()
            plot.click(position={"x": whole["width"] * 0.9, "y": whole["height"] / 2})
            large = plot.bounding_box()
            assert 0 <= large["x"] + 0.9 * large["width"] <= width
        assert plot.evaluate(LETTERS) >= 0.85
        if width < 864:
            plot.click(position={"x": large["width"] * 0.9, "y": large["height"] / 2})
            assert plot.bounding_box()["width"] == whole["width"] <= width
    assert tab.evaluate("scrollX") == 0


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
    tab = opened(*DESK)
    for name in ("sphere", "saddle"):
        for kind, side in (("over", "golden"), ("under", "rtl")):
            shown = pixels(tab.locator(f".card[data-scene={name}] .{kind}"))
            assert (shown == read_image(run / "render" / name / side / f"{name}.png")).all()


@pytest.mark.parametrize("name", ["sphere", "saddle"])
def test_views_are_the_golden_model(opened, run, name):
    """Depth, normals and steps, in their colours, are those that the golden model gives now; legends have its ends."""
    figures = json.loads((run / "render" / name / f"{name}.json").read_text())
    scene, config = load_scene(ROOT / "scenes" / f"{name}.toml", 24, 18), Config(**figures["config"])
    hits = trace_golden(compile_scene(scene, config), config)
    steps = np.zeros((18, 24), np.int64)
    for surface in hits.surfaces:
        left, top, right, bottom = surface.surface.rect
        steps[top : bottom + 1, left : right + 1] += surface.steps
    frame = np.load(run / "render" / name / "golden" / f"{name}.npz")
    hit = frame["surface"] >= 0
    card = opened(*DESK).locator(f".card[data-scene={name}]")

    def view(i):
        card.locator(".tabs button").nth(i + 1).click()
        return pixels(card.locator(".view").nth(i)), card.locator(".legend").inner_text()

    shown, legend = view(1)
    depth = frame["depth"][hit]
    wanted = 255 - (depth - depth.min()) / (depth.max() - depth.min()) * 215
    assert hit.any() and abs(shown[hit] - wanted[:, None]).max() < 0.51
    assert re.findall(r"(?<=: )[\d.]+", legend) == [f"{depth.min():.4g}", f"{depth.max():.4g}"]
    shown, _ = view(2)
    assert abs(shown[hit] / 127.5 - 1 - frame["normal"][hit]).max() < 1 / 127
    miss = shown[~hit][0]
    assert (shown[~hit] == miss).all() and abs(shown[hit] - miss).max(axis=1).min() > 8
    shown, legend = view(3)
    assert legend.endswith(f"yellow: {steps.max()}; grey: none. {steps.sum():,} in all")
    colors = {tuple(color) for color in shown.reshape(-1, 3)}
    assert len(colors) == len(set(steps.flat)) >= 3
    for count in set(steps.flat):  # one colour for each number of steps, the lighter the more
        assert len({tuple(color) for color in shown[steps == count]}) == 1
    light = [shown[steps == count][0].sum() for count in sorted(set(steps.flat)) if count]
    assert light == sorted(light) and shown[steps == steps.max()][0].tolist() == [253, 231, 36]
    shown, legend = view(4)
    assert legend.endswith(f"{figures['rtl']['steps']:,} in all")


def test_figures_of_scenes(opened, run):
    """The table of each scene has the numbers that verify counted, of both sides."""
    tab = opened(*DESK)
    for name in ("sphere", "saddle"):
        figures = json.loads((run / "render" / name / f"{name}.json").read_text())
        rows = tab.locator(f".card[data-scene={name}] tbody tr").evaluate_all(ROWS)
        found = {row[0]: row[1:] for row in rows}
        for label, key in (("rays", "rays"), ("rays that hit", "hit_rays"), ("hits", "hits"), ("steps", "steps")):
            assert found[label] == [f"{figures[side][key]:,}" for side in ("golden", "rtl")]
        assert found["clocks"] == ["–", f"{figures['rtl']['cycles']:,}"]
        skipped = {key.removeprefix("skipped_"): n for key, n in figures["rtl"].items() if key.startswith("skipped_")}
        assert {k.removeprefix("skipped: "): v[1] for k, v in found.items() if k.startswith("skipped: ")} == {
            key: f"{number:,}" for key, number in skipped.items()
        }


def test_regression_is_the_results(opened, run):
    """Each run's figures, and those of each module, are those of its JUnit file; what failed is named."""
    chapter = opened(*DESK).locator("#regression")
    cases = list(ElementTree.fromstring(RESULTS).iter("testcase"))
    kinds = [next((child.tag for child in case), "passed") for case in cases]
    counted = [kinds.count(kind) for kind in ("passed", "failure", "skipped")]
    said = chapter.locator("h3").inner_text()
    assert said.startswith("test") and [int(n) for n in re.findall(r"\d+", said)] == counted == [2, 1, 1]
    assert "2026-12-01 10:11:12 · 4 s of all workers" in chapter.locator("h3 + p").inner_text()
    rows = chapter.locator("tbody tr").evaluate_all(ROWS)
    wanted = []
    for module in ("step", "cli", "ring"):
        own = [(c, kind) for c, kind in zip(cases, kinds, strict=True) if c.get("classname") == f"tb.test_{module}"]
        counts = [str(sum(kind == k for _, kind in own)) for k in ("passed", "failure", "skipped")]
        wanted.append([module, *counts, f"{sum(float(c.get('time')) for c, _ in own):.1f}"])
    assert rows == wanted  # what failed is first
    assert chapter.locator(".failures li").all_inner_texts() == ["step: c[x] assert 1 == 2"]


def table_of(page, name):
    """Cells of a generated table of docs/, as text."""
    text = (ROOT / "docs" / f"{page}.md").read_text()
    block = text.split(f"<!-- BEGIN generated: {name} -->")[1].split(f"<!-- END generated: {name} -->")[0]
    lines = [line.strip()[1:-1] for line in block.splitlines() if line.startswith("|")]
    rows = [re.split(r"(?<!\\)\|", line) for line in (lines[0], *lines[2:])]
    return [[re.sub(r"[`*\\]", "", cell).strip() for cell in row] for row in rows]


@pytest.mark.parametrize("anchor", CHAPTERS)
def test_tables_are_those_of_the_docs(opened, anchor):
    """Header, rows and cells of each table; the chapter names its page and the command that renews it."""
    chapter = opened(*PHONE).locator(f"section#{anchor}")
    blocks, _ = CHAPTERS[anchor]
    assert chapter.locator("summary").all_inner_texts() == [f"table: {name}" for name in blocks]
    for table, name in zip(chapter.locator("table").all(), blocks, strict=True):
        wanted = table_of(anchor, name)
        found = table.locator("tr").evaluate_all(ROWS)
        assert [[re.sub(r"\s+", " ", cell) for cell in row] for row in found] == wanted and len(wanted) > 2
    said = chapter.locator("p.note").first.inner_text()
    assert f"docs/{anchor}.md" in said and re.match(r"make [a-z]+ ARGS=--write renews this", said)


@pytest.mark.parametrize("anchor", [name for name, (_, plots) in CHAPTERS.items() if plots])
def test_plots_are_the_files(opened, anchor):
    """The browser decodes each plot of the chapter, in the size of its file and with its bytes."""
    import base64

    chapter = opened(*PHONE).locator(f"section#{anchor}")
    paths = []
    for plot in CHAPTERS[anchor][1]:
        built, kept = plot.split("|")
        path = ROOT / "build" / f"{built}.png"
        paths.append(path if built and path.exists() else ROOT / "docs" / "images" / f"{kept}.png")
    for image, path in zip(chapter.locator(".plot").all(), paths, strict=True):
        shape = read_image(path).shape
        assert image.evaluate("i => [i.naturalHeight, i.naturalWidth]") == list(shape[:2]) and min(shape[:2]) > 300
        assert base64.b64decode(image.get_attribute("src").split(",")[1]) == path.read_bytes()


def test_nothing_was_run_in_a_browser(opened, tmp_path):
    """The empty chapters fit a phone, too, and say which command fills them."""
    assert report(tmp_path, "--out", tmp_path / "page.html").returncode == 0
    tab = opened(*PHONE, tmp_path / "page.html")
    assert "No scene was rendered yet: make render or make gallery." in tab.locator("#gallery").inner_text()
    assert "No test was run yet: make test." in tab.locator("#regression").inner_text()
    assert tab.evaluate("document.documentElement.scrollWidth") <= PHONE[0]
