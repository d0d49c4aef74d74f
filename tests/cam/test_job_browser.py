"""The page that plays a program, in Chromium: stock and tool against the proof, text and marks, keys, and speed."""

import base64
import importlib.util
import math

import golden_operations
import numpy as np
import pytest
from by_control import LINUXCNC, prove, scene_of
from by_night import by_night
from long_program import long_program
from scipy.ndimage import maximum_filter, minimum_filter
from shop import plate_job
from test_accessibility_browser import judged
from test_job_page import known, place_of, times_of
from test_live_browser import CHROMIUM, until
from test_viewer_browser import software

from mechwright_cam.pages.job.page import job_html
from mechwright_cam.pages.job.relief import cell_of

__all__ = ["software"]

AXE = importlib.util.find_spec("axe_playwright_python")
JOB = "document.getElementById('listing').job"
OPERATIONS = [
    "profile-outside",
    "profile-inside",
    "pocket-contour",
    "pocket-island",
    "pocket-adaptive",
    "slot",
    "groove",
    "face",
    "chamfer",
    "drill",
]
SAME = 0.05
"""Heights may differ by so much, mm, beside what a pixel is: the page sets the cutter on at fewer places."""

pytestmark = [by_night, pytest.mark.skipif(CHROMIUM is None, reason="no chromium here")]


def opened(software, path, text, width=1280):
    path.write_text(text, encoding="utf-8")
    context = software.new_context(viewport={"width": width, "height": 900}, reduced_motion="reduce")
    page = context.new_page()
    page.said = []
    page.on("console", lambda message: page.said.append(message.text) if message.type == "error" else None)
    page.on("pageerror", lambda error: page.said.append(str(error)))
    page.on(
        "request", lambda request: page.said.append(request.url) if request.url != path.as_uri() else None
    )
    page.goto(path.as_uri())
    until(page, f"Boolean({JOB} && {JOB}.picture && {JOB}.picture.drawn > 0)")
    return page


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("job")


@pytest.fixture
def plate(software, folder):
    """The part of the operation that runs around a clamp, as it is played."""
    (made,) = golden_operations.made("profile-outside", "linuxcnc")
    page = opened(
        software, folder / "plate.job.html", job_html(made.scene, made.proof, "plate.nc", "plate.setup.html")
    )
    yield page, made
    assert page.said == []
    page.context.close()


def heights(page):
    shape = page.evaluate("[data.relief.rows, data.relief.columns]")
    text = page.evaluate(
        f"""(() => {{ const bytes = new Uint8Array({JOB}.cutting.heights.buffer); let text = '';
        for (let k = 0; k < bytes.length; k += 32768) text += String.fromCharCode(...bytes.subarray(k, k + 32768));
        return btoa(text); }})()"""
    )
    return np.frombuffer(base64.b64decode(text), dtype="<f4").reshape(shape)


def within_a_pixel(scene, found):
    """Share of the page's cells whose height the proof's stock has within a cell and a half of both."""
    proof, cell = scene.simulation.heights, cell_of(scene)
    own = scene.simulation.cell
    reach = 2 * math.ceil(1.5 * (cell + own) / own) + 1
    rows, columns = (
        np.clip(((np.arange(count) + 0.5) * cell / own).astype(int), 0, size - 1)
        for count, size in zip(found.shape, proof.shape, strict=True)
    )
    low = minimum_filter(proof, reach)[np.ix_(rows, columns)] - SAME
    high = maximum_filter(proof, reach)[np.ix_(rows, columns)] + SAME
    return float(((low <= found) & (found <= high)).mean())


