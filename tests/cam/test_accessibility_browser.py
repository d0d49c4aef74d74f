"""What axe-core finds wrong with whole pages in Chromium, by WCAG 2.2, level AA, on a wide screen and a telephone.

The extra ``browser`` brings what it takes.
"""

import importlib.util
import shutil
from pathlib import Path

import pytest
from by_night import in_ci
from test_live import Page
from test_live_browser import CHROMIUM, browser, until

from mechwright.testing import commands

__all__ = ["browser"]

ROOT = Path(__file__).parents[2]
AXE = importlib.util.find_spec("axe_playwright_python")
RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"]
WIDTHS = (1400, 390)

STUDY = """
format = 1
family = "four-bar"
name = "few"
[study]
count = 64
front = 1
columns = ["least_transmission_angle", "time_ratio"]
[study.ranges]
crank = { least = 20, greatest = 45 }
coupler = { least = 60, greatest = 120 }
follower = { least = 50, greatest = 100 }
[study.objectives]
swing = "greatest"
alpha_b_max = "least"
"""

pytestmark = [
    in_ci,
    pytest.mark.skipif(CHROMIUM is None or AXE is None, reason="no chromium, or no axe-core"),
]


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """Pages of a pair in its machine: model, programs, motion, drive, what verify says; and of a study."""
    folder = tmp_path_factory.mktemp("pages")
    pair, gear = (
        ROOT / "examples" / "elliptic-pair.toml",
        ROOT / "examples" / "slider-crank-quick-return.toml",
    )
    wheel = folder / "wheel.toml"
    text = (ROOT / "examples" / "geneva-straight.toml").read_text(encoding="utf-8")
    wheel.write_text(f'process = "wire"\n{text}', encoding="utf-8")
    assert commands.run("print", "--coupon", "-o", folder / "coupon").returncode == 0
    for command, design in (
        ("build", pair),
        ("solve", ROOT / "examples" / "geneva-motor.toml"),
        ("solve", gear),
        ("cam", ROOT / "examples" / "geneva-straight.toml"),  # a page of three programs
        ("cut", wheel),
    ):
        done = commands.run(command, design, "-o", folder / design.stem)
        assert done.returncode == 0, done.stderr
    study = folder / "few.toml"
    study.write_text(STUDY, encoding="utf-8")
    assert commands.run("sweep", study, "-o", folder / "few", "--workers", "1").returncode == 0
    program = folder / pair.stem / "gear.nc"
    commands.run("verify", program, "--design", pair, "--part", "gear", "--page", folder / "report.html")
    return sorted(folder.rglob("*.html"))


def judged(page):
    """What axe-core finds wrong with a page as it stands."""
    page.evaluate((Path(AXE.origin).parent / "axe.min.js").read_text(encoding="utf-8"))
    found = page.evaluate(
        "rules => axe.run(document, {runOnly: rules}).then(found => found.violations)", RULES
    )
    return [f"{one['id']}: {node['html'][:120]}" for one in found for node in one["nodes"]]


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_pages(browser, pages, scheme):
    assert {path.name for path in pages} >= {
        "motion.html",
        "gear.setup.html",
        "assembly.html",
        "report.html",
        "study.html",
        "cut.html",
        "coupon.html",
    }
    wrong = {}
    for width in WIDTHS:
        context = browser.new_context(
            viewport={"width": width, "height": 900}, color_scheme=scheme, reduced_motion="reduce"
        )
        for path in pages:
            page = context.new_page()
            page.goto(path.as_uri())
            assert page.evaluate("document.documentElement.scrollWidth") == width, path
            wrong |= {f"{path.name} at {width}": found for found in [judged(page)] if found}
            page.close()
        context.close()
    assert wrong == {}


@pytest.mark.parametrize("example", ["elliptic-pair", "slider-crank-stroke-requirement"])
def test_live(browser, tmp_path, example):
    path = tmp_path / "one.toml"
    shutil.copy(ROOT / "examples" / f"{example}.toml", path)
    server = Page(path)
    context = browser.new_context(viewport={"width": 1400, "height": 900})
    try:
        page = context.new_page()
        page.goto(f"http://127.0.0.1:{server.port}/{server.token}/")
        page.wait_for_selector("#picture svg")
        until(page, "document.querySelector('#channels tbody tr') !== null")
        for width in WIDTHS:
            page.set_viewport_size({"width": width, "height": 900})
            for folded in page.locator("#fields details").all():
                folded.evaluate("one => { one.open = true; }")
            assert judged(page) == []
            assert page.evaluate("document.documentElement.scrollWidth") == width
        order = page.evaluate(
            "[...document.querySelectorAll('[tabindex]')].filter(one => one.tabIndex > 0).length"
        )
        assert order == 0, "the keyboard goes in the order of the page"
    finally:
        context.close()
        server.end()
