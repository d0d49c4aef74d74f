"""A spherical four-bar with its motor: flange, bushes and rings in their places, base, and what is refused."""

import csv
import io
import math
import tomllib
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night
from typer.testing import CliRunner

from mechwright import host
from mechwright.cli.app import make_app
from mechwright.contracts.finding import Severity, errors
from mechwright.designs.design import design_of
from mechwright.machine.frame.coupled import SHAFT_GAP
from mechwright.remedies import Limits, tried
from mechwright_spherical.family import Spherical
from mechwright_spherical.kinematics.drive import train_of
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.frame import shells_of
from mechwright_spherical.parts.mount import bracket_of, hubs_of, least_height, shaft_end, shaft_form, sizes
from mechwright_spherical.parts.places import gear_span
from mechwright_spherical.rules.mount import MOUNT
from mechwright_spherical.table import SphericalTable

EXAMPLES = Path(__file__).parents[2] / "examples"
EXAMPLE = EXAMPLES / "spherical-machine.toml"
DOUBLE = EXAMPLES / "spherical-double-crank-machine.toml"
FIVE = EXAMPLES / "spherical-five-bar-machine.toml"
FAMILY = Spherical()


def content(machine=None, example=EXAMPLE, **tables):
    found = tomllib.loads(example.read_text())
    for name, table in tables.items():
        merged = found["parameters"].get(name, {}) | table
        found["parameters"][name] = {key: value for key, value in merged.items() if value is not None}
    found["machine"] |= machine or {}
    return found


def design(machine=None, example=EXAMPLE, **tables):
    return design_of(content(machine, example, **tables), Path("sphere.toml"), "", host())


def places(found, name):
    """Where the copies of a part stand in the ground: origin (3,), mm, and rotation (3, 3)."""
    motion = found.solve(3)
    (part,) = [one for one in found.parts() if one.name == name]
    return [
        (
            motion.poses[at.body].position[0] + at.z * motion.poses[at.body].rotation[0][:, 2],
            motion.poses[at.body].rotation[0],
        )
        for at in part.instances
    ]


@pytest.mark.parametrize("example", [EXAMPLE, DOUBLE, pytest.param(FIVE, marks=by_night)])
def test_motor_coupling_and_pillars_stand_along_the_input_axis(example):
    found = design(example=example)
    assert errors(found.check()) == []
    flange, motion = found.family.mounting(found.params), found.solve(3)
    axis = motion.poses["ground"].rotation[0][:, 0] * (-1 if example is DOUBLE else 1)
    for name in ("motor", "coupling", "motor-plate"):
        ((origin, rotation),) = places(found, name)
        assert np.cross(origin, axis) == pytest.approx(np.zeros(3), abs=1e-9)
        assert rotation[:, 2] == pytest.approx(-axis)
    coupling = places(found, "coupling")[0][0] @ axis
    # Its lower end is out by half its length, and the shaft ends short of its middle.
    assert coupling - flange.end == pytest.approx(25 / 2 + SHAFT_GAP)
    pillars = [origin for origin, _ in places(found, "motor-pillar")]
    assert len(pillars) == 4
    for origin in pillars:
        beside = origin - (origin @ axis) * axis
        assert np.linalg.norm(beside) == pytest.approx(math.sqrt(2) * flange.half)


def test_the_base_plate_reaches_under_everything_and_all_is_above_it():
    found = design()
    ((_, turn),), motion = places(found, "base-plate"), found.solve(3)
    up = turn[:, 2]
    (plate,) = [one for one in found.parts() if one.name == "base-plate"]
    ((low, _),) = places(found, "base-plate")
    top = low @ up + plate.thickness
    foot = found.family.mounting(found.params).foot
    inner = motion.poses[foot.body].position[0] @ up
    assert top == pytest.approx(inner - foot.thickness)
    flange = found.family.mounting(found.params)
    end = max(float(origin @ up) for origin, _ in places(found, "motor"))
    assert end > top
    x0, y0, x1, y1 = plate.outline.bounds
    ((motor, _),) = places(found, "motor")
    x, y, _ = turn.T @ (motor - low)
    assert x0 < x < x1
    assert y0 < y < y1
    centre = turn.T @ -low
    assert min(centre[0] - x0, x1 - centre[0], centre[1] - y0, y1 - centre[1]) >= flange.reach


