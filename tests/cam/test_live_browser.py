"""The live page in a browser: with Chromium, and playwright of the extra ``browser``."""

import shutil
from pathlib import Path

import pytest
from by_night import in_ci
from test_live import Page

from mechwright.designs.design import load
from mechwright.plugins.host import host

sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
ROOT = Path(__file__).parents[2]
SLIDER = '[data-key="parameters.eccentricity"] input[type=range]'

pytestmark = [in_ci, pytest.mark.skipif(CHROMIUM is None, reason="no chromium here")]


def until(page, script):
    """Wait until a script says yes; the page's own policy lets no text be run in it."""
    for _ in range(4000):
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
    until(page, "document.querySelectorAll('#picture path.ghost').length === 2")
    page.click("#compare")
    until(page, "!document.querySelector('#picture path.ghost')")


def test_a_telephone_shows_all_of_it(shown):
    page, _ = shown
    page.set_viewport_size({"width": 390, "height": 844})
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    top = "document.querySelector('{}').getBoundingClientRect().top"
    tops = [page.evaluate(top.format(one)) for one in ("#stage", "#said-of", "#fields", "#figures")]
    assert tops == sorted(tops), "fields to drag come before the plots and their long table"
    page.click("#play")
    until(page, "Number(document.getElementById('input').value) > 1")


def test_two_pages_on_one_file_follow_each_other(shown):
    page, server = shown
    other = page.context.new_page()
    other.goto(page.url)
    other.wait_for_selector("#picture path.part")
    page.fill('[id="field-parameters.teeth"]', "31")
    page.press('[id="field-parameters.teeth"]', "Enter")
    other.fill('[id="field-parameters.bore"]', "14")
    other.press('[id="field-parameters.bore"]', "Enter")
    until(other, "document.title.startsWith('•')")
    page.click("#save")
    until(other, "document.getElementById('field-parameters.teeth').value === '31'")
    until(other, "document.getElementById('banner').textContent.includes('your change stays on top of it')")
    assert other.input_value('[id="field-parameters.bore"]') == "14"
    other.click("#save")
    until(page, "document.getElementById('field-parameters.bore').value === '14'")
    text = server.path.read_text()
    assert "teeth = 31" in text
    assert "bore = 14" in text
    other.close()


def test_a_build_goes_on_when_its_page_goes_away(shown):
    page, server = shown
    page.click("#build")
    until(page, "!document.getElementById('stop').hidden")
    address = page.url
    page.goto("about:blank")
    page.goto(address)
    until(page, "!document.getElementById('stop').hidden")
    page.click("#stop")
    until(page, "document.getElementById('doing').textContent.startsWith('Nothing was built')")
    assert not server.path.with_name("pair-build").exists()


@pytest.fixture
def asked(browser, tmp_path):
    """A page of a requirement with few starts."""
    path = tmp_path / "line.toml"
    text = (ROOT / "examples" / "four-bar-line-requirement.toml").read_text()
    path.write_text(text.replace("longest_link = 250", "longest_link = 250\nstarts = 3000\ndesigns = 2"))
    server = Page(path)
    context = browser.new_context(viewport={"width": 1400, "height": 900})
    page = context.new_page()
    said = []
    page.on("console", lambda message: said.append(message.text) if message.type == "error" else None)
    page.on("pageerror", lambda error: said.append(str(error)))
    page.goto(f"http://127.0.0.1:{server.port}/{server.token}/")
    page.wait_for_selector(".grip")
    yield page, server
    assert said == []
    context.close()
    server.end()


FOUND = (
    "document.querySelector('[data-design][aria-pressed=true]') && document.querySelector('#picture .bone')"
)


def test_a_path_point_is_dragged_and_a_design_is_taken_over(asked):
    page, server = asked
    until(page, FOUND)
    grip = page.locator('.grip[data-name="points 3"]')
    assert grip.get_attribute("aria-valuetext") == "20, 30 mm"
    box = grip.locator(".ring").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    # Handles of its neighbours lie over its middle: the nearest is taken.
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 10, y, steps=5)
    page.mouse.up()
    until(page, "document.title.startsWith('•')")
    until(page, "document.getElementById('sought').hidden === false")
    until(page, "document.getElementById('sought').hidden && " + FOUND)
    moved = grip.get_attribute("aria-valuetext")
    assert moved != "20, 30 mm"
    page.get_by_role("button", name="Save line-1 as").click()
    page.fill("#new-name", "taken")
    page.press("#new-name", "Enter")
    until(page, "document.getElementById('banner').textContent.includes('taken.toml: written')")
    design = load(server.path.with_name("taken.toml"), host())
    path = design.family.solve(design.params, 721).path("P")[:, :2]
    wanted = [float(part) for part in moved.removesuffix(" mm").split(",")]
    assert min(((path - wanted) ** 2).sum(axis=1)) ** 0.5 < 5, "near the place where it was dragged"
    page.click("#undo")
    until(
        page,
        "document.querySelector('.grip[data-name=\"points 3\"]').getAttribute('aria-valuetext') === '20, 30 mm'",
    )
    until(page, "document.getElementById('seeking').textContent.includes('given')")


