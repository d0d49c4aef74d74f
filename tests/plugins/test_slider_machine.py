"""A slider-crank whose base goes on legs: holes, stepped shaft, what is clear of what, and what is refused."""

import csv
import io
import tomllib
from pathlib import Path

import pytest
import shapely
from by_night import by_night
from typer.testing import CliRunner

from mechwright import host
from mechwright.cli.app import make_app
from mechwright.contracts.finding import Severity, errors
from mechwright.designs.design import design_of
from mechwright.machine.drive import SAMPLES, drive_of
from mechwright.machine.frame.sweep import space_of
from mechwright.machine.settings import MachineSettings
from mechwright.remedies import tried
from mechwright.standards.couplings import BORES
from mechwright.testing import commands
from mechwright_slider_crank.family import SliderCrankFamily
from mechwright_slider_crank.parameters import SliderCrankParams

EXAMPLE = Path(__file__).parents[2] / "examples" / "slider-crank-machine.toml"
FAMILY = SliderCrankFamily()


def content(machine=None, **parameters):
    found = tomllib.loads(EXAMPLE.read_text())
    found["parameters"] |= parameters
    found["parameters"] = {key: value for key, value in found["parameters"].items() if value is not None}
    found["machine"] |= machine or {}
    return found


def design(machine=None, **parameters):
    return design_of(content(machine, **parameters), Path("slider.toml"), "", host())


def part(found, name):
    (one,) = [part for part in found if part.name == name]
    return one


@pytest.mark.parametrize(
    "parameters",
    [
        {"screw_hole": 6},
        {"screw_hole": 6, "rod_bend": 30, "crank_shape": "arm", "offset": -25},
        {"screw_hole": 5.5, "slide_direction": 120, "clockwise": True, "offset": 0, "assembly": "behind"},
        {"screw_hole": 6, "screw_offset": 90},
        {"screw_hole": 6, "swing_from": 10, "swing_to": 100},
    ],
)
def test_heads_of_screws_are_clear_of_all_that_moves_and_legs_of_rails(parameters):
    params = SliderCrankParams(**parameters)
    ground, motion = FAMILY.mounting(params), FAMILY.solve(params, 361)
    parts = FAMILY.parts(params)
    holes = [(*at, 0.0) for at in ground.holes]
    turn = motion.poses["base"].rotation[0]
    places = shapely.multipoints([(turn @ at)[:2] for at in holes])
    space = space_of([one for one in parts if one.name not in {"base", "shaft", "shaft-bushing"}], motion)
    assert {piece.body for piece in space.pieces} >= {"crank", "rod", "slider", "rail-1"}
    for piece in space.pieces:
        assert piece.region.distance(places) > 4.25 + 2.9, piece.part
    if "screw_offset" in parameters:
        assert {abs(y) for _, y in ground.holes} == {90}
    x0, y0, x1, y1 = part(parts, "base").outline.bounds
    for x, y in ground.holes:
        # An edge of one and a half diameters beside each hole.
        assert min(x - x0, x1 - x, y - y0, y1 - y) == pytest.approx(1.5 * params.screw_hole)


@pytest.mark.parametrize(
    ("shaft", "end", "ring"), [(12.0, 10.0, True), (10.0, 10.0, True), (5.8, 5.0, False), (6.4, 6.35, False)]
)
def test_the_shaft_has_an_end_for_a_coupling_and_a_ring_where_there_is_one(shaft, end, ring):
    params = SliderCrankParams(screw_hole=6, shaft=shaft)
    parts = FAMILY.parts(params)
    turned = part(parts, "shaft").turned
    assert turned.steps[0].diameter == end
    assert end in BORES
    assert turned.steps[-1].diameter == shaft
    assert len(turned.grooves) == ring
    rings = [one for one in parts if one.name.startswith("circlip")]
    assert len(rings) == ring
    ground = FAMILY.mounting(params)
    assert ground.low - ground.neck - ground.end >= 1.0 + 30 / 2
    for one in rings:
        (at,) = one.instances
        foot = part(parts, "shaft").instances[0].z
        (groove,) = turned.grooves
        # The ring sits in its groove, a gap under the base.
        assert foot + groove.at == pytest.approx(at.z - 0.1)
        assert at.z + float(one.bought.designation.split(" x ")[1]) == pytest.approx(ground.low - params.gap)


