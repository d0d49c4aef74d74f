"""Frames of the built-in families: machines that run clear, and what is refused by name."""

import csv
import io
import tomllib
from itertools import pairwise
from pathlib import Path

import pytest
import shapely
from by_night import by_night
from typer.testing import CliRunner

from mechwright import host
from mechwright.cli.app import make_app
from mechwright.contracts.finding import Severity, errors
from mechwright.contracts.fit_settings import Fits
from mechwright.designs.design import design_of
from mechwright.machine.frame.guard import heights
from mechwright.machine.frame.sweep import space_of
from mechwright.mechanics.mating.fitted import with_fits
from mechwright.remedies import tried
from mechwright.testing import commands

ROOT = Path(__file__).parents[2]
MACHINES = ("elliptic-pair-machine", "geneva-machine")


def content(name, machine=None, **parameters):
    found = tomllib.loads((ROOT / "examples" / f"{name}.toml").read_text())
    found["parameters"] |= parameters
    if machine is not None:
        found["machine"] = machine
    return found


def design(name, machine=None, **parameters):
    return design_of(content(name, machine, **parameters), Path("frame.toml"), "", host())


@pytest.mark.parametrize("name", MACHINES)
def test_no_plate_of_a_machine_meets_another(name, tmp_path):
    assert commands.collisions(content(name), tmp_path, solids=False) == []


@pytest.mark.parametrize(
    ("name", "line", "bodies"),
    [
        *((name, "", 64) for name in MACHINES),
        ("geneva-machine", '[parameters]\ndriver_direction = "backwards"', 64),
        ("elliptic-pair-machine", "[machine]\nguard = true", 66),
    ],
)
@by_night
def test_a_machine_is_built_clear_and_its_bodies_are_those_of_its_bill(name, line, bodies, tmp_path):
    import cadquery as cq

    file = tmp_path / "machine.toml"
    text = (ROOT / "examples" / f"{name}.toml").read_text()
    if line:
        text = text.replace(line.partition("\n")[0], line, 1)
    file.write_text(text)
    folder = tmp_path / "out"
    done = CliRunner().invoke(make_app(), ["build", str(file), "-o", str(folder)])
    assert done.exit_code == 0, done.output
    rows = csv.DictReader(io.StringIO((folder / "bill-of-materials.csv").read_text()))
    count = sum(float(row["qty"]) for row in rows if row["kind"] in {"made", "bought"})
    solids = cq.importers.importStep(str(folder / "assembly.step")).solids().vals()
    assert len(solids) == count == bodies
    assert all((folder / f"{plate}.nc").exists() for plate in ("lower-plate", "upper-plate", "base-plate"))


@pytest.mark.parametrize("name", MACHINES)
def test_what_stands_is_clear_of_what_moves_by_more_than_play(name):
    found = design(name)
    (around,) = found.surroundings
    motion = found.solve(121)
    standing = {body for body, place in around.places.items() if place.on == ""}
    columns = [
        part
        for part in around.parts
        if part.name in {"pillar", "plain-pillar"} and all(one.body in standing for one in part.instances)
    ]
    moving = space_of(found.family.parts(found.params), motion).region
    assert len(columns) == 2
    for piece in space_of(columns, motion).pieces:
        assert piece.region.distance(moving) > 2.9


def test_a_design_without_a_frame_is_as_its_family_gives_it():
    found = design("elliptic-pair")
    assert found.surroundings == ()
    assert [*found.parts()] == with_fits(found.family.parts(found.params), found.solve(2), Fits())
    assert set(found.solve(3).poses) == {"gear-2", "gear-4", "coupler"}