@pytest.mark.parametrize("operation", OPERATIONS)
def test_the_stock_at_the_end_is_that_of_the_proof_and_the_tool_is_where_the_run_has_it(
    software, folder, operation
):
    made = golden_operations.made(operation, "linuxcnc")[0]
    scene, run = made.scene, made.scene.run
    page = opened(software, folder / f"{operation}.job.html", job_html(scene, made.proof, operation))
    page.evaluate(f"{JOB}.seek({JOB}.run.seconds)")
    end = heights(page)
    assert within_a_pixel(scene, end) == 1.0
    # Back, and there again by another way.
    page.evaluate(f"{JOB}.seek({JOB}.run.seconds * 0.37)")
    half = heights(page)
    assert (half >= end - 1e-6).all()
    assert (half > end + 1e-6).any()
    page.evaluate(f"{JOB}.seek({JOB}.run.seconds)")
    np.testing.assert_allclose(heights(page), end, atol=1e-6)
    times, steps, shares = times_of(scene)
    shown = np.array(
        page.evaluate(f"(times) => times.map((time) => {JOB}.run.placeAt(time))", times.tolist())
    )
    compared = 0
    for place, step, share in zip(shown, steps, shares, strict=True):
        if run.moving[step] and known(run, step):
            # A time is held to a tenth of a millisecond, a place to half a micrometre.
            speed = run.length[step] * 1e-4 / max(float(seconds_of(scene)[step]), 1e-9)
            np.testing.assert_allclose(place, place_of(run, step, share), atol=0.002 + speed)
            compared += 1
    assert compared > 80
    assert page.said == []
    page.context.close()


def seconds_of(scene):
    from mechwright_cam.proof.timing import step_times

    return step_times(scene.run, scene.job.settings.machine, scene.motion)


def test_a_line_leads_to_its_place_and_a_time_to_its_line(plate):
    page, made = plate
    run = made.scene.run
    step = int(np.flatnonzero(run.cutting)[40])
    line = int(run.line[step])
    page.evaluate(f"document.getElementById('listing').scrollTop = {(line - 6) * 18}")
    page.locator(f".line[data-line='{line - 1}']").click()
    assert page.locator(".line.now").get_attribute("data-line") == str(line - 1)
    at = page.evaluate(f"{JOB}.picture.at")
    own = np.flatnonzero(run.line == line)
    np.testing.assert_allclose(at, run.end[own[0]], atol=0.01)
    page.locator("#bar input").focus()
    page.keyboard.press("ArrowRight")
    after = page.evaluate(f"{JOB}.time()")
    assert after > 0
    assert page.locator("#now").inner_text().split("line ")[1].startswith(str(int(run.line[own[0] + 1])))


def test_a_click_on_the_path_shows_its_line(plate):
    page, made = plate
    page.evaluate(f"{JOB}.seek({JOB}.run.seconds)")
    step = int(np.flatnonzero(made.scene.run.cutting & (made.scene.run.length > 5))[-1])
    x, y, _ = page.evaluate(f"{JOB}.picture.eye.to({JOB}.run.place({step}, 0.5).slice())")
    box = page.locator("#picture canvas").bounding_box()
    page.mouse.click(box["x"] + x, box["y"] + y)
    shown = page.evaluate(f"{JOB}.run.stepAt({JOB}.time() - 1e-6)")
    found = np.array(
        [page.evaluate(f"{JOB}.run.place({shown}, {share / 20}).slice()") for share in range(21)]
    )
    assert np.hypot(*(found[:, :2] - place_of(made.scene.run, step, 0.5)[:2]).T).min() < 2.0


def test_the_listing_holds_what_is_in_view_alone(plate):
    page, made = plate
    assert page.locator(".line").count() < 60 < len(made.text.splitlines())
    page.locator("#listing").focus()
    before = page.evaluate(f"{JOB}.time()")
    for _ in range(3):
        page.keyboard.press("PageDown")
    assert page.evaluate(f"{JOB}.time()") > before


def test_a_mark_is_jumped_to(plate):
    page, _ = plate
    button = page.locator("#marks .near button").first
    text = button.inner_text()
    button.click()
    line = text.rsplit("line ", 1)[1]
    assert page.locator(".line.now").inner_text().split()[0] == line
    assert page.evaluate(f"{JOB}.picture.mark") is not None


