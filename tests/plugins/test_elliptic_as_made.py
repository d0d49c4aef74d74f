"""Gears as their programs leave them: README's pair turns, one without backlash does not, and all say so."""

import json

import numpy as np
import pytest
from as_made_builds import ROOT, built, example, facts, table
from by_night import by_night

from mechwright.contracts.finding import Severity, Stage
from mechwright.contracts.made_part import MadePart
from mechwright.mechanics.gearing.running import AGREEMENT
from mechwright_elliptic_gears.as_made.pairs import as_made, pairs_of
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.parts.backlash import (
    OFF_CENTRE,
    jamming_backlash,
    least_backlash,
    with_backlash,
)

FAMILY = EllipticGears()
PAIR = {"eccentricity": 0.4, "semi_major": 50.0, "teeth": 25, "thickness": 10.0, "bore": 12.0}


@pytest.fixture(scope="module")
def tight(tmp_path_factory):
    path = tmp_path_factory.mktemp("as-made") / "pair.toml"
    path.write_text(table("elliptic-gears", **PAIR, backlash=0.0))
    return path


def test_the_pair_of_the_readme_turns_at_every_position_over_its_tolerances():
    parts, said, params = example("elliptic-pair")
    assert not said.findings
    (pair,) = pairs_of(params, {"gear": parts})
    for off in np.linspace(-OFF_CENTRE, OFF_CENTRE, 7):
        for sign in (-1, 0, 1):
            ahead, behind = pair.gaps.play((off, 0.0), sign * pair.corridor)
            assert (ahead + behind).min() > 2e-4
    assert pair.spare(OFF_CENTRE).min() > 0
    (curve,) = said.curves
    ahead, behind = pair.gaps.play()
    assert 0 <= curve.x[0] < curve.x[-1] < 360
    assert (np.diff(curve.x) >= 0).all()
    at = np.argmin(np.abs(np.exp(1j * np.radians(curve.x))[:, None] - np.exp(1j * pair.gaps.theta)), axis=1)
    np.testing.assert_allclose(curve.lines["as made"], 1e6 * (ahead + behind)[at])
    assert (curve.lines["in the worst case"] < curve.lines["as made"]).all()
    assert (curve.lines["as drawn"] > 0).all()


def test_both_ways_agree_within_a_hundredth():
    parts, _, params = example("elliptic-pair")
    (pair,) = pairs_of(params, {"gear": parts})
    assert pair.disagreement < AGREEMENT
    ahead, behind = pair.gaps.play()
    total, other = ahead + behind, pair.mesh.free_play
    assert (total.min(), total.max()) == pytest.approx((other.min(), other.max()), rel=0.01)


def test_without_backlash_the_play_is_what_was_measured_on_the_real_path(tight):
    parts, _, params = built(tight)
    (pair,) = pairs_of(params, {"gear": parts})
    ahead, behind = pair.gaps.play()
    (part,) = parts
    total, other = ahead + behind, pair.mesh.free_play
    found = {
        "asmade.left_median": (np.median(part.off),),
        "asmade.left_mean": (part.off.mean(),),
        "asmade.play_total_min": (total.min(), other.min()),
        "asmade.play_total_max": (total.max(),),  # a peak, between whose positions polygons differ by 4 µrad
    }
    for fact in facts("asmade."):
        for value in found[fact["name"]]:
            assert value == pytest.approx(fact["expected"], abs=fact["tolerance"]), fact["name"]
    assert total.max() < 0


def test_a_pair_that_jams_is_refused_with_a_backlash_that_works(tight):
    parts, said, params = built(tight)
    (finding,) = said.findings
    assert (finding.code, finding.severity, finding.stage) == (
        "gear.as-made",
        Severity.ERROR,
        Stage.OUTPUT,
    )
    assert finding.parameter == "backlash"
    assert finding.value < 0 == finding.limit
    assert " jam: " in finding.message  # with its axes where they belong, not only with them off
    assert "make backlash 0.067" in finding.remedy
    better = with_backlash(params, least_backlash(params))
    # The walls keep what they keep: the same stock on the flanks of the better pair.
    (pair,) = pairs_of(params, {"gear": parts})
    more = (least_backlash(params)) * np.cos(np.radians(20)) / 2
    assert pair.spare(OFF_CENTRE, more).min() > 0
    assert f"{pair.spare(OFF_CENTRE, more).min() * 1e6:.0f} µrad" in finding.remedy
    assert not [f for f in FAMILY.check(better) if f.severity is not Severity.NOTE]


