"""A base under a mechanism's own ground plate: legs, motor and heads that are clear, and what is refused."""

import csv
import io
import math
import tomllib
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
import shapely
import tomlkit
from by_night import by_night
from typer.testing import CliRunner

from mechwright import host
from mechwright.cli.app import make_app
from mechwright.contracts.finding import Severity, errors
from mechwright.designs.design import design_of
from mechwright.machine.frame.base import FOOT, UNDER
from mechwright.machine.frame.coupled import PLATE, SHAFT_GAP
from mechwright.machine.frame.sweep import space_of
from mechwright.remedies import tried
from mechwright.testing import commands
from mechwright.testing.frames import ground_faults

EXAMPLES = Path(__file__).parents[2] / "examples"
FOUR, FIVE, EIGHT = "four-bar-machine", "five-bar-machine", "figure-eight-machine"
DOUBLE = "double-crank"
MOTORISED = {"frame": "base", "motor": "auto"}


def content(machine=None, example=FOUR, **parameters):
    found = tomllib.loads((EXAMPLES / f"{example}.toml").read_text())
    if example == DOUBLE:
        found |= {"machine": dict(MOTORISED)}
        found["parameters"] |= {"screw_hole": 6, "load_torque": 0.3}
    found["machine"] |= machine or {}
    found["parameters"] |= parameters
    found["parameters"] = {key: value for key, value in found["parameters"].items() if value is not None}
    return found


def design(machine=None, example=FOUR, **parameters):
    return design_of(content(machine, example, **parameters), Path("ground.toml"), "", host())


def heights(found):
    """Of each part that stands around the mechanism, screws apart: lower and upper end of its copies, mm."""
    (around,) = found.surroundings
    parts = [part for part in around.parts if not part.name.startswith("screw")]
    space = space_of(parts, found.solve(2))
    return {
        part.name: (
            min(one.low for one in space.pieces if one.part == part.name),
            max(one.high for one in space.pieces if one.part == part.name),
        )
        for part in parts
    }


@pytest.mark.parametrize("example", [FOUR, FIVE, EIGHT, DOUBLE])
def test_from_the_ground_plate_down_to_the_feet_every_part_stands_on_the_next(example):
    found = design(example=example)
    assert errors(found.check()) == []
    at, ground = heights(found), found.family.mounting(found.params)
    tower = [
        (ground.low, ground.high),
        *(at[k] for k in ("pillar", "motor-plate", "leg", "base-plate", "foot")),
    ]
    for (low, _), (_, high) in pairwise(tower):
        assert low == pytest.approx(high)
    low, high = at["foot"]
    assert high - low == FOOT[1]
    assert at["motor-plate"][1] - at["motor-plate"][0] == PLATE
    # The shaft ends in the middle of its coupling, and below the motor there is room for its cable.
    assert sum(at["coupling"]) / 2 == pytest.approx(ground.end - SHAFT_GAP)
    assert at["coupling"][1] < ground.bare <= ground.low
    assert at["motor"][0] - at["base-plate"][1] == pytest.approx(UNDER)


def test_without_a_motor_legs_go_up_to_the_ground_plate():
    found = design({"motor": "none"})
    assert errors(found.check()) == []
    at, ground = heights(found), found.family.mounting(found.params)
    assert "motor-plate" not in at
    assert at["leg"][1] == pytest.approx(ground.low)
    assert at["base-plate"][1] <= ground.end - UNDER


@pytest.mark.parametrize("turn", [{}, {"ground_angle": 37.0, "pivot_x": 12.0, "pivot_y": -5.0}])
def test_columns_stand_under_the_holes_wherever_the_ground_plate_lies(turn):
    found = design(**turn)
    ground, motion = found.family.mounting(found.params), found.solve(121)
    angle = math.radians(turn.get("ground_angle", 0.0))
    (around,) = found.surroundings
    (pillar,) = [part for part in around.parts if part.name == "pillar"]
    for one, (x, y) in zip(pillar.instances, ground.holes, strict=True):
        at = motion.poses[one.body].position[0]
        assert at[0] == pytest.approx(turn.get("pivot_x", 0.0) + x * math.cos(angle) - y * math.sin(angle))
        assert at[1] == pytest.approx(turn.get("pivot_y", 0.0) + x * math.sin(angle) + y * math.cos(angle))
    heads = shapely.multipoints([motion.poses[one.body].position[0, :2] for one in pillar.instances])
    space = space_of(found.family.parts(found.params), motion)
    over = [piece for piece in space.between(ground.high, ground.high + 5.0) if piece.body != "ground"]
    assert over
    for piece in over:
        assert piece.region.distance(heads) > 4.25 + 2.9


@pytest.mark.parametrize("example", [FIVE, EIGHT])
def test_one_plate_has_the_motor_behind_it_and_nothing_below(example):
    found = design({"frame": "plate"}, example=example)
    assert errors(found.check()) == []
    at, ground = heights(found), found.family.mounting(found.params)
    assert not {"leg", "base-plate", "foot"} & set(at)
    assert at["pillar"] == pytest.approx((at["motor-plate"][1], ground.low))
    (pillar,) = [part for part in found.surroundings[0].parts if part.name == "pillar"]
    space = at["pillar"][1] - at["pillar"][0]
    assert sum(thread.depth for thread in pillar.turned.threads) < space
    screws = [part for part in found.surroundings[0].parts if part.name.startswith("screw-m5")]
    assert sum(len(part.instances) for part in screws) == 8


