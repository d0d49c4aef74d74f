"""Sizes of a lever that a design leaves out follow from its cam."""

import numpy as np
import pytest

import mechwright as mw
from mechwright import Severity
from mechwright.contracts.design_table import with_columns
from mechwright.contracts.finding import Finding, errors
from mechwright.remedies import tried
from mechwright_cam_follower.family import CamFollower
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.rules.gentler_motion import gentler

FAMILY = CamFollower()
LEVER = {"follower": "oscillating"}


@pytest.mark.parametrize("kind", [LEVER, {**LEVER, "contact": "flat"}, {**LEVER, "conjugate": True}])
@pytest.mark.parametrize("base", [30, 40, 60, 120, 200])
def test_a_cam_of_any_size_has_a_lever_that_works(kind: dict[str, object], base: float) -> None:
    """From 60 mm on the lever was in the way of its cam or did not reach it, and with a flat face it was undercut."""
    found = FAMILY.check(CamParams.model_validate({**kind, "base_radius": base}))
    assert [one.code for one in found if one.severity is not Severity.NOTE] == []


def test_the_usual_lever_is_as_it_was_and_what_is_given_stays() -> None:
    usual = CamParams.model_validate(LEVER)
    assert (usual.value("centre_distance"), usual.value("arm_length")) == (90.0, 75.0)
    near = CamParams.model_validate({**LEVER, "centre_distance": 120, "base_radius": 50})
    assert near.value("centre_distance") == 120
    arm = near.value("arm_length")
    assert arm**2 + 58**2 == pytest.approx(120**2, rel=0.03)
    other = CamParams.model_validate({**LEVER, "arm_length": arm, "base_radius": 50})
    assert other.value("centre_distance") == pytest.approx(120, abs=0.5)


@pytest.mark.parametrize("kind", [LEVER, {**LEVER, "centre_distance": 95}, {**LEVER, "contact": "flat"}])
def test_many_follow_as_each_does_by_itself(kind: dict[str, object]) -> None:
    base = np.linspace(10.0, 100.0, 7)
    params = CamParams.model_validate(kind)
    table = FAMILY.table(with_columns(params, {"base_radius": base[:, None]}), 7)
    for name in ("centre_distance", "arm_length") if "contact" not in kind else ("centre_distance",):
        alone = [CamParams.model_validate({**kind, "base_radius": one}).value(name) for one in base]
        assert np.broadcast_to(table.value(name), (7, 1))[:, 0].tolist() == alone


@pytest.mark.parametrize("kind", [{}, LEVER, {"conjugate": True}])
@pytest.mark.parametrize(("base", "roller", "bore", "pin"), [(4, 8, 4, 8), (8, 3, 12, 4), (40, 8, 15, 8)])
def test_small_cams_and_rollers_have_bores_and_studs_that_fit(kind, base, roller, bore, pin) -> None:
    """They had the usual bore, which left no wall."""
    params = CamParams.model_validate({**kind, "base_radius": base, "roller_radius": roller})
    assert (params.bore, params.pin_diameter) == (bore, pin)
    assert "follower.wall" not in [one.code for one in FAMILY.check(params)]
    given = CamParams.model_validate({**kind, "base_radius": base, "bore": 15, "pin_diameter": 8})
    assert (given.bore, given.pin_diameter) == (15, 8)


@pytest.mark.parametrize("keyway", [{}, {"keyway_width": 8.0}])
def test_a_bore_that_leaves_no_wall_is_told_the_largest_that_does(keyway):
    def thin(bore):
        found = FAMILY.check(CamParams(base_radius=30.0, screw_diameter=0, bore=bore, **keyway))
        return [one for one in found if (one.code, one.parameter) == ("follower.wall", "bore")]

    (one,) = thin(58.0)
    (change,) = one.proposed
    most = change["parameters.bore"]
    assert 40 < most < 58
    assert thin(most) == []
    assert thin(most + 0.2)


def test_a_cam_without_room_for_its_keyway_is_not_told_of_a_bore() -> None:
    found = FAMILY.check(CamParams(base_radius=13.0, screw_diameter=0, bore=20, keyway_width=12.0))
    (one,) = [one for one in found if (one.code, one.parameter) == ("follower.wall", "bore")]
    assert (one.proposed, one.remedy) == ((), "make base_radius larger")


@pytest.mark.parametrize("conjugate", [False, True])
@pytest.mark.parametrize("swing", [5, 20, 26, 27, 33, 40])
def test_levers_that_are_left_open_follow_their_swing(swing: float, conjugate: bool) -> None:
    """Over the usual 120 degrees of the cam nothing is found up to 40: pressure angle, room for the axis."""
    params = CamParams(follower="oscillating", conjugate=conjugate, swings=(swing, swing, 0, 0))
    assert [str(one) for one in FAMILY.check(params) if one.severity is not Severity.NOTE] == []


@pytest.mark.parametrize("contact", ["flat", "roller"])
@pytest.mark.parametrize("swing", [30, 40, 50])
def test_levers_that_swing_too_far_are_told_a_change_that_works(contact: str, swing: float) -> None:
    """Longer angles, a softer law, a farther axis; smaller swings last, and never none at all."""
    table = {"follower": "oscillating", "contact": contact, "swings": [swing, swing, 0, 0]}
    design = mw.design("cam-follower", **table).design
    for told in tried(design, design.check()):
        if told.severity is Severity.ERROR:
            assert told.fix
            assert None not in told.fix.values()
            assert errors(design.changed(told.fix).check()) == []


def test_moves_become_smaller_only_where_longer_ones_do_not_help() -> None:
    flat = {"follower": "oscillating", "contact": "flat"}
    longer, *_ = gentler(CamParams(**flat, swings=(30, 30, 0, 0)))
    assert set(longer) == {"parameters.angles"}
    assert sum(longer["parameters.angles"]) == pytest.approx(360)
    (smaller,) = gentler(CamParams(**flat, swings=(50, 50, 0, 0)))
    (swings,) = smaller.values()
    assert list(smaller) == ["parameters.swings"]
    assert 20 < max(swings) < 50
    assert errors(FAMILY.check(CamParams(**flat, swings=swings))) == []


def test_the_bores_of_a_short_lever_leave_their_wall() -> None:
    def thin(**table: float) -> list[Finding]:
        found = FAMILY.check(CamParams(follower="oscillating", conjugate=False, **table))
        return [one for one in found if (one.code, one.parameter) == ("follower.wall", "arm_length")]

    (one,) = thin(arm_length=9.0)
    least = (CamParams(follower="oscillating").pivot_bore + 8.0) / 2 + CamParams().least_wall
    assert one.proposed == ({"parameters.arm_length": pytest.approx(least)},)
    sizes = {"pin_diameter": 8.0}
    assert thin(arm_length=least, **sizes) == []
    assert thin(arm_length=least - 0.01, **sizes)
