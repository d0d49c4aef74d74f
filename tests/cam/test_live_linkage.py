"""A linkage in the browser: fields of the chosen one, and the points of a drawing, which are dragged."""

import math
import shutil
from pathlib import Path

import pytest

from mechwright.designs.design import load
from mechwright.errors import DesignError
from mechwright.plugins.host import host
from mechwright_cad.live.session import Session

LINKAGES = Path(__file__).parents[2] / "examples" / "linkages"


def tables(fields):
    """Names of the tables within [parameters] that have fields."""
    keys = [one["key"].split(".") for one in fields]
    return {key[1] for key in keys if key[0] == "parameters" and len(key) > 2}


@pytest.fixture
def session(tmp_path):
    shutil.copy(LINKAGES / "drawn-ram.toml", tmp_path)
    return Session(tmp_path / "drawn-ram.toml", host())


def places(answer):
    return {one["name"]: one["place"] for one in answer["targets"]}


def test_fields_are_those_of_the_linkage_that_is_chosen(session):
    klann = Session(LINKAGES / "klann.toml", host())
    fields = klann.described({})["fields"]
    assert tables(fields) == {"klann"}
    assert all(one["first"] for one in fields if one["key"].startswith("parameters.klann."))
    assert not {"parameters.points", "parameters.driver"} & {one["key"] for one in fields}
    assert tables(klann.described({"parameters.linkage": "jansen"})["fields"]) == {"jansen"}
    drawn = session.described({})["fields"]
    assert tables(drawn) == {"points"}
    assert {"parameters.points.A.x", "parameters.links"} <= {one["key"] for one in drawn}


def test_points_of_a_drawing_are_where_they_are_drawn(session):
    shown = session.asks["motion"]({"change": {}})["scene"]
    assert places(shown)["D"] == [200, 80]
    left, bottom, wide, high = shown["window"]
    for x, y in places(shown).values():
        assert left < x < left + wide
        assert bottom < y < bottom + high
    assert "targets" not in Session(LINKAGES / "klann.toml", host()).asks["motion"]({"change": {}})["scene"]


def test_a_point_that_is_dragged_moves_the_linkage_and_is_saved(session):
    found = session.asks["drag"]({"change": {}, "target": "A", "place": [3.0, 33.5]})
    assert found["change"] == {"parameters.points.A.x": 3.0, "parameters.points.A.y": 33.5}
    assert places(found)["A"] == [3.0, 33.5]
    again = session.asks["drag"]({"change": found["change"], "target": "C", "place": [100, 95]})
    assert len(again["change"]) == 4
    moved = session.changed(again["change"]).solve(5)
    assert moved["phi"][0] == pytest.approx(math.atan2(33.5, 3.0)), "it starts where it is drawn"
    old, new = (session.asks["motion"]({"change": one})["scene"]["poses"] for one in ({}, again["change"]))
    assert old.keys() == new.keys()
    assert old != new
    session.save(again["change"], session.digest())
    saved = load(session.path, host())
    assert (saved.params.points["A"].x, saved.params.points["C"].y) == (3.0, 95.0)
    assert "# A linkage of nobody's name" in session.path.read_text(encoding="utf-8")


def test_a_drawing_in_another_scale_is_dragged_in_mm(session):
    scaled = {"parameters.scale": 0.5}
    assert places(session.asks["motion"]({"change": scaled})["scene"])["D"] == [100, 40]
    found = session.asks["drag"]({"change": scaled, "target": "D", "place": [90, 41]})
    assert found["change"] == scaled | {"parameters.points.D.x": 180.0, "parameters.points.D.y": 82.0}


def test_a_drawing_in_inches_keeps_its_unit(tmp_path):
    path = tmp_path / "inches.toml"
    text = (LINKAGES / "drawn-ram.toml").read_text(encoding="utf-8")
    path.write_text(text.replace("format = 1", 'format = 1\nunits = "inch"'))
    session = Session(path, host())
    found = session.asks["drag"]({"change": {}, "target": "A", "place": [0.0, 28 * 25.4]})
    assert places(found)["D"] == [200 * 25.4, 80 * 25.4]
    session.save(found["change"], session.digest())
    assert 'A = { x = "0 mm", y = "711.2 mm" }' in path.read_text(encoding="utf-8")


def test_a_drag_into_the_void_is_told(session):
    far = session.asks["drag"]({"change": {}, "target": "B", "place": [70.0, 900.0]})["change"]
    assert places(session.asks["drag"]({"change": far, "target": "B", "place": [70.0, 60.0]}))["B"] == [
        70,
        60,
    ]
    with pytest.raises(DesignError, match="there is no such place now"):
        session.asks["drag"]({"change": {}, "target": "Z", "place": [0, 0]})
    with pytest.raises(DesignError, match="sent no place"):
        session.asks["drag"]({"change": {}, "target": "A", "place": ["0", 0]})