@pytest.mark.parametrize(
    "example", [FOUR, *(pytest.param(one, marks=by_night) for one in (FIVE, EIGHT, DOUBLE))]
)
def test_no_plate_meets_another(example, tmp_path):
    assert commands.collisions(content(example=example), tmp_path, solids=False) == []


def test_bolts_of_two_ground_plates_go_into_the_pillars():
    found = design(example=DOUBLE)
    parts = {part.name: part for part in (*found.parts(), *found.surroundings[0].parts)}
    bolt, pillar = parts["bolt"].turned, parts["pillar"].turned
    (thread,) = [one for one in pillar.threads if one.end == "upper"]
    end, grip, _ = bolt.steps
    assert thread.diameter == end.diameter == 5
    assert end.length < thread.depth
    assert grip.diameter == 6
    # From under the lower plate to over the upper one.
    low, high = parts["ground"].instances[0].z, parts["ground-2"].instances[0].z + 8
    assert grip.length == pytest.approx(high - low)
    assert parts["bolt"].instances[0].z + end.length == pytest.approx(low)
    heads = [
        one.body for name, part in parts.items() if name.startswith("screw-m5") for one in part.instances
    ]
    assert not any(body.startswith("column") and not body.endswith("-below") for body in heads)


def test_a_key_reaches_the_screws_of_the_gears_clamp_through_the_motors_plate():
    found = design(example=FIVE)
    ground, motion = found.family.mounting(found.params), found.solve(121)
    ((at, radius),) = ground.access
    (plate,) = [part for part in found.surroundings[0].parts if part.name == "motor-plate"]
    holes = [shapely.Polygon(loop.flatten()) for loop in plate.outline.inner]
    (way,) = [hole for hole in holes if hole.contains(shapely.Point(at))]
    assert way.area == pytest.approx(math.pi * radius**2, rel=1e-3)
    upright = [part for part in found.surroundings[0].parts if not part.name.startswith("screw")]
    space = space_of([*found.family.parts(found.params), *upright], motion)
    screws = [piece for piece in space.pieces if piece.part == "hub-screw"]
    assert len(screws) == 2
    for piece in screws:
        assert way.contains(piece.region)
        assert not [
            other.part
            for other in space.between(-1e9, piece.low)
            if other.region.intersects(way) and other.part not in {"motor-plate", "base-plate"}
        ]


def test_pillars_stand_clear_of_gears_and_gears_hang_clear_of_the_motors_plate():
    found = design(example=FIVE)
    motion = found.solve(121)
    pieces = space_of(found.family.parts(found.params), motion).pieces
    gears = [piece for piece in pieces if piece.high <= found.family.mounting(found.params).low]
    pillars = [part for part in found.surroundings[0].parts if part.name == "pillar"]
    assert {"pinion", "idler", "wheel", "hub-screw"} <= {piece.part for piece in gears}
    for one in space_of(pillars, motion).pieces:
        assert all(piece.region.distance(one.region) > 2.9 for piece in gears)
    top = heights(found)["motor-plate"][1]
    assert all(piece.low >= top + 2.0 for piece in gears if piece.body != "crank")


@pytest.mark.parametrize(
    ("machine", "parameters", "code", "fix"),
    [
        pytest.param(
            {},
            {"example": FIVE, "post_offset": 0},
            "frame.ground-offset",
            {"parameters.post_offset": 29},
            marks=by_night,
        ),
        ({}, {"example": DOUBLE, "screw_hole": 7}, "frame.ground-holes", {"parameters.screw_hole": 6}),
        pytest.param(
            {},
            {"example": EIGHT, "screw_offset": 75},
            "frame.ground-offset",
            {"parameters.screw_offset": 82},
            marks=by_night,
        ),
        pytest.param(
            {},
            {"example": EIGHT, "stub_length": 10},
            "frame.coupling",
            {"parameters.stub_length": 16},
            marks=by_night,
        ),
        (
            {"load": 0.4},
            {"pin_diameter": 5, "screw_hole": 5.5},
            "frame.coupling",
            {"parameters.pin_diameter": 6},
        ),
        ({}, {"screw_hole": 8.0}, "frame.ground-holes", {"parameters.screw_hole": 5.5}),
        ({}, {"pin_diameter": 5.8, "screw_hole": 5.5}, "frame.coupling", {"parameters.pin_diameter": 6}),
        ({}, {"ground_thickness": 46.0}, "frame.ground-thickness", {"parameters.ground_thickness": 45}),
        ({"frame": "plate", "motor": "none"}, {}, "frame.one-plate", {"machine.motor": "auto"}),
        ({"frame": "plates"}, {}, "frame.own-ground", {"machine.frame": "base"}),
        ({"bearing": "60"}, {}, "frame.own-ground", {"machine.bearing": "auto"}),
        ({"guard": True}, {}, "frame.own-ground", {"machine.guard": False}),
        (
            {"bearing_arrangement": "locating-free"},
            {},
            "frame.own-ground",
            {"machine.bearing_arrangement": "floating"},
        ),
        ({"cover": True}, {}, "frame.own-ground", {"machine.cover": False}),
        ({"plate_thickness": 12.0}, {}, "frame.own-ground", {"machine.plate_thickness": None}),
    ],
)
def test_what_does_not_go_is_refused_with_a_change_that_was_tried(machine, parameters, code, fix):
    found = design(machine, **parameters)
    (one,) = [told for told in tried(found, found.check()) if told.severity is Severity.ERROR]
    assert (one.code, one.fix) == (code, fix)
    assert errors(found.changed(fix).check()) == []


