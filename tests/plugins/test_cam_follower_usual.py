"""Sizes of a lever that a design leaves out follow from its cam."""

import numpy as np
import pytest

from mechwright import Severity
from mechwright.contracts.by_arrays import Designs
from mechwright_cam_follower.family import CamFollower
from mechwright_cam_follower.many import Cams
from mechwright_cam_follower.params import CamParams

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
    cams = Cams(Designs(CamParams.model_validate(kind), {"base_radius": base}))
    for name in ("centre_distance", "arm_length") if "contact" not in kind else ("centre_distance",):
        alone = [CamParams.model_validate({**kind, "base_radius": one}).value(name) for one in base]
        assert np.broadcast_to(cams.value(name), (7, 1))[:, 0].tolist() == alone


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