@pytest.mark.parametrize(
    ("name", "parameters", "code", "words"),
    [
        ("crank-rocker-three-poles", {}, "frame.own-ground", "no bearing plates go around it"),
        ("double-crank", {}, "frame.own-ground", "no bearing plates go around it"),
        ("slider-crank-quick-return", {}, "frame.own-ground", "no bearing plates go around it"),
        ("spherical-crank-rocker", {}, "frame.own-ground", "no bearing plates go around it"),
        ("figure-eight-train", {}, "frame.own-ground", "no bearing plates go around it"),
        ("elliptic-pair", {"bore": 0}, "frame.mounting", "gears without a bore have no shafts"),
        ("geneva-prototype", {}, "frame.in-the-way", "passes the axis of spindle wheel at 8.81 mm"),
    ],
)
def test_what_has_no_frame_is_refused_by_name(name, parameters, code, words):
    found = design(name, {"frame": "plates"}, **parameters).check()
    assert errors(found)
    for one in errors(found):
        assert one.code == code
        assert words in one.message
        assert one.remedy


@pytest.mark.parametrize(
    ("name", "parameters", "machine", "fix"),
    [
        ("elliptic-pair", {"bore": 4}, {}, {"parameters.bore": 5}),
        ("elliptic-pair", {"bore": 5}, {"frame": "base", "motor": "auto"}, {"parameters.bore": 8}),
        ("elliptic-pair", {}, {"frame": "plate"}, {"machine.frame": "plates"}),
        ("elliptic-pair", {"bore": 5}, {"bearing": "618"}, {"machine.bearing": "auto"}),
        ("geneva-prototype", {}, {}, {"parameters.axial_gap": 1.1}),
    ],
)
def test_what_a_refusal_advises_has_been_tried(name, parameters, machine, fix):
    found = design(name, {"frame": "plates", **machine}, **parameters)
    told = tried(found, found.check())
    fixes = [one.fix for one in told if one.severity is Severity.ERROR]
    assert fixes
    for one in fixes:
        assert one == fix
        assert errors(found.changed(one).check()) == []


@pytest.mark.parametrize("name", MACHINES)
def test_a_guard_leaves_no_way_for_a_finger_and_is_clear_of_all_that_moves(name):
    found = design(name, {"frame": "plates", "guard": True})
    assert errors(found.check()) == []
    (around,) = found.surroundings
    motion, parts = found.solve(121), {part.name: part for part in around.parts}
    rings = [part for part in around.parts if part.name.startswith("guard-")]
    assert {part.material for part in rings} == {"polycarbonate"}
    lower, upper = (
        next(part.instances[0] for part in around.parts if part.name == f"{which}-plate")
        for which in ("lower", "upper")
    )
    floor, top = lower.z + parts["lower-plate"].thickness, -upper.z - parts["upper-plate"].thickness
    stack = sorted((at.z, at.z + part.thickness) for part in rings for at in part.instances)
    assert stack[0][0] == pytest.approx(floor)
    assert all(one[1] == pytest.approx(two[0]) for one, two in pairwise(stack))
    assert 0.2 <= top - stack[-1][1] <= 4.0
    moving = space_of(found.family.parts(found.params), motion).region
    pillars = space_of([parts["pillar"], parts["plain-pillar"]], motion).pieces
    for part in rings:
        rim = shapely.Polygon(part.outline.outer.flatten())
        holes = [shapely.Polygon(loop.flatten()) for loop in part.outline.inner]
        *small, window = sorted(holes, key=lambda hole: hole.area)
        assert len(small) == 4
        assert window.contains(moving)
        assert window.exterior.distance(moving) > 2.9
        assert min(one.distance(window) for one in small) >= 3.9
        for piece in pillars:
            assert any(one.contains(piece.region) for one in small)
        plate = shapely.Polygon(parts["lower-plate"].outline.outer.flatten())
        assert rim.symmetric_difference(plate).area < 1e-6


@pytest.mark.parametrize("height", [6.2, 7.9, 13, 20.4, 31, 47.3, 90])
def test_rings_of_a_guard_fill_a_height_up_to_a_slot(height):
    found = heights(height)
    assert 0.2 <= height - sum(found) <= 2.3
    assert all(6 <= one <= 12 for one in found)
    assert max(found) - min(found) <= 2
    assert len(found) == -(-sum(found) // 12)
