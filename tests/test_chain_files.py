"""Chains as people edit them: changes of the text, the live page, and remedies that reach into a stage."""

from pathlib import Path

import numpy as np
import pytest

from mechwright import DesignError, host
from mechwright.designs.change import rewritten
from mechwright.designs.design import load
from mechwright.remedies import tried
from mechwright_cad.live.session import Session

TEXT = """\
# gears before a wheel
name = "wheel"

[[stage]]
family = "elliptic-gears"
[stage.parameters]
eccentricity = 0.0 # round
module = 2
teeth = 24

[[stage]]
family = "geneva"
start = 45 # mid index
[stage.parameters]
law = "straight"
slots = 4
entry_radius = 80
roller_radius = 4
"""


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """A chain's file."""
    found = tmp_path / "wheel.toml"
    found.write_text(TEXT, encoding="utf-8")
    return found


def test_a_change_of_a_stage_keeps_comments_and_order() -> None:
    """A value, a new key, and one that is left out."""
    change = {"stage.2.parameters.slots": 6, "stage.2.gap": 3.0, "stage.1.parameters.teeth": None}
    found = rewritten(TEXT, change)
    assert "eccentricity = 0.0 # round" in found
    assert "start = 45 # mid index" in found
    assert "slots = 6" in found
    assert "gap = 3.0" in found
    assert "teeth" not in found


def test_the_live_page_shows_and_changes_stages(path: Path) -> None:
    """What the browser asks: fields, the motion with a change, and parts."""
    session = Session(path, host())
    try:
        said = session.described({})
        assert said["title"] == "Chain of mechanisms"
        keys = {one["key"] for one in said["fields"]}
        assert {"stage.1.parameters.teeth", "stage.2.parameters.slots"} <= keys
        one = session.asks["motion"]({"change": {}})["scene"]
        two = session.asks["motion"]({"change": {"stage.2.parameters.slots": 6}})["scene"]
        assert one != two
        parts = session.asks["parts"]({"change": {}})
        assert parts["scene"]
        assert {one["code"] for one in parts["findings"]} >= {"chain.index", "chain.key"}
        with pytest.raises(DesignError, match=r"stage\.2\.parameters"):
            session.asks["motion"]({"change": {"stage.2.parameters.slotz": 6}})
    finally:
        session.close()


def test_inches_reach_into_stages(path: Path) -> None:
    """Bare lengths of each stage's table, and the stage's own gap."""
    text = TEXT.replace('name = "wheel"', 'name = "wheel"\nunits = "inch"').replace(
        "module = 2", "module = 0.1"
    )
    text = text.replace("entry_radius = 80", "entry_radius = 3").replace(
        "roller_radius = 4", "roller_radius = 0.2"
    )
    path.write_text(text.replace("start = 45", "gap = 0.1\nstart = 45"), encoding="utf-8")
    design = load(path, host())
    gears, wheel = design.params.stage  # type: ignore[attr-defined]
    assert gears.parameters.module == pytest.approx(2.54)
    assert wheel.parameters.entry_radius == pytest.approx(76.2)
    assert (wheel.gap, wheel.start) == pytest.approx((2.54, 45.0))


def test_a_remedy_that_was_tried_names_the_stage(path: Path) -> None:
    """A roller that is too large for its wheel: the change is one of the second stage."""
    text = TEXT.replace("roller_radius = 4", "roller_radius = 30").replace("start = 45", "start = 0")
    path.write_text(text, encoding="utf-8")
    design = load(path, host())
    found = [one for one in tried(design, design.check()) if one.severity == "error"]
    assert found
    assert all(one.parameter.startswith("stage.2.parameters.") for one in found)
    fixes = [one.fix for one in found if one.fix]
    assert fixes
    assert all(key.startswith("stage.") for fix in fixes for key in fix)


def test_geneva_behind_a_reversed_shaft_runs_backwards(path: Path) -> None:
    """Behind two round pairs the driver turns the other way, and the wheel with it: the same figures."""
    pair = TEXT[TEXT.index("[[stage]]") : TEXT.index("[[stage]]", TEXT.index("[[stage]]") + 1)]
    path.write_text(TEXT.replace(pair, pair + pair, 1).replace("start = 45", "start = 90"), encoding="utf-8")
    back = load(path, host()).solve(73)
    path.write_text(TEXT.replace("start = 45", "start = 0"), encoding="utf-8")
    front = load(path, host()).solve(73)
    np.testing.assert_allclose(back["3.omega_w"], -front["2.omega_w"], atol=1e-9)
    np.testing.assert_allclose(back["3.alpha_w"][1:18], -front["2.alpha_w"][1:18], atol=1e-8)
    assert back.scalars["3.Ca"].value == pytest.approx(front.scalars["2.Ca"].value, rel=1e-9)
