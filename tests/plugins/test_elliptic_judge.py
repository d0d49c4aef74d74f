"""What the fast judge of elliptic gears knows: how far tips reach, distances from the ellipse, loads."""

import math

import numpy as np
import pytest

from mechwright import Finding
from mechwright.contracts.finding import errors
from mechwright_elliptic_gears.kinematics.ellipse import Ellipse
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import pair_of
from mechwright_elliptic_gears.parts.mesh_proof import first_collision, prove
from mechwright_elliptic_gears.rules.mesh import may_collide
from mechwright_elliptic_gears.rules.rule_table import RULES
from mechwright_elliptic_gears.table import table_of

COLLIDES = EllipticGearParams(eccentricity=0.2369, dedendum=1.044)
"""Tips end 0.025 modules below the flanks of their mates."""


@pytest.mark.parametrize("eccentricity", [0.0, 1e-4, 0.3, 0.7, 0.9])
def test_the_depth_of_a_point_is_its_distance_from_the_nearest_of_many(eccentricity: float) -> None:
    ellipse = Ellipse(50.0, eccentricity)
    focus = ellipse.focal_distance
    curve = ellipse.frame(np.linspace(0, math.tau, 20001)).point
    around = np.random.default_rng(1).uniform([focus - 60, -60], [focus + 60, 60], (20, 2))
    special = [[focus, 0], [0, 0], [2 * focus, 0], [focus + 49.9, 0], [focus - 70, 0], [focus, 10]]
    points = np.concatenate((around, special))
    nearest = np.array([np.hypot(*(curve - point).T).min() for point in points])
    depth = ellipse.depth(points)
    inside = ((points[:, 0] - focus) / 50) ** 2 + (points[:, 1] / ellipse.semi_minor) ** 2 < 1
    assert np.abs(depth) == pytest.approx(nearest, abs=2e-3)
    assert (depth <= nearest).all()
    assert ((depth > 0) == inside).all()


def test_the_tip_of_a_round_gear_ends_its_contact_where_the_line_of_action_leaves_it() -> None:
    params = EllipticGearParams(eccentricity=0, teeth=30, module=2, backlash=0)
    alpha, pitch, tip = math.radians(20), 30.0, 32.0
    along = math.sqrt(tip**2 - (pitch * math.cos(alpha)) ** 2) - pitch * math.sin(alpha)
    assert table_of(params).tips.depth.item() == pytest.approx(along * math.sin(alpha) / 2, rel=1e-9)


def findings(params: EllipticGearParams) -> list[Finding]:
    return RULES.findings(table_of(params))


def judged(params: EllipticGearParams) -> list[Finding]:
    return RULES.findings(table_of(params), quick=True)


def test_the_judge_finds_a_collision_and_what_is_proposed_against_it_helps() -> None:
    assert may_collide(table_of(COLLIDES))
    assert [one.code for one in errors(judged(COLLIDES))] == ["gear.mesh"]
    found = next(one for one in findings(COLLIDES) if one.code == "gear.mesh")
    assert found.proposed == tuple(table_of(COLLIDES).clearing())
    for change in found.proposed:
        better = COLLIDES.model_copy(update={key.removeprefix("parameters."): v for key, v in change.items()})
        assert not errors(findings(better)), change


@pytest.mark.parametrize("teeth", [30, 31])
@pytest.mark.parametrize("dedendum", [1.05, 1.25])
def test_a_part_of_the_turn_tells_what_the_whole_one_does(teeth: int, dedendum: float) -> None:
    """Rows of teeth that are mirror images of themselves, and such that are not."""
    params = EllipticGearParams(eccentricity=0.4, teeth=teeth, dedendum=dedendum)
    whole = prove(params)
    depth, allowance = first_collision(params)
    assert allowance == whole.allowance
    assert whole.collides == (depth > 0) == (dedendum == 1.05)
    assert depth == pytest.approx(whole.mesh.depth.max(), rel=0.05)
    span = (0.25, 0.5 if teeth % 2 else 0.75)
    place = whole.mesh.arc / pair_of(params).driver.perimeter
    seen = whole.mesh.depth[(place >= span[0]) & (place <= span[1])]
    assert seen.max() == pytest.approx(whole.mesh.depth.max(), rel=0.05)


def test_a_usual_rack_asks_no_mesh_proof() -> None:
    assert not may_collide(table_of(EllipticGearParams()))
    assert not may_collide(table_of(EllipticGearParams(eccentricity=0.7, teeth=60)))


@pytest.mark.parametrize(
    "changed",
    [
        {},
        {"dedendum": 1.07, "tip_radius": 0.45},
        {"dedendum": 1.02, "tip_radius": 0.1},
        {"addendum": 1.2, "dedendum": 1.25},
        {"load_torque": 900},
    ],
)
def test_judge_and_check_find_the_same_errors(changed: dict[str, float]) -> None:
    params = EllipticGearParams.model_validate({"eccentricity": 0.3, **changed})
    assert [one.code for one in errors(judged(params))] == [one.code for one in errors(findings(params))]


def test_without_advice_a_load_is_judged_the_same() -> None:
    params = EllipticGearParams(load_torque=900)
    plain = {one.code: one for one in judged(params)}
    for one in findings(params):
        if one.code in {"gear.root", "gear.flank"}:
            other = plain.pop(one.code)
            assert (one.message, one.severity) == (other.message, other.severity)
            assert one.proposed
            assert other.proposed == ()
    assert not plain