@pytest.mark.parametrize("diameter", [5.0, 6.0, 8.0])
def test_each_fixed_axis_has_bushes_flush_with_its_hub_and_a_ring_in_its_groove(diameter):
    params = SphericalParams(
        kind="four-bar",
        hardware={"pin_diameter": diameter, "boss_diameter": 16},
        stand={"arc": 80, "motor_flange": 56, "screw": 5.5},
    )
    hubs = hubs_of(params)
    shells = shells_of(params)
    for name, hub in hubs.items():
        first, last = hub.bushes[0], hub.bushes[-1]
        assert first[1] == hub.span[0]
        assert last[1] + last[0].length <= hub.span[1] + 1e-9
        assert {bush.bore for bush, _ in hub.bushes} == {diameter}
        form = shaft_form(params, shells, name)
        (groove,) = form.grooves
        assert shells.pins[name][0] + groove.at == pytest.approx(hub.span[1] + 0.3)
        assert groove.at + groove.width + hub.ring.edge <= form.length + 1e-9
    assert len(hubs["a0"].bushes) == 2
    assert hubs["a0"].bushes[1][1] + hubs["a0"].bushes[1][0].length == pytest.approx(hubs["a0"].span[1])
    assert shaft_end(params, "a0") > shaft_end(params, "b0")


def test_a_design_without_a_flange_is_as_it_was():
    params = SphericalParams(kind="four-bar")
    assert hubs_of(params) == {}
    names = {part.name for part in FAMILY.parts(params)}
    assert not any(name.startswith(("bush", "circlip", "spacer")) for name in names)


@pytest.mark.parametrize("size", sizes())
def test_pins_of_a_machine_have_bushes_rings_and_couplings(size):
    assert size in {5, 6, 8, 10}


@pytest.mark.parametrize(
    ("machine", "tables", "code", "fix"),
    [
        ({"frame": "plates"}, {}, "frame.own-ground", {"machine.frame": "base"}),
        ({}, {"stand": {"motor_flange": 50}}, "frame.flange", {"parameters.stand.motor_flange": 56.0}),
        pytest.param({}, {"stand": {"arc": 55}}, "frame.flange-tilt", None, marks=by_night),
        (
            {},
            {"hardware": {"link_thickness": 7.2}},
            "frame.foot",
            {"parameters.stand.plate_thickness": 8.8},
        ),
        ({}, {"hardware": {"pin_diameter": 7}}, "spherical.mount", {"parameters.hardware.pin_diameter": 6.0}),
        pytest.param({}, {"stand": {"plate_thickness": 6}}, "spherical.mount", None, marks=by_night),
        ({"load": 3.0}, {}, "frame.coupling", None),
    ],
)
def test_what_does_not_go_is_refused_with_a_change_that_was_tried(machine, tables, code, fix):
    found = design(machine, **tables)
    # Where no change is known that helps, a few tries show what is said: a search goes on for seconds.
    limits = Limits(tries=4) if fix is None else None
    told = [one for one in tried(found, found.check(), limits) if one.severity is Severity.ERROR]
    assert [one.code for one in told] == [code]
    (one,) = told
    assert one.parameter
    assert one.remedy
    if fix is not None:
        assert one.fix == fix
    if one.fix is not None:
        assert errors(found.changed(one.fix).check()) == []


@pytest.mark.parametrize("name", ["spherical-double-crank", "spherical-five-bar-projected"])
def test_what_has_no_place_for_a_motor_gets_the_flange_that_it_wants(name):
    table = tomllib.loads((EXAMPLES / f"{name}.toml").read_text()) | {"machine": {"frame": "base"}}
    found = design_of(table, Path("sphere.toml"), "", host())
    assert found.chosen == {"parameters.stand.motor_flange": 56}
    assert errors(found.check()) == []


def test_the_shaft_of_a_double_crank_goes_through_the_centre_to_its_motor():
    """Both bushes, the crank's boss and the coupling lie on one line; nothing that moves comes near it."""
    found = design(example=DOUBLE)
    params, shells = found.params, shells_of(found.params)
    form, hub = shaft_form(params, shells, "a0"), hubs_of(params)["a0"]
    start = -shells.links["crank"][1]
    assert start + form.length == pytest.approx(shaft_end(params, "a0"))
    (near, inner), (far, outer) = hub.bushes
    assert -inner == shells.links["ground-2"][1]
    assert near.length <= shells.links["ground-2"][1] - shells.links["ground-2"][0]
    assert outer + far.length == pytest.approx(hub.span[1])
    motion = found.solve(361)
    axis = motion.poses["ground"].rotation[0][:, 0]
    for name, arcs in {"crank": 60, "rocker": 70}.items():
        turned = np.radians(np.linspace(0, arcs, 30))
        along = np.array([np.cos(turned), np.sin(turned), 0 * turned])
        cosines = np.einsum("nij,jk,i->nk", motion.poses[name].rotation, along, -axis)
        room = shells.links[name][0] * np.sqrt(1 - np.maximum(cosines, 0) ** 2)
        assert room[cosines > 0].min(initial=math.inf) > params.hardware.link_width / 2 + 3