def test_a_handle_is_moved_by_the_keyboard(asked):
    page, _ = asked
    until(page, FOUND)
    page.locator('.grip[data-name="points 1"]').focus()
    page.keyboard.press("ArrowUp")
    until(
        page,
        "document.querySelector('.grip[data-name=\"points 1\"]').getAttribute('aria-valuetext') !== '20, 20 mm'",
    )
    until(page, "document.activeElement.dataset.name === 'points 1'")
    page.set_viewport_size({"width": 390, "height": 844})
    assert page.evaluate("document.documentElement.scrollWidth") == 390


def test_another_page_that_searches_is_told(asked):
    page, _ = asked
    other = page.context.new_page()
    other.goto(page.url)
    until(other, FOUND)
    until(
        page, FOUND + " || document.getElementById('seeking').textContent.includes('Another page searches')"
    )
    other.close()


@pytest.fixture
def drawing(browser, tmp_path):
    """A page of a drawn linkage, without its frame."""
    path = tmp_path / "drawn-ram.toml"
    text = (ROOT / "examples" / "linkages" / "drawn-ram.toml").read_text(encoding="utf-8")
    path.write_text(text.replace('[machine]\nframe = "base"\nmotor = "auto"\n', ""), encoding="utf-8")
    server = Page(path)
    context = browser.new_context(viewport={"width": 1400, "height": 900})
    page = context.new_page()
    said = []
    page.on("console", lambda message: said.append(message.text) if message.type == "error" else None)
    page.on("pageerror", lambda error: said.append(str(error)))
    page.goto(f"http://127.0.0.1:{server.port}/{server.token}/")
    page.wait_for_selector("#picture path.part")
    yield page, server
    assert said == []
    context.close()
    server.end()


def value_of(name):
    return f"document.querySelector('.grip[data-name=\"{name}\"]')?.getAttribute('aria-valuetext')"


def test_a_point_of_a_drawn_linkage_is_dragged_undone_and_saved(drawing):
    page, server = drawing
    assert page.evaluate("[...document.querySelectorAll('.grip')].map((one) => one.dataset.name).join()") == (
        "O,A,B,B0,C,D"
    )
    assert page.locator('.grip[data-name="B0"] text').text_content() == "B0"
    before = page.evaluate("document.querySelector('#picture').innerHTML")
    box = page.locator('.grip[data-name="C"] .ring').bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 12, y - 6, steps=4)
    page.mouse.up()
    until(page, "document.title.startsWith('•')")
    until(
        page,
        f"{value_of('C')} && {value_of('C')} !== '110, 90 mm' && document.querySelector('#picture path.part')",
    )
    assert page.evaluate("document.querySelector('#picture').innerHTML") != before
    moved = [float(part) for part in page.evaluate(value_of("C")).removesuffix(" mm").split(",")]
    page.click("#undo")
    until(page, f"{value_of('C')} === '110, 90 mm'")
    page.click("#redo")
    until(page, f"{value_of('C')} !== '110, 90 mm'")
    page.click("#save")
    until(page, "document.getElementById('banner').textContent.includes('saved')")
    point = load(server.path, host()).params.points["C"]
    assert [point.x, point.y] == pytest.approx(moved, abs=0.01)
    page.locator('.grip[data-name="D"]').focus()
    page.keyboard.press("ArrowRight")
    until(page, f"{value_of('D')} !== '200, 80 mm'")
    until(page, "document.activeElement?.dataset?.name === 'D'")


def test_a_linkage_that_is_chosen_brings_its_fields(browser, tmp_path):
    path = tmp_path / "klann.toml"
    path.write_text('format = 1\nfamily = "linkage"\nname = "klann"\n[parameters]\nlinkage = "klann"\n')
    server = Page(path)
    page = browser.new_page()
    page.goto(f"http://127.0.0.1:{server.port}/{server.token}/")
    page.wait_for_selector("#picture path.part", state="attached")
    tables = (
        "[...new Set([...document.querySelectorAll('.field')].map((one) => one.dataset.key.split('.')).filter((one) =>"
        " one[0] === 'parameters' && one.length > 2).map((one) => one[1]))].join()"
    )
    assert page.evaluate(tables) == "klann"
    page.select_option("[id='field-parameters.linkage']", "hoecken")
    until(page, f"{tables} === 'hoecken'")
    page.fill("[id='field-parameters.hoecken.crank']", "22")
    page.press("[id='field-parameters.hoecken.crank']", "Enter")
    until(
        page,
        "document.querySelector('[data-key=\"parameters.hoecken.crank\"]').classList.contains('changed')",
    )
    page.click("#save")
    until(page, "document.getElementById('banner').textContent.includes('saved')")
    saved = load(path, host()).params
    assert (saved.linkage, saved.hoecken.crank) == ("hoecken", 22.0)
    until(page, f"{tables} === 'hoecken'")
    page.close()
    server.end()