def test_build_refuses_it_and_check_says_so_before(command_line, tight, tmp_path):
    code, out, _ = command_line("check", str(tight))
    assert code == 1
    assert "error [gear.backlash]" in out
    assert "; set backlash = 0.067 (now 0.0" in out
    code, _, err = command_line("build", str(tight), "-o", str(tmp_path / "out"))
    assert code == 1
    assert "0.067" in err
    assert not (tmp_path / "out").exists()


def test_what_check_cannot_know_build_finds_out(command_line, tmp_path):
    path = tmp_path / "pair.toml"
    path.write_text(table("elliptic-gears", **PAIR, backlash=0.012))
    code, out, _ = command_line("check", str(path))
    assert (code, "warning [gear.backlash]" in out) == (0, True)
    code, _, err = command_line("build", str(path), "-o", str(tmp_path / "out"))
    assert code == 1
    assert "error [gear.as-made] backlash: as made gear 2 and gear 4 jam: " in err
    assert "; set backlash = 0.067 (now 0.012)" in err


def test_the_least_backlash_is_the_reference():
    found = [fact for fact in facts("gear.least_backlash") if fact["inputs"]["centre_and_eccentricities"]]
    assert len(found) == 3
    for fact in found:
        params = FAMILY.Params(eccentricity=fact["inputs"]["e"], teeth=31)
        assert fact["expected"] <= least_backlash(params) < fact["expected"] + 1e-3
        assert 0 < jamming_backlash(params) < least_backlash(params) / 4


@by_night
def test_a_train_needs_its_play_on_each_flank():
    parts, said, params = example("figure-eight-train")
    made = {part.name: [part] for part in parts}
    pairs = pairs_of(params, made)
    assert [pair.names for pair in pairs] == [("gear-2", "gear-3"), ("gear-4", "gear-5")]
    assert not said.findings
    for pair in pairs:
        ahead, behind = pair.gaps.play((0.0, 0.0), -pair.corridor - OFF_CENTRE)
        assert pair.spare(OFF_CENTRE) == pytest.approx(np.minimum(ahead, behind))
        assert pair.spare(OFF_CENTRE).min() > 0
        assert pair.disagreement < AGREEMENT
    keyed = made["gear"][0].hole_at(0.0, 0.0, params.bore)
    assert (keyed.x, keyed.y) == pytest.approx((0, 0), abs=1e-3)


@by_night
@pytest.mark.parametrize("module", [1.0, 1.3, 1.5])
def test_fine_gears_run_with_the_usual_backlash(module, tmp_path):
    """Their gaps are roughed near the walls, rounded by 0.02 mm: that cuts no wall."""
    path = tmp_path / "fine.toml"
    path.write_text(table("elliptic-gears", module=module))
    parts, said, params = built(path)
    assert params.backlash is None
    assert all(part.corridor < 0.005 for part in parts)
    assert not said.findings


def test_copies_of_a_nest_are_told_apart():
    parts, _, params = example("elliptic-pair")
    (gear,) = parts
    other = MadePart(gear.name, "gear no 2", gear.corridor, gear.sections)
    (pair,) = pairs_of(params, {"gear": [gear, other]})
    assert pair.names == ("gear-2", "gear-4")
    assert as_made(params, {}).figures == ()


def test_every_build_carries_its_page(command_line, tmp_path):
    path = str(ROOT / "examples" / "elliptic-pair.toml")
    code, _, err = command_line("build", path, "-o", str(tmp_path / "out"))
    assert (code, err) == (0, "")
    said = json.loads((tmp_path / "out" / "as-made.json").read_text())
    assert said["runs"] is True
    figures = {figure["name"]: figure for figure in said["figures"]}
    play = figures["gear-2.gear-4.play.least"]
    assert 0 == play["asked"] < play["low"] < play["made"] < play["design"]
    page = (tmp_path / "out" / "as-made.html").read_text()
    for words in ("RUNS AS MADE", "Asked for", "As drawn", "As made", "gear-as-made.dxf", "<svg"):
        assert words in page
    assert (tmp_path / "out" / "gear-as-made.dxf").stat().st_size > 1e5