@pytest.mark.parametrize(("arcs", "what"), [((88, 153, 87, 27), "coupler"), ((28, 157, 91, 29), "bridge")])
def test_a_shaft_that_something_would_meet_beyond_the_centre_is_refused(arcs, what):
    table = dict(zip(("ground", "input", "coupler", "output"), arcs, strict=True))
    stand = {"motor_flange": 56, "screw": 5.5, "arc": 90}
    hardware = {"frame": "two", "link_thickness": 8}
    params = SphericalParams(kind="four-bar", radius=60, four_bar=table, hardware=hardware, stand=stand)
    found = MOUNT.findings(SphericalTable(params), quick=False)
    (fault,) = [one for one in found if "through the centre" in one.message]
    assert f"the {what} would run into it" in fault.message
    assert fault.proposed == ({"parameters.stand.motor_flange": None},)


def test_an_arc_over_the_gears_carries_the_motor_of_a_five_bar():
    found = design(example=FIVE)
    params, shells = found.params, shells_of(found.params)
    low, high = bracket_of(params)
    train = train_of(linkage_of(params), params.drive)
    assert low > gear_span(params, shells, train)[1]
    hub = hubs_of(params)["a0"]
    assert hub.bushes[0][1] == shells.links["ground"][0]
    assert hub.span == (low, high + 12)
    assert hubs_of(params)["b0"].ring is None
    least = least_height(params)
    faults = errors(design(example=FIVE, stand={"height": least - 1}).check())
    assert [(one.code, one.parameter, one.limit) for one in faults] == [
        ("spherical.mount", "stand.height", least)
    ]
    assert errors(design(example=FIVE, stand={"height": least}).check()) == []
    (fault,) = errors(design(example=FIVE, drive={"gears": False}).check())
    assert (fault.code, fault.parameter) == ("spherical.mount", "drive.gears")


def test_of_several_outputs_each_is_proposed():
    (fault,) = errors(design({"output": ""}, example=FIVE).check())
    assert fault.parameter == "machine.output"
    assert fault.proposed == (
        {"machine.output": "arm"},
        {"machine.output": "idler"},
        {"machine.frame": "none"},
    )


def test_the_post_turns_away_from_a_motor_at_the_far_end():
    (fault,) = errors(design(example=DOUBLE, stand={"arc": 140}).check())
    assert (fault.code, fault.parameter) == ("frame.flange-tilt", "parameters.stand.arc")
    assert fault.value == pytest.approx(140)
    assert fault.limit < 140
    assert errors(design(example=DOUBLE, stand={"arc": fault.limit}).check()) == []


def test_a_flange_has_room():
    arcs = {"ground": 45, "input": 15, "coupler": 45, "output": 50}
    table = {"kind": "four-bar", "four_bar": arcs, "stand": {"motor_flange": 250, "arc": 100, "screw": 5.5}}
    (fault,) = [one for one in FAMILY.check(SphericalParams(**table)) if one.code == "spherical.mount"]
    assert "the hub of the output" in fault.message
    table["stand"]["motor_flange"] = fault.limit - 0.01
    assert not any(one.code == "spherical.mount" for one in FAMILY.check(SphericalParams(**table)))
    table["stand"]["motor_flange"] = fault.limit + 0.01
    assert any(one.code == "spherical.mount" for one in FAMILY.check(SphericalParams(**table)))


@by_night
@pytest.mark.parametrize(("example", "bodies"), [(EXAMPLE, 55), (DOUBLE, 55), (FIVE, 64)])
def test_a_machine_is_built_clear_and_its_bodies_are_those_of_its_bill(example, bodies, tmp_path):
    import cadquery as cq

    folder = tmp_path / "out"
    done = CliRunner().invoke(make_app(), ["build", str(example), "-o", str(folder)])
    assert done.exit_code == 0, done.output
    rows = csv.DictReader(io.StringIO((folder / "bill-of-materials.csv").read_text()))
    count = sum(float(row["qty"]) for row in rows if row["kind"] in {"made", "bought"})
    solids = cq.importers.importStep(str(folder / "assembly.step")).solids().vals()
    assert len(solids) == count == bodies
    assert all((folder / f"{plate}.nc").exists() for plate in ("base", "motor-plate", "base-plate"))
    assert all((folder / f"{name}.pdf").exists() for name in ("shaft-a0", "shaft-b0", "motor-pillar"))


@pytest.mark.parametrize("example", [EXAMPLE, FIVE])
def test_pins_without_bush_or_ring_forbid_parts_and_no_motion(example):
    wanted = design(example=example)
    found = design(example=example, hardware={"pin_diameter": 7.3})
    stopping = errors(found.judge())
    assert any(one.code == "spherical.mount" for one in stopping)
    assert not [one for one in stopping if one.stage == "motion"]
    moved, usual = found.solve(19), wanted.solve(19)
    for name in ("axle-a0", "axle-b0", "hub-a0", "hub-b0"):
        np.testing.assert_allclose(moved.poses[name].rotation, usual.poses[name].rotation, atol=1e-12)
