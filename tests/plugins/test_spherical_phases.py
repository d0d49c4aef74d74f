"""Synthesis of adjustable spherical linkages from a path per phase, in the plane and on the sphere."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night
from pydantic import ValidationError

from mechwright.contracts.finding import errors
from mechwright_spherical.family import Spherical
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.projection import project
from mechwright_spherical.kinematics.vectors import arc
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.requirements import AdjustablePathRequirement

FACTS = {
    fact["name"]: fact
    for fact in json.loads(
        (Path(__file__).parents[1] / "data" / "adjustable.json").read_text(encoding="utf-8")
    )["facts"]
}
SPHERE = FACTS["adjust.sphere4.two.points"]["expected"]
PLANE = FACTS["adjust.planar4.two.points"]["expected"]
FIVE = FACTS["adjust.planar5.three.points"]["expected"]


def ask(**table):
    wanted = AdjustablePathRequirement.model_validate(table)
    return wanted, Spherical().synthesise("adjustable-path", wanted, lambda done, what: None)


def assert_follows(wanted, result, most: float) -> None:
    """Every design meets its phase's points by the family's own kinematics, in order, and is built."""
    assert result.candidates
    for candidate in result.candidates:
        shown = linkage_of(candidate.params).shown
        assert float(shown.path_errors.max()) * wanted.radius < most
        steps = np.diff(shown.target_angles)
        assert (steps > 0).all() or (steps < 0).all()
        found = Spherical().check(candidate.params)
        assert errors(found) == []
        assert "spherical.order" not in [one.code for one in found]
        assert math.degrees(candidate.figures["transmission_min"].value) > wanted.least_transmission - 1e-6


def of_one_machine(result):
    """The candidates of the first machine."""
    return [one for one in result.candidates if one.residual == result.candidates[0].residual]


def test_the_reference_four_bar_comes_back_from_six_and_six_directions():
    # Two linkages go through all points; which of them is found first is a matter of rounding.
    wanted, result = ask(phases=SPHERE, linkage="four-bar", least_transmission=20, designs=2, seed=6)
    assert_follows(wanted, result, 1e-9)
    own = [candidate for candidate in result.candidates if abs(candidate.params.four_bar.ground - 70) < 1e-3]
    result = replace(result, candidates=tuple(own))
    one, two = (candidate.params.four_bar for candidate in of_one_machine(result))
    assert [one.ground, one.input, one.output, one.coupler] == pytest.approx([70, 25, 60, 65], abs=1e-6)
    assert two == one.model_copy(update={"phase": 2})
    assert one.phases[0].crank_turn == pytest.approx(20, abs=1e-6)
    assert one.phases[0].follower_turn == pytest.approx(12, abs=1e-6)
    expected = FACTS["adjust.sphere4.phase2.L_kappa_eta_deg"]["expected"]
    bar = linkage_of(result.candidates[1].params).four_bar
    assert np.degrees([bar.coupler, bar.point_azimuth, bar.point_elevation]) == pytest.approx(
        expected, abs=1e-6
    )
    turned = [
        math.degrees(result.candidates[1].figures[f"{name}_turned"].value) for name in ("crank", "follower")
    ]
    assert turned == pytest.approx([20, 12], abs=1e-6)
    assert "12 points in 2 phases, and 12" in result.findings[0].message


@pytest.mark.parametrize(
    "moves", ["moving", pytest.param("fixed", marks=by_night), pytest.param("both", marks=by_night)]
)
def test_planar_points_are_projected_and_met_on_the_sphere(moves):
    wanted, result = ask(
        phases=[points[:4] for points in PLANE], linkage="four-bar", moves=moves, projection_length=100,
        projection_centre="best", least_transmission=30, tried=1000, designs=1,
    )  # fmt: skip
    assert_follows(wanted, result, 1e-9)
    note = next(one for one in result.findings if one.code == "spherical.projection")
    assert note.value > 1e-3  # what the projection alone would leave
    designs = [candidate.params.four_bar for candidate in of_one_machine(result)]
    assert np.ptp([one.input for one in designs]) < 1e-9
    assert np.ptp([one.output for one in designs]) < 1e-9
    for design, points in zip(designs, PLANE, strict=True):
        middle = np.array(design.path)
        # A best centre is about somewhere in the paths, so each given point is a direction near the z axis.
        assert len(middle) == len(points[:4])
        assert (middle[:, 2] > 0.5).all()


def test_directions_are_searched_in_the_plane_where_that_is_asked():
    wanted, result = ask(
        phases=[points[:4] for points in SPHERE], linkage="four-bar", search="plane", projection_length=1,
        least_transmission=30, tried=1000, designs=1,
    )  # fmt: skip
    assert_follows(wanted, result, 1e-9)
    first = result.candidates[0].params.four_bar.path
    np.testing.assert_allclose(first, SPHERE[0][:4], atol=1e-9)


@by_night
def test_planar_points_are_searched_on_the_sphere_where_that_is_asked():
    wanted, result = ask(
        phases=[points[:4] for points in PLANE], linkage="four-bar", search="sphere", projection_length=150,
        least_transmission=30, designs=1,
    )  # fmt: skip
    assert_follows(wanted, result, 1e-9)
    np.testing.assert_allclose(
        result.candidates[0].params.four_bar.path[1], project(PLANE[0][1], 150), atol=1e-9
    )


def test_a_five_bar_with_three_phases_has_one_set_of_links():
    wanted, result = ask(
        phases=[points[:4] for points in FIVE], projection_length=300, projection_centre="best",
        least_transmission=30, tried=1000, designs=1,
    )  # fmt: skip
    assert_follows(wanted, result, 1e-6)
    designs = of_one_machine(result)
    assert [round(one.figures["phase"].value) for one in designs] == [1, 2, 3]
    tables = [one.params.five_bar for one in designs]
    table = tables[0]
    pin = {name: np.array(getattr(table, name)) for name in ("a0", "a1", "a1n", "b1", "c1", "c1n")}
    assert float(arc(pin["a0"], pin["a1"])) == pytest.approx(float(arc(pin["a0"], pin["a1n"])), abs=1e-9)
    assert float(arc(pin["b1"], pin["c1"])) == pytest.approx(float(arc(pin["b1"], pin["c1n"])), abs=1e-9)
    assert tables == [table.model_copy(update={"phase": phase}) for phase in (1, 2, 3)]
    assert table.phases[0].crank_turn == pytest.approx(
        math.degrees(designs[2].figures["crank_turned"].value), abs=1e-9
    )
    assert list(Spherical().settings(designs[0].params)) == ["five_bar.phase = 2", "five_bar.phase = 3"]
    told = [one for one in result.findings if one.code == "spherical.setting"]
    assert [one.value for one in told] == pytest.approx(
        [math.degrees(one.figures["crank_turned"].value) for one in designs[1:]]
    )
    assert all("gears open" in one.message for one in told)


def test_machines_without_room_for_their_links_are_not_given():
    """On the smallest sphere machines that are built at 60 mm run into themselves; what is left there is whole."""
    phases = [points[:4] for points in SPHERE]
    wanted, roomy = ask(phases=phases, linkage="four-bar", radius=60, greatest_arc=75, tried=200)
    assert_follows(wanted, roomy, 1e-9)
    wanted, narrow = ask(phases=phases, linkage="four-bar", radius=5, greatest_arc=75, tried=200)
    assert {"spherical.gap", "spherical.clearance"} & {reason.code for reason in narrow.rejected}
    assert not {"spherical.gap", "spherical.clearance"} & {reason.code for reason in roomy.rejected}
    assert_follows(wanted, narrow, 1e-4)
    assert {one.params.hardware.pin_diameter < 6 for one in narrow.candidates} == {True}


@pytest.mark.parametrize(
    ("table", "word"),
    [
        ({"linkage": "four-bar"}, "linkage is for phases"),
        ({"phases": SPHERE, "turns": [0, 1, 2, 3]}, "turns is for poses"),
        ({"phases": SPHERE, "moves": "fixed"}, "moves"),
        ({"phases": SPHERE[:1]}, "a five-bar has two at least"),
        ({"phases": SPHERE, "full_turn": True}, "full_turn is for a four-bar"),
        ({"phases": SPHERE, "linkage": "four-bar", "ratio": 2}, "ratio is for a five-bar"),
        ({"phases": [SPHERE[0], SPHERE[1][1:]], "linkage": "four-bar"}, "begin at different points"),
        (
            {"phases": SPHERE, "linkage": "four-bar", "least_arc": 80, "greatest_arc": 40},
            "below greatest_arc",
        ),
    ],
)
def test_what_does_not_go_together_is_refused(table, word):
    with pytest.raises(ValidationError, match=word):
        AdjustablePathRequirement.model_validate(table)


def test_points_along_the_travel_are_in_order_however_near_they_are():
    for angles, wrong in (([-8, -10, -20], None), ([-8, -8, -20], None), ([-8, -20, -10], -10)):
        five_bar = {"path_n": [[0, 2]] * 3, "path_angles_n": angles}
        said = Spherical().check(SphericalParams.model_validate({"five_bar": five_bar}))
        order = [one.value for one in said if one.code == "spherical.order"]
        assert order == ([] if wrong is None else [pytest.approx(wrong)])
