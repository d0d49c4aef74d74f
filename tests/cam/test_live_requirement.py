"""A requirement in the browser: what the server says of places, drags, searches and what they find."""

import json
import shutil
import time
from pathlib import Path

import pytest
from by_night import in_ci
from test_live import Page

from mechwright.designs.requirement import load_requirement
from mechwright.plugins.host import host
from mechwright_cad.live.seeking import Seeking
from mechwright_cad.live.wishing import Wishing

EXAMPLES = Path(__file__).parents[2] / "examples"
ANGLES_ALONE = ("cam-size", "four-bar-function", "noncircular-geneva", "spherical-poses")
"""Requirements that ask for no place, but for angles, sizes or turns of a body, so that nothing is dragged."""
REQUIREMENTS = sorted(
    path for path in EXAMPLES.glob("*requirement.toml") if not path.stem.startswith(ANGLES_ALONE)
)
STROKE = "slider-crank-stroke-requirement"


def found(seeking, seconds=240):
    """The state of a search when it is done."""
    for _ in range(int(seconds / 0.1)):
        state = seeking()
        if state["state"] != "runs":
            return state
        time.sleep(0.1)
    pytest.fail("the search goes on and on")


@pytest.fixture
def wishing(tmp_path):
    path = tmp_path / "stroke.toml"
    shutil.copy(EXAMPLES / f"{STROKE}.toml", path)
    one = Wishing(path, host())
    yield one
    one.close()


@pytest.mark.parametrize("path", REQUIREMENTS, ids=lambda path: path.stem)
def test_every_requirement_has_places_that_are_drawn_and_dragged(path):
    one = Wishing(path, host())
    before = one.asks["targets"]({"change": {}})
    assert before["targets"]
    json.dumps(before, allow_nan=False)
    scene = before["scene"]
    for target in before["targets"]:
        if "window" in scene:
            left, bottom, wide, high = scene["window"]
            assert left < target["place"][0] < left + wide
            assert bottom < target["place"][1] < bottom + high
        else:
            assert sum(part**2 for part in target["place"]) ** 0.5 <= scene["ball"]["radius"] + 0.01
    first = before["targets"][0]
    x, y, *z = first["place"]
    there = [x + 1.0, y + 1.0, *z]
    after = one.asks["drag"]({"change": {}, "target": first["name"], "place": there})
    table = load_requirement(path, host()).table.model_dump(mode="json")
    assert any(table[key.removeprefix("requirement.")] != value for key, value in after["change"].items())
    again = one.asks["targets"]({"change": after["change"]})["targets"]
    assert again == after["targets"]
    if again[0]["line"] in {"points", "poles", "phases 1"} and not z:
        assert again[0]["place"] == there


def test_the_first_point_of_all_phases_goes_along():
    one = Wishing(EXAMPLES / "five-bar-phases-requirement.toml", host())
    after = one.asks["drag"]({"change": {}, "target": "phases 2, 1", "place": [-6.0, 188.0]})
    assert [points[0] for points in after["change"]["requirement.phases"]] == [[-6.0, 188.0]] * 3
    one.requirement(after["change"])


def test_a_drag_leads_to_a_design_that_is_taken_over(wishing):
    far = next(
        one for one in wishing.asks["targets"]({"change": {}})["targets"] if one["name"].startswith("far")
    )
    x, y = far["place"]
    change = wishing.asks["drag"]({"change": {}, "target": far["name"], "place": [x + 15, y]})["change"]
    wanted = change["requirement.stroke"]
    assert wanted > 125
    assert wishing.asks["seek"]({"change": change})["state"] == "runs"
    state = found(wishing.states["seeking"])
    assert (state["state"], state["told"]) == ("done", "1 found, 1 given")
    assert [figure["value"] for figure in state["designs"][0]["figures"][:1]] == [0.0], "1e-14 mm is 0"
    name = state["designs"][0]["name"]
    scene = wishing.asks["shown"]({"change": change, "design": name})["scene"]
    slide = scene["channels"]["s"]["values"]
    assert max(slide) - min(slide) == pytest.approx(wanted, rel=1e-3), "every third degree"
    said = wishing.asks["take"]({"design": name, "name": "taken"})["said"]
    assert "taken.toml: written; mechwright live" in said
    design = host().family("slider-crank")
    assert design.name in wishing.path.with_name("taken.toml").read_text()
    assert 'name = "taken"' in wishing.path.with_name("taken.toml").read_text()
    with pytest.raises(Exception, match="is none of the designs that were found last"):
        wishing.asks["take"]({"design": "other", "name": "other"})
    # What was found before is there at once when one comes back to it.
    wishing.asks["seek"]({"change": {"requirement.stroke": 30}})
    again = wishing.asks["seek"]({"change": change})
    assert (again["state"], again["designs"]) == ("done", state["designs"])


def test_a_newer_question_ends_the_older_search(tmp_path):
    path = tmp_path / "line.toml"
    shutil.copy(EXAMPLES / "four-bar-line-requirement.toml", path)
    seeking = Seeking(path)
    try:
        seeking.start({"requirement.starts": 1_000_000}, "slow")
        (worker,), end = seeking._run.pool._workers, time.monotonic() + 60
        while (first := worker._process) is None and time.monotonic() < end:
            time.sleep(0.01)
        number = seeking.state()["number"]
        seeking.start({"requirement.starts": 1_000_000}, "slower")
        assert first.poll() is not None, "two searches would share the processor"
        assert seeking.state()["number"] == number + 1
        seeking.stop()
        assert seeking.state()["state"] == "none"
    finally:
        seeking.close()


def test_why_nothing_was_found_is_told(wishing):
    wishing.asks["seek"]({"change": {"requirement.offset": 400}})
    state = found(wishing.states["seeking"])
    assert state["designs"] == []
    assert state["findings"][0]["parameter"] == "offset"


def test_what_is_wrong_is_told(wishing):
    for ask, body, words in (
        ("seek", {"change": {"requirement.stroke": -1}}, "stroke"),
        ("targets", {"change": {"requirement.no_such": 1}}, "no_such"),
        ("drag", {"change": {}, "target": "nobody", "place": [1, 2]}, "there is no such place"),
        ("drag", {"change": {}, "target": "far end of the stroke", "place": "here"}, "sent no place"),
        ("seek", {"change": {"family": "geneva"}}, "changed in its file"),
    ):
        with pytest.raises(Exception, match=words):
            wishing.asks[ask](body)


@in_ci
def test_the_server_shows_a_requirement(tmp_path):
    path = tmp_path / "stroke.toml"
    shutil.copy(EXAMPLES / f"{STROKE}.toml", path)
    page = Page(path)
    try:
        known = page.ask("described", change={})
        assert known["seeks"]
        assert {one["key"] for one in known["fields"]} >= {"requirement.stroke", "requirement.offset"}
        page.ask("seek", change={})
        state = found(lambda: json.loads(page.get("seeking")))
        assert state["told"] == "1 found, 1 given"
        assert "saved" in page.ask("save", change={"requirement.stroke": 90}, digest=known["digest"])["said"]
        assert "stroke = 90" in path.read_text()
    finally:
        page.end()
