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
from mechwright.remedies import Limits, tried
from mechwright_spherical.family import Spherical
from mechwright_spherical.frame import shells_of
from mechwright_spherical.mount import hubs_of, shaft_end, shaft_form, sizes
from mechwright_spherical.params import SphericalParams

EXAMPLES = Path(__file__).parents[2] / "examples"
EXAMPLE = EXAMPLES / "spherical-machine.toml"
FAMILY = Spherical()


def content(machine=None, **tables):
    found = tomllib.loads(EXAMPLE.read_text())
    for name, table in tables.items():
        merged = found["parameters"].get(name, {}) | table
        found["parameters"][name] = {key: value for key, value in merged.items() if value is not None}
    found["machine"] |= machine or {}
    return found


def design(machine=None, **tables):
    return design_of(content(machine, **tables), Path("sphere.toml"), "", host())


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


def test_motor_coupling_and_pillars_stand_along_the_input_axis():
    found = design()
    assert errors(found.check()) == []
    flange, motion = found.family.mounting(found.params), found.solve(3)
    axis = motion.poses["ground"].rotation[0][:, 0]
    for name in ("motor", "coupling", "motor-plate"):
        ((origin, rotation),) = places(found, name)
        assert np.cross(origin, axis) == pytest.approx(np.zeros(3), abs=1e-9)
        assert rotation[:, 2] == pytest.approx(-axis)
    coupling = places(found, "coupling")[0][0] @ axis
    # Its lower end is out by half its length, and the shaft ends in its middle.
    assert coupling - flange.end == pytest.approx(25 / 2)
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
        (
            {},
            {"stand": {"motor_flange": None, "screw": None}},
            "frame.mounting",
            {"parameters.stand.motor_flange": 56.0},
        ),
        ({"frame": "plates"}, {}, "frame.own-ground", {"machine.frame": "base"}),
        ({}, {"stand": {"motor_flange": 50}}, "frame.flange", {"parameters.stand.motor_flange": 56.0}),
        ({}, {"stand": {"arc": 55}}, "frame.flange-tilt", None),
        (
            {},
            {"hardware": {"link_thickness": 7.2}},
            "frame.foot",
            {"parameters.stand.plate_thickness": 8.8},
        ),
        ({}, {"hardware": {"pin_diameter": 7}}, "spherical.mount", {"parameters.hardware.pin_diameter": 6.0}),
        ({}, {"stand": {"plate_thickness": 6}}, "spherical.mount", None),
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


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("spherical-double-crank", "the input's shaft ends inside the links"),
        ("spherical-five-bar-projected", "the bevel drive of a five-bar"),
    ],
)
def test_what_has_no_place_for_a_motor_is_refused_by_name(name, words):
    table = tomllib.loads((EXAMPLES / f"{name}.toml").read_text()) | {"machine": {"frame": "base"}}
    (fault,) = errors(design_of(table, Path("sphere.toml"), "", host()).check())
    assert fault.code == "frame.mounting"
    assert words in fault.message
    assert fault.remedy


def test_a_flange_is_for_a_four_bar_with_room():
    with pytest.raises(ValueError, match="motor_flange is for a four-bar"):
        SphericalParams(stand={"motor_flange": 56})
    arcs = {"ground": 45, "input": 15, "coupler": 45, "output": 50}
    table = {"kind": "four-bar", "four_bar": arcs, "stand": {"motor_flange": 250, "arc": 100, "screw": 5.5}}
    (fault,) = [one for one in FAMILY.check(SphericalParams(**table)) if one.code == "spherical.mount"]
    assert "the hub of the output" in fault.message
    table["stand"]["motor_flange"] = fault.limit - 0.01
    assert not any(one.code == "spherical.mount" for one in FAMILY.check(SphericalParams(**table)))
    table["stand"]["motor_flange"] = fault.limit + 0.01
    assert any(one.code == "spherical.mount" for one in FAMILY.check(SphericalParams(**table)))


@by_night
def test_a_machine_is_built_clear_and_its_bodies_are_those_of_its_bill(tmp_path):
    import cadquery as cq

    folder = tmp_path / "out"
    done = CliRunner().invoke(make_app(), ["build", str(EXAMPLE), "-o", str(folder)])
    assert done.exit_code == 0, done.output
    rows = csv.DictReader(io.StringIO((folder / "bill-of-materials.csv").read_text()))
    count = sum(float(row["qty"]) for row in rows if row["kind"] in {"made", "bought"})
    solids = cq.importers.importStep(str(folder / "assembly.step")).solids().vals()
    assert len(solids) == count == 55
    assert all((folder / f"{plate}.nc").exists() for plate in ("base", "motor-plate", "base-plate"))
    assert all((folder / f"{name}.pdf").exists() for name in ("shaft-a0", "shaft-b0", "motor-pillar"))