def test_a_program_that_fails_is_red_and_shows_the_place(software, folder):
    (made,) = golden_operations.made("pocket-contour", "linuxcnc")
    lines = made.text.splitlines()
    cut = [k for k, line in enumerate(lines) if line.startswith(("G1 X", "X"))]
    lines[cut[len(cut) // 2]] += " Z-3.5"
    text = "\n".join(lines) + "\n"
    scene, proof = scene_of(text, made.job), prove(text, made.job)
    assert not proof.ok
    page = opened(software, folder / "bad.job.html", job_html(scene, proof, "bad.nc"))
    assert page.locator(".verdict.bad").inner_text() == "does not cut the part"
    assert page.locator("#marks li").first.get_attribute("class") == "failed"
    assert page.locator(".line.failed").count() > 0
    assert page.said == []
    page.context.close()


def test_what_is_drawn_changes_with_what_is_chosen(plate):
    page, _ = plate
    page.evaluate(f"{JOB}.seek({JOB}.run.seconds * 0.6)")
    picture = f"""(() => {{ const p = {JOB}.picture, gl = p.painter.gl, all = new Uint8Array(4 * p.canvas.width * p.canvas.height);
        p.again(); return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {{
        gl.readPixels(0, 0, p.canvas.width, p.canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, all);
        let sum = 0; for (let k = 0; k < all.length; k += 4) sum = (sum * 31 + all[k] + 3 * all[k + 1] + 7 * all[k + 2] + all[k + 3]) % 4294967291; done(sum); }}))); }})()"""
    page.wait_for_timeout(500)
    seen = [page.evaluate(picture)]
    for name in ("deviation", "finished part", "tool solid", "clamps and tabs", "stock"):
        page.locator("#shown").get_by_label(name, exact=True).click()
        page.wait_for_timeout(500)
        seen.append(page.evaluate(picture))
    for name in ("feed", "engagement"):
        page.locator("#colours").select_option(name)
        page.wait_for_timeout(500)
        seen.append(page.evaluate(picture))
    page.locator("#path").select_option("none")
    page.wait_for_timeout(500)
    seen.append(page.evaluate(picture))
    assert len(set(seen)) == len(seen)


@pytest.mark.skipif(AXE is None, reason="no axe-core")
def test_a_telephone_shows_it_without_a_fault(plate):
    page, _ = plate
    assert judged(page) == []
    page.set_viewport_size({"width": 390, "height": 844})
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    assert judged(page) == []


def test_without_webgl_2_there_is_the_still_stock_and_the_text(software, folder):
    (made,) = golden_operations.made("slot", "linuxcnc")
    path = folder / "still.job.html"
    path.write_text(job_html(made.scene, made.proof, "slot.nc"), encoding="utf-8")
    page = software.new_page()
    page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null;")
    said = []
    page.on("pageerror", lambda error: said.append(str(error)))
    page.goto(path.as_uri())
    assert "no WebGL 2" in page.locator("#still").inner_text()
    assert page.locator("#still svg").is_visible()
    page.locator("#listing").focus()
    page.keyboard.press("PageDown")
    assert page.locator(".line.now").count() == 1
    assert said == []
    page.close()


def test_a_program_that_is_too_long_shows_its_stock_alone(software, folder, monkeypatch):
    monkeypatch.setattr("mechwright_cam.pages.job.page.MOST_STEPS", 20)
    (made,) = golden_operations.made("slot", "linuxcnc")
    path = folder / "large.job.html"
    path.write_text(job_html(made.scene, made.proof, "slot.nc"), encoding="utf-8")
    page = software.new_page()
    said = []
    page.on("pageerror", lambda error: said.append(str(error)))
    page.goto(path.as_uri())
    assert "more than the 20 that a page plays" in page.locator("#why").inner_text()
    assert page.locator("#still svg").is_visible()
    assert not page.locator("#picture").is_visible()
    assert said == []
    page.close()


def test_a_hundred_thousand_moves_open_and_play(software, folder):
    job = plate_job()
    scene = scene_of(LINUXCNC.write(long_program(100_000)), job)
    (made,) = golden_operations.made("slot", "linuxcnc")
    page = opened(software, folder / "long.job.html", job_html(scene, made.proof, "long.nc"))
    seek = page.evaluate(
        f"(() => {{ const t = performance.now(); {JOB}.seek({JOB}.run.seconds); return performance.now() - t; }})()"
    )
    assert seek < 20_000
    assert within_a_pixel(scene, heights(page)) > 0.9999
    page.evaluate(f"{JOB}.seek(0)")
    page.locator("#speed").select_option("60")
    page.click("#play")
    until(page, f"{JOB}.time() > 1")
    drawn = page.evaluate(f"{JOB}.picture.drawn")
    page.wait_for_timeout(4000)
    assert page.evaluate(f"{JOB}.picture.drawn") - drawn >= 8
    assert page.said == []
    page.context.close()
