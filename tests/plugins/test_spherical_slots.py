"""One spherical machine for all phases: its pins are set in the coupler, in bores or in slots with clamps."""

import math
import tomllib
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night
from pydantic import ValidationError
from typer.testing import CliRunner

from mechwright.cli.app import make_app
from mechwright.contracts.finding import Severity, errors
from mechwright_spherical.family import Spherical
from mechwright_spherical.kinematics.bodies import pins_of_phase
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.vectors import arc, azimuth, rotate
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts import links
from mechwright_spherical.parts.frame import shells_of
from mechwright_spherical.parts.parts import parts_of
from mechwright_spherical.parts.places import coupler_seats
from mechwright_spherical.parts.seats import clamp_of, seats_of, slotted_of
from mechwright_spherical.parts.solids import cylinder

EXAMPLES = Path(__file__).parents[2] / "examples"
FAMILY = Spherical()
REFERENCE = {
    "ground": 70, "input": 25, "coupler": 65, "output": 60, "branch": -1, "point_azimuth": 30,
    "point_elevation": 25, "setting_angle": 50,
}  # fmt: skip


def solid_of(params, name):
    return next(part for part in parts_of(params) if part.name == name).build()


def four(*rows, phase=1, **more):
    return SphericalParams.model_validate(
        {
            "kind": "four-bar",
            "four_bar": {
                **REFERENCE,
                "phases": [{"crank_turn": a, "follower_turn": b} for a, b in rows],
                "phase": phase,
            },
            **more,
        }
    )


def example(name, phase=1):
    table = tomllib.loads((EXAMPLES / f"{name}.toml").read_text(encoding="utf-8"))["parameters"]
    table[table["kind"].replace("-", "_")]["phase"] = phase
    return SphericalParams.model_validate(table)


def five(phase=1):
    """The published five-bar, refined, with a third phase between both and beyond."""
    table = tomllib.loads((EXAMPLES / "spherical-five-bar-refined.toml").read_text(encoding="utf-8"))
    bar = table["parameters"]["five_bar"]
    bar |= {"phases": [{"crank_turn": -5, "rocker_turn": -12, "travel": -15}], "phase": phase}
    return SphericalParams.model_validate(table["parameters"])


def test_the_reference_machine_has_its_second_phase_s_coupler():
    bar = linkage_of(four((20, 12), phase=2)).four_bar
    assert np.degrees([bar.coupler, bar.point_azimuth, bar.point_elevation]) == pytest.approx(
        [55.307513413, 28.223724440, 18.004650530], abs=1e-8
    )
    assert np.degrees([bar.ground, bar.input, bar.output]) == pytest.approx([70, 25, 60], abs=1e-12)


@pytest.mark.parametrize("design", [four((12, -6), (-9, 5)), five()])
def test_phases_meet_in_the_pose_of_setting(design):
    """There the coupler and its point stand alike, and pins are turned on circles about their axes."""
    table = design.four_bar if design.kind == "four-bar" else design.five_bar
    key = "four_bar" if design.kind == "four-bar" else "five_bar"
    frames, points = [], []
    for number, phase in enumerate(linkage_of(design).phases, start=1):
        shown = design.model_copy(update={key: table.model_copy(update={"phase": number})})
        at = phase.at_reference
        points.append(at.p[0][:, 0])
        frames.append(pins_of_phase(linkage_of(shown), 1))
        assert float(arc(phase.loop.a0, at.a[0][:, 0])) == pytest.approx(
            float(arc(phase.loop.a0, phase.loop.a1)), abs=1e-12
        )
    np.testing.assert_allclose(points, np.tile(points[0], (len(points), 1)), atol=1e-9)
    np.testing.assert_allclose(frames, np.tile(frames[0], (len(frames), 1, 1)), atol=1e-12)
    a, c = seats_of(linkage_of(design))
    rows = table.phases
    turns = [row.follower_turn if design.kind == "four-bar" else row.rocker_turn for row in rows]
    assert np.degrees(a.angles[-len(rows) :]) == pytest.approx([row.crank_turn for row in rows], abs=1e-9)
    assert np.degrees(c.angles[-len(rows) :]) == pytest.approx(turns, abs=1e-9)


@pytest.mark.parametrize("phase", [1, 2])
def test_the_example_follows_both_paths_and_says_how_it_is_set(phase):
    params = example("spherical-four-bar-slots", phase)
    linkage = linkage_of(params)
    assert max(float(one.path_errors.max()) for one in linkage.phases) * params.radius < 1e-6
    found = FAMILY.check(params)
    assert {one.severity for one in found} == {Severity.NOTE}
    told = [one.message for one in found if one.code == "spherical.setting"]
    assert len(told) == 1
    assert "loosen the clamp of a, turn the crank by -16.2731 degrees to 52.0439 and fasten a" in told[0]
    assert "the output link by +5.83513 degrees" in told[0]
    assert list(FAMILY.settings(params)) == [f"four_bar.phase = {3 - phase}"]


