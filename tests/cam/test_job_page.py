"""The page that plays a program: its steps and times against the run, its grid, its marks, and its size."""

import json
import re

import golden_operations
import numpy as np
import pytest
from by_control import LINUXCNC, posted, prove, scene_of
from by_night import by_night
from long_program import long_program
from shop import plate_job, plate_program

from mechwright_cad.viewer.packed import unpacked
from mechwright_cam.controls.reading import Kind
from mechwright_cam.pages.job.marks import marks_of
from mechwright_cam.pages.job.page import job_data, job_html
from mechwright_cam.pages.job.relief import NOTHING, in_runs, relief_of
from mechwright_cam.pages.job.steps import MICRON, TICK, TURN, UPPER, end_times, places, steps_of
from mechwright_cam.pages.job.steps import MOST as MOST_HELD
from mechwright_cam.proof.timing import step_times

MOST = 10_000_000
"""Bytes of a page of 100,000 moves."""


def judged(text, job):
    return scene_of(text, job), prove(text, job)


@pytest.fixture(scope="module")
def plate():
    """A plate with tabs, a bore, and arcs around it: its scene and its proof."""
    job = plate_job()
    return judged(posted(job, plate_program()), job)


def place_of(run, step, share):
    """Where the tool is, by the run alone."""
    start, end = run.start[step], run.end[step]
    flat = start[:2] + share * (end[:2] - start[:2])
    if run.kind[step] == Kind.ARC:
        centre = run.centre[step]
        spoke, back = start[:2] - centre, end[:2] - centre
        angle = np.arctan2(spoke[1], spoke[0]) + share * run.sweep[step]
        radius = np.hypot(*spoke) + share * (np.hypot(*back) - np.hypot(*spoke))
        flat = centre + radius * np.array((np.cos(angle), np.sin(angle)))
    return np.array((*flat, start[2] + share * (end[2] - start[2])))


def known(run, step):
    return bool(np.isfinite(np.concatenate((run.start[step], run.end[step]))).all())


def times_of(scene, count=1000, seed=7):
    """Times of the run, with the step and the share of it that runs then."""
    seconds = step_times(scene.run, scene.job.settings.machine, scene.motion)
    ends = np.cumsum(seconds)
    times = np.random.default_rng(seed).uniform(0, ends[-1], count)
    step = np.searchsorted(ends, times, side="right")
    return times, step, (times - (ends - seconds)[step]) / seconds[step]


def test_the_page_has_the_steps_of_the_run(plate):
    scene, _ = plate
    run, found = scene.run, steps_of(scene)
    ends = unpacked(found["end"], "i4").reshape(-1, 3) / MICRON
    sure = np.isfinite(run.end).all(axis=1)
    np.testing.assert_allclose(ends[sure], run.end[sure], atol=5.1e-4)
    assert (unpacked(found["line"], "u4") + 1 == run.line).all()
    assert (unpacked(found["kind"], "u1") == run.kind).all()
    arcs = unpacked(found["arc"], "u4")
    assert (arcs == np.flatnonzero(run.kind == Kind.ARC)).all()
    assert arcs.size
    np.testing.assert_allclose(unpacked(found["sweep"], "i4") / TURN, run.sweep[arcs], atol=1e-6)
    times = unpacked(found["time"], "i4") / TICK
    np.testing.assert_allclose(times, end_times(scene), atol=6e-5)
    assert found["seconds"] == pytest.approx(plate[1].time_estimate_s, abs=1e-3)
    assert [name for name, *_ in found["operations"]] == [one.name for one in plate[1].operations]


def test_a_step_goes_on_from_the_one_before_unless_it_jumps(plate):
    start, end = places(plate[0])
    found = steps_of(plate[0])
    jumps = unpacked(found["jump"], "u4")
    along = np.setdiff1d(np.arange(len(start)), jumps)
    np.testing.assert_allclose(start[along], end[along - 1], atol=1e-6)
    np.testing.assert_allclose(
        unpacked(found["from"], "i4").reshape(-1, 3) / MICRON, start[jumps], atol=5.1e-4
    )
    assert np.isfinite(start).all()
    assert np.isfinite(end).all()
    upper = plate[0].job.settings.clearance + UPPER
    assert (end[np.isposinf(plate[0].run.end[:, 2]), 2] == upper).all()


def test_what_is_engaged_is_in_material(plate):
    scene, _ = plate
    angle, run = unpacked(steps_of(scene)["engaged"], "u1"), scene.run
    assert angle.max() > 150
    assert not angle[~run.cutting].any()
    above = np.minimum(run.start[:, 2], run.end[:, 2]) > 0.5
    assert not angle[above & run.cutting].any() or run.cutting.any()


def test_equal_values_are_one_run():
    values = np.array([[0.0, 0.0, -1.25], [np.nan, np.nan, -1.25]])
    found = in_runs(values)
    assert unpacked(found["lengths"], "u4").tolist() == [2, 1, 2, 1]
    assert unpacked(found["values"], "i4").tolist() == [0, -1250, NOTHING, -1250]


