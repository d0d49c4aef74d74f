"""The live page in a browser: with Chromium and playwright, which CI does not have; ``pip install playwright``."""

import shutil
from pathlib import Path

import pytest
from by_night import by_night
from test_live import Page

sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
ROOT = Path(__file__).parents[2]
SLIDER = '[data-key="parameters.eccentricity"] input[type=range]'

pytestmark = [by_night, pytest.mark.skipif(CHROMIUM is None, reason="no chromium here")]


def until(page, script):
    """Wait until a script says yes; the page's own policy lets no text be run in it."""
    for _ in range(600):
        if page.evaluate(script):
            return
        page.wait_for_timeout(50)
    pytest.fail(f"never so: {script}")


@pytest.fixture(scope="module")
def browser():
    with sync_api.sync_playwright() as playwright:
        found = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield found
        found.close()


@pytest.fixture
def shown(browser, tmp_path):
    """A page of the example on a wide screen, the server's side of it, and what the browser complains of."""
    path = tmp_path / "pair.toml"
    shutil.copy(ROOT / "examples" / "elliptic-pair.toml", path)
    server = Page(path)
    context = browser.new_context(viewport={"width": 1400, "height": 900})
    page = context.new_page()
    said, asked = [], []
    page.on("console", lambda message: said.append(message.text) if message.type == "error" else None)
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("request", lambda request: asked.append(request.url))
    page.goto(f"http://127.0.0.1:{server.port}/{server.token}/")
    page.wait_for_selector("#picture path.part")
    yield page, server
    assert said == []
    assert all(url.startswith((f"http://127.0.0.1:{server.port}/", "data:")) for url in asked)
    context.close()
    server.end()


def test_the_gear_follows_the_slider_and_comes_back(shown):
    page, _ = shown
    gear = page.locator("#picture path.part").first
    before = gear.get_attribute("d")
    page.locator(SLIDER).fill("0.5")
    until(
        page,
        f"""(() => {{ const one = document.querySelector("#picture path.part");
        return one && one.getAttribute("d") !== {before!r}; }})()""",
    )
    assert page.title().startswith("•")
    page.click("#undo")
    until(
        page,
        f"""(() => {{ const one = document.querySelector("#picture path.part");
        return one && one.getAttribute("d") === {before!r}; }})()""",
    )
    assert page.locator("#save").is_disabled()
    page.click("#redo")
    until(page, "document.title.startsWith('•')")


def test_a_fix_is_followed_and_saved(shown):
    page, server = shown
    page.fill('[id="field-parameters.bore"]', "48")
    page.press('[id="field-parameters.bore"]', "Enter")
    page.wait_for_selector("#findings .error")
    page.locator("#findings .error .fix").first.click(timeout=60_000)
    until(page, "!document.querySelector('#findings .error')")
    page.click("#save")
    until(page, "!document.title.startsWith('•')")
    assert "bore = 48" not in server.path.read_text() or "eccentricity = 0.4" not in server.path.read_text()


def test_a_file_that_changes_on_disk_is_shown(shown):
    page, server = shown
    server.path.write_text(server.path.read_text().replace("teeth = 25", "teeth = 31"))
    until(page, "document.getElementById('field-parameters.teeth').value === '31'")
    server.path.write_text("family = [\n")
    until(page, "document.getElementById('banner').textContent.includes('no valid TOML')")


def test_two_designs_are_shown_over_each_other(shown):
    page, _ = shown
    page.click("#compare")
    page.locator(SLIDER).fill("0.2")
    page.wait_for_selector("#picture path.part")
    assert page.locator("#picture path.ghost").count() == 2
    page.click("#compare")
    assert page.locator("#picture path.ghost").count() == 0


def test_a_telephone_shows_all_of_it(shown):
    page, _ = shown
    page.set_viewport_size({"width": 390, "height": 844})
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    page.click("#play")
    until(page, "Number(document.getElementById('input').value) > 1")