@pytest.mark.parametrize(
    ("parameters", "chosen"),
    [
        ({"example": EIGHT, "screw_hole": None}, {"parameters.screw_hole": 6}),
        ({"example": DOUBLE, "screw_hole": None}, {"parameters.screw_hole": 6}),
        ({"example": EIGHT, "stub_diameter": None}, {"parameters.stub_diameter": 10}),
        ({"screw_offset": None}, {"parameters.screw_offset": 42}),
    ],
)
def test_what_a_file_leaves_out_is_as_the_frame_wants_it(parameters, chosen):
    found = design({}, **parameters)
    assert found.chosen == chosen
    assert errors(found.check()) == []
    assert "design.chosen" in {one.code for one in found.check()}
    # What the file says is the user's, and a key that has no frame to serve stays left out.
    assert design({"frame": "none", "motor": "none"}, **parameters).chosen == {}


def test_what_does_not_help_is_not_chosen():
    found = design({"bearing": "60"}, screw_offset=None)
    assert found.chosen == {}
    assert {one.code for one in errors(found.check())} == {"frame.own-ground"}


def test_the_offset_that_is_advised_is_the_least_that_works():
    assert errors(design(screw_offset=42).check()) == []
    (fault,) = errors(design(screw_offset=41).check())
    assert fault.proposed == ({"parameters.screw_offset": 42},)


@by_night
def test_heads_are_clear_in_the_other_phases_too():
    """A coupler that comes near the heads goes farther out in phase 2, and phase 1 asks for as much."""
    asked = {}
    for phases in (0, 1):
        for phase in range(1, 2 + phases):
            table = content(
                {"motor": "none", "axial_gap": 4}, coupler_point_x=40, coupler_point_y=70, screw_offset=None
            )
            if phases:
                table["parameters"] |= {"setting_angle": 70, "phases": [{"crank_turn": -40}], "phase": phase}
            found = design_of(table, Path("phases.toml"), "", host())
            (fault,) = errors(found.surroundings[0].findings)
            asked[phases, phase] = fault.limit
    assert asked[1, 1] == asked[1, 2] > asked[0, 1]


@pytest.mark.parametrize(("example", "bodies"), [(FOUR, 50), (FIVE, 67), (EIGHT, 63), (DOUBLE, 55)])
@by_night
def test_a_machine_is_built_clear_and_its_bodies_are_those_of_its_bill(example, bodies, tmp_path):
    import cadquery as cq

    folder = tmp_path / "out"
    file = tmp_path / "machine.toml"
    file.write_text(tomlkit.dumps(content(example=example)))
    done = CliRunner().invoke(make_app(), ["build", str(file), "-o", str(folder)])
    assert done.exit_code == 0, done.output
    rows = csv.DictReader(io.StringIO((folder / "bill-of-materials.csv").read_text()))
    count = sum(float(row["qty"]) for row in rows if row["kind"] in {"made", "bought"})
    solids = cq.importers.importStep(str(folder / "assembly.step")).solids().vals()
    assert len(solids) == count == bodies
    assert all((folder / f"{plate}.nc").exists() for plate in ("motor-plate", "base-plate"))


def test_a_key_of_a_length_that_nobody_sells_keeps_no_train_from_its_frame():
    found = design({"motor": "none"}, example=EIGHT, thickness=13, bushes=None)
    (key,) = [part for part in found.family.parts(found.params) if part.name == "key"]
    assert key.bought is None
    (piece,) = space_of([key], found.solve(121)).pieces
    assert piece.high - piece.low == pytest.approx(13)
    assert errors(found.check()) == []


@pytest.mark.parametrize("example", [FOUR, FIVE, EIGHT, DOUBLE])
def test_what_a_family_says_of_its_ground_plate_is_so(example):
    found = design({"frame": "none", "motor": "none"}, example=example)
    ground, parts, motion = (
        found.family.mounting(found.params),
        found.family.parts(found.params),
        found.solve(25),
    )
    assert [*ground_faults(ground, parts, motion)] == []
    moved = replace(ground, holes=ground.moved(ground.out + 1))
    assert len([*ground_faults(moved, parts, motion)]) == 4
    assert [*ground_faults(replace(ground, end=ground.end - 1), parts, motion)]
    for wrong in (0.2, -0.2):
        assert len([*ground_faults(replace(ground, hole=ground.hole + wrong), parts, motion)]) == 4