def test_the_grid_has_cells_that_show_the_finest_cutter(plate):
    found = relief_of(plate[0])
    assert found["cell"] <= 1.5
    assert found["cell"] * found["columns"] >= plate[0].job.stock[2] - plate[0].job.stock[0]
    assert unpacked(found["heights"]["values"], "i4").tolist() == [0]
    assert unpacked(found["floors"]["values"], "i4").tolist() == [-1000 * plate[0].job.thickness]


def test_the_questions_of_a_workshop_are_answered(plate):
    scene, proof = plate
    texts = {
        kind: [one for one in marks_of(scene, proof) if one["kind"] == kind] for kind in ("plunge", "tab")
    }
    plunge = next(one for one in texts["plunge"] if one["text"].startswith("T3 plunges"))
    step = plunge["step"]
    assert scene.run.cutting[step]
    assert scene.run.end[step, 2] < min(0.0, scene.run.start[step, 2])
    assert f"line {scene.run.line[step]}" in plunge["text"]
    assert len(texts["tab"]) == len(scene.job.tabs) > 0
    for one, tab in zip(sorted(texts["tab"], key=lambda one: one["text"]), scene.job.tabs, strict=True):
        assert "runs over it" in one["text"]
        end = scene.run.end[one["step"]]
        assert end[2] == pytest.approx(tab.top, abs=0.25)


def test_how_near_a_tool_comes_to_a_clamp_is_said_and_true():
    (made,) = golden_operations.made("profile-outside", "linuxcnc")
    scene, proof, job = made.scene, made.proof, made.job
    near = [one for one in marks_of(scene, proof) if one["kind"] == "near"]
    assert near
    gap = float(re.search(r"within (-?[\d.]+) mm of the clamp", near[0]["text"]).group(1))
    low = scene.paths.steps[scene.paths.low[scene.paths.steps] < job.clamp.top]
    from mechwright_cam.proof.stops import clamp_set

    low = low[low > clamp_set(scene)]
    away = np.hypot(*(scene.run.end[low, :2] - job.clamp.centre).T) - job.clamp.diameter / 2
    assert gap <= (away - scene.paths.radius[low]).min() + 0.01
    assert gap > 0


def test_what_fails_is_first_and_names_its_step(plate):
    text = posted(plate[0].job, plate_program())
    lines = text.splitlines()
    deep = next(k for k, line in enumerate(lines) if re.fullmatch(r"G1 Z-\d.*", line))
    lines[deep] = re.sub(r"^G1", "G0", lines[deep])
    scene, proof = judged("\n".join(lines) + "\n", plate[0].job)
    assert not proof.ok
    marks = marks_of(scene, proof)
    assert marks[0]["kind"] == "failed"
    assert any(
        scene.run.line[one["step"]] == deep + 1
        for one in marks
        if one["kind"] == "failed" and one["step"] >= 0
    )


def test_the_page_is_the_same_every_time_and_no_text_in_it_runs(plate):
    text = plate[0].text.replace("\n", "\n(</script><script>alert 1</script><img src=x>)\n", 1)
    scene, proof = judged(text, plate[0].job)
    page = job_html(scene, proof, "<b>plate</b>.nc", "plate.setup.html")
    assert page == job_html(scene, proof, "<b>plate</b>.nc", "plate.setup.html")
    assert page.count("</script>") == 2
    assert "<b>" not in page
    assert set(re.findall(r"https?://[^\s\"']*", page)) == {"http://www.w3.org/2000/svg"}
    data = json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL).group(1))
    assert data["text"] == text.splitlines()


def test_a_program_out_of_all_bounds_has_its_page(plate):
    text = "G21 G90\nT3 M6\nS8000 M3\nG43 H3\nG0 X0 Y0 Z5\nG1 X9999 F99999999\nG4 P99999999\nG1 Z-1\nM30\n"
    scene, proof = judged(text, plate[0].job)
    assert not proof.ok
    found = job_data(scene, proof)["steps"]
    assert np.abs(unpacked(found["end"], "i4").astype(float)).max() <= MOST_HELD
    assert found["count"] == len(scene.run)


def test_a_longer_program_is_not_played_and_said_so(plate, monkeypatch):
    monkeypatch.setattr("mechwright_cam.pages.job.page.MOST_STEPS", 20)
    found = job_data(*plate)
    assert found["large"].startswith(f"{len(plate[0].run):,} steps, more than the 20 that a page plays")
    assert found["steps"].keys() == steps_of(plate[0]).keys()
    assert not any(found["steps"].values())
    assert (found["marks"], found["text"]) == ([], [])


@by_night
def test_a_page_of_a_hundred_thousand_moves_is_no_larger_than_ten_megabytes(plate):
    job = plate_job()
    text = LINUXCNC.write(long_program(100_000))
    scene = scene_of(text, job)
    page = job_html(scene, plate[1], "long.nc")
    assert len(scene.run) > 100_000
    assert len(page.encode()) < MOST
    assert job_data(scene, plate[1])["steps"]["count"] == len(scene.run)