@pytest.mark.parametrize("phase", [1, 2])
def test_studs_and_screws_stand_on_their_pins_all_through(phase):
    params = example("spherical-four-bar-slots", phase)
    parts = {part.name: part for part in FAMILY.parts(params)}
    assert parts["clamp-screw"].bought.designation == "ISO 4762 - M3 x 10 - 8.8"
    assert len(parts["clamp-screw"].instances) == len(parts["clamp-washer"].instances) == 2
    motion = FAMILY.solve(params, 13)
    state = linkage_of(params).shown.state(13)
    for name, pin in (("a", state.a), ("c", state.c)):
        assert parts[f"pin-{name}"].instances[0].body == f"coupler-{name}"
        axis = motion.poses[f"coupler-{name}"].rotation[:, :, 2]
        np.testing.assert_allclose(axis, -pin[0].T, atol=1e-12)


def test_phases_far_apart_have_a_bore_each():
    params = four((20, 12))
    assert slotted_of(params) == ()
    assert clamp_of(params) is None
    names = [part.name for part in FAMILY.parts(params)]
    assert "clamp-screw" not in names
    coupler = solid_of(params, "coupler")
    span, linkage = shells_of(params).links["coupler"], linkage_of(params)
    for seat in coupler_seats(linkage, pins_of_phase(linkage, 1)):
        for place in seat.places:
            assert cylinder(place, span, params.hardware.pin_diameter).intersect(coupler).Volume() < 1e-6
            assert cylinder(place, span, 11.0).intersect(coupler).Volume() > 100


@pytest.mark.parametrize("design", [example("spherical-four-bar-slots"), five()], ids=["four", "five"])
def test_slots_pass_all_places_and_marks_count_the_phases(design):
    linkage = linkage_of(design)
    coupler, span = solid_of(design, "coupler"), shells_of(design).links["coupler"]
    assert coupler.isValid()
    thread = clamp_of(design).size.size
    for seat in coupler_seats(linkage, pins_of_phase(linkage, 1)):
        for share in (0.0, 0.5, 1.0):
            at = rotate(seat.axis, share * seat.sweep, seat.ends[0])
            assert cylinder(at, span, thread).intersect(coupler).Volume() < 1e-6
            assert cylinder(at, span, design.hardware.pin_diameter).intersect(coupler).Volume() > 1
        turned = [float(azimuth(seat.axis, seat.ends[0], place)) for place in seat.places]
        assert min(turned) > -1e-9
        assert max(turned) <= seat.sweep + 1e-9
        assert len(links.marks(design, seat, span)) == sum(range(1, len(linkage.phases) + 1))


def test_a_five_bar_of_three_phases_is_one_machine():
    designs = [five(phase) for phase in (1, 2, 3)]
    for design in designs:
        assert errors(FAMILY.check(design)) == []
    assert list(FAMILY.settings(designs[1])) == ["five_bar.phase = 1", "five_bar.phase = 3"]
    shown = [{part.name for part in FAMILY.parts(design) if part.instances} for design in designs]
    assert shown[0] == shown[1] == shown[2]
    assert [math.degrees(linkage_of(one).shown.travel) for one in designs] == pytest.approx([-30, -20, -15])


def test_what_does_not_go_together_is_refused():
    with pytest.raises(ValidationError, match="both setting_angle and phases"):
        SphericalParams.model_validate({"kind": "four-bar", "four_bar": {"setting_angle": 50}})
    with pytest.raises(ValidationError, match="phase is 3, and there are 2"):
        SphericalParams.model_validate({"five_bar": {"phase": 3}})


@by_night
def test_the_example_builds_free_at_both_settings(tmp_path):
    design = str(EXAMPLES / "spherical-four-bar-slots.toml")
    done = CliRunner().invoke(make_app(), ["build", design, "-o", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    assert "warning" not in done.output
    bill = (tmp_path / "out" / "bill-of-materials.csv").read_text(encoding="utf-8")
    assert "ISO 4762 - M3 x 10 - 8.8" in bill


def test_every_phase_has_the_same_solids():
    """They are made once, for all phases; of the phase that is shown they would not be others."""
    table = tomllib.loads((EXAMPLES / "spherical-four-bar-slots.toml").read_text())["parameters"]
    shown = [
        SphericalParams.model_validate({**table, "four_bar": {**table["four_bar"], "phase": phase}})
        for phase in (1, 2)
    ]
    one, two = ({part.name: part for part in FAMILY.parts(params)} for params in shown)
    assert one["coupler"] == two["coupler"]
    solids = [solid_of(params, "coupler") for params in shown]
    assert solids[0].Volume() == pytest.approx(solids[1].Volume(), rel=1e-9)
    assert solids[0].Center().toTuple() == pytest.approx(solids[1].Center().toTuple(), abs=1e-6)