def test_without_holes_the_shaft_and_the_base_are_as_they_were():
    parts = FAMILY.parts(SliderCrankParams(shaft=12))
    assert [step.diameter for step in part(parts, "shaft").turned.steps] == [12]
    assert len(part(parts, "base").outline.inner) == 5
    assert not any(one.bought and "DIN 471" in one.bought.designation for one in parts)


@pytest.mark.parametrize("changes", [{}, {"swing_from": 10, "swing_to": 100}])
def test_the_ring_and_the_stepped_shaft_count_in_the_torque(changes):
    """Torque from the joints' forces, with the family's own masses, and that of virtual power."""
    params = SliderCrankParams(crank=40, rod=110, offset=20, shaft=12, speed=300, screw_hole=6, **changes)
    motion = FAMILY.solve(params, SAMPLES)
    drive = drive_of(motion, FAMILY.parts(params), MachineSettings())
    forces = motion.channels["drive_torque"].values
    most = float(abs(forces).max())
    assert abs(drive.runs[0].torque - forces).max() == pytest.approx(0.0, abs=1e-5 * most)


@pytest.mark.parametrize(
    ("machine", "parameters", "code", "fix"),
    [
        ({}, {"screw_hole": 9.0}, "frame.ground-holes", {"parameters.screw_hole": 5.5}),
        ({}, {"shaft": 4.5}, "frame.coupling", {"parameters.shaft": 5}),
        ({"frame": "plates"}, {}, "frame.own-ground", {"machine.frame": "base"}),
        (
            {},
            {"crank": 60, "rod": 170, "offset": 0, "load": -5, "screw_offset": 20},
            "frame.ground-offset",
            {"parameters.screw_offset": 44},
        ),
        ({}, {"load": -45.0}, "frame.coupling", {"machine.motor": "none"}),
    ],
)
def test_what_does_not_go_is_refused_with_a_change_that_was_tried(machine, parameters, code, fix):
    found = design(machine, **parameters)
    (one,) = [told for told in tried(found, found.check()) if told.severity is Severity.ERROR]
    assert (one.code, one.fix) == (code, fix)
    assert errors(found.changed(fix).check()) == []


def test_a_base_for_legs_is_chosen_where_the_file_says_nothing():
    found = design({}, crank=25, rod=90, offset=0, screw_hole=None, shaft=None)
    assert found.chosen == {"parameters.screw_hole": 5.5, "parameters.shaft": 5}
    assert errors(found.check()) == []
    assert found.changed({"machine.frame": "none", "machine.motor": "none"}).chosen == {}


def test_no_plate_of_the_machine_meets_another(tmp_path):
    assert commands.collisions(content(), tmp_path, solids=False) == []


@by_night
@pytest.mark.parametrize("clockwise", [False, True])
def test_a_machine_is_built_clear_and_its_bodies_are_those_of_its_bill(clockwise, tmp_path):
    import cadquery as cq

    file, folder = tmp_path / "machine.toml", tmp_path / "out"
    file.write_text(
        EXAMPLE.read_text().replace("[parameters]", f"[parameters]\nclockwise = {str(clockwise).lower()}")
    )
    done = CliRunner().invoke(make_app(), ["build", str(file), "-o", str(folder)])
    assert done.exit_code == 0, done.output
    rows = csv.DictReader(io.StringIO((folder / "bill-of-materials.csv").read_text()))
    count = sum(float(row["qty"]) for row in rows if row["kind"] in {"made", "bought"})
    solids = cq.importers.importStep(str(folder / "assembly.step")).solids().vals()
    assert len(solids) == count == 55
    plates = ("base", "rail", "crank", "rod", "slider", "motor-plate", "base-plate")
    assert all((folder / f"{plate}.nc").exists() for plate in plates)
    turned = ("shaft", "crank-pin", "wrist-pin", "bushing", "shaft-bushing", "pillar", "leg")
    assert all((folder / f"{name}.pdf").exists() for name in turned)
