"""Findings: each can be caused, names its parameter and limit, and its remedy helps."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

from mechwright.contracts.finding import Severity, errors
from mechwright.errors import MechwrightError
from mechwright_spherical.family import Spherical
from mechwright_spherical.kinematics.clearances import approaches, arcs_apart, point_to_arc
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.vectors import rotate, vector
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.frame import AIR, shells_of
from mechwright_spherical.rules import assembly
from mechwright_spherical.rules.assembly import weakest
from mechwright_spherical.rules.rule_table import findings_of as findings

FOUR_BAR = {"kind": "four-bar", "radius": 60}


def params(**table):
    return SphericalParams.model_validate(table)


def found(code, **table):
    return [one for one in findings(params(**table)) if one.code == code]


def four(**table):
    return {**FOUR_BAR, "four_bar": table}


CASES = [
    ("spherical.pins", {"five_bar": {"c1": [0, 0, 0]}}, "five_bar.c1"),
    ("spherical.pins", {"five_bar": {"b1": [1.25, 0.0]}}, "five_bar.b1"),
    ("spherical.pins", {"five_bar": {"b1": [-1.25, 0, -5]}}, "five_bar.b1"),
    ("spherical.pins", four(input=0.01), "four_bar.input"),
    ("spherical.pins", four(output=179.99), "four_bar.output"),
    ("spherical.pins", four(input_axis=[0, 0, 0]), "four_bar.input_axis"),
    ("spherical.pins", four(output_towards=[0, 0, 3]), "four_bar.output_towards"),
    ("spherical.assembly", {"five_bar": {"travel": 100}}, "five_bar.travel"),
    ("spherical.assembly", {"five_bar": {"start": 60}}, "five_bar.travel"),
    ("spherical.assembly", four(input=100, travel=360), "four_bar.travel"),
    ("spherical.lever", four(input=100), "four_bar.travel"),
    ("spherical.assembly", four(ground=100, input=20, coupler=30, output=20), "four_bar.travel"),
    ("spherical.assembly", four(ground=60, input=60, coupler=60, output=60, travel=360), "four_bar.travel"),
    ("spherical.assembly", {"five_bar": {"path": [[0, 2]], "path_angles": [100]}}, "five_bar.path_angles"),
    ("spherical.transmission", {"least_transmission": 85}, "five_bar.travel"),
    ("spherical.transmission", {**FOUR_BAR, "least_transmission": 60}, "four_bar.travel"),
    ("spherical.order", {"five_bar": {"path": [[0, 2]], "path_angles": [-40]}}, "five_bar.path_angles"),
    (
        "spherical.order",
        {"five_bar": {"path_n": [[0, 2], [0, 2]], "path_angles_n": [-20, -10]}},
        "five_bar.path_angles_n",
    ),
    ("spherical.order", four(path=[[0, 0, 1]], path_angles=[-10]), "four_bar.path_angles"),
    (
        "spherical.path",
        {"path_tolerance": 0.1, "five_bar": {"path": [[0.4208, 1.6891]], "path_angles": [-30]}},
        "five_bar.path",
    ),
    ("spherical.shafts", {"radius": 40}, "radius"),
    (
        "spherical.shafts",
        {"kind": "four-bar", "radius": 5, "four_bar": {"point_azimuth": 5, "point_elevation": 0}},
        "radius",
    ),
    ("spherical.boss", {"hardware": {"boss_diameter": 7}}, "hardware.boss_diameter"),
    ("spherical.gap", {"hardware": {"gap": 0.1}}, "hardware.gap"),
    ("spherical.clearance", {"hardware": {"boss_diameter": 19, "gap": 3}}, "hardware.boss_diameter"),
    (
        "spherical.clearance",
        {**four(ground=30, input=80, coupler=70, output=60), "hardware": {"frame": "one"}},
        "hardware.boss_diameter",
    ),
    ("spherical.centre", {**four(ground=20, input=60, coupler=50, output=70), "radius": 25}, "radius"),
    (
        "spherical.slot",
        {"five_bar": {"a1n": [0.766, 0.643], "c1n": [0.8, 0.8], "travel_n": -1}},
        "five_bar.c1n",
    ),
    (
        "spherical.slot",
        {**four(ground=20, input=60, coupler=50, output=70, setting_angle=50, phases=[{"crank_turn": 5}])},
        "four_bar.phases",
    ),
    ("spherical.clamp", {"hardware": {"pin_diameter": 4}}, "hardware.pin_diameter"),
    ("spherical.clamp", {"hardware": {"standoff": 3}}, "hardware.standoff"),
    (
        "spherical.setting",
        four(ground=60, input=80, coupler=30, output=40, setting_angle=180, phases=[{"crank_turn": 5}]),
        "four_bar.setting_angle",
    ),
    ("spherical.drive", {"drive": {"idler": 1, "share": 0.5}}, "drive.idler"),
    ("spherical.drive", {"drive": {"share": 0.2, "idler": 10}}, "drive.share"),
    ("spherical.stand", {"stand": {"arc": 8}}, "stand.arc"),
    (
        "spherical.stand",
        {
            **FOUR_BAR,
            "four_bar": {
                "ground": 170,
                "input": 100,
                "coupler": 80,
                "output": 120,
                "start": 100,
                "travel": 10,
            },
            "stand": {"arc": 169},
        },
        "stand.arc",
    ),
    ("spherical.stand", {"stand": {"screw": 20}}, "stand.screw"),
    ("spherical.stand", {"stand": {"height": 3}}, "stand.height"),
    ("spherical.strip", {"flat": {"bend_radius": 50, "make": True}}, "flat.bend_radius"),
]


@pytest.mark.parametrize(
    ("code", "table", "parameter"), CASES, ids=[f"{n}-{c[0]}" for n, c in enumerate(CASES)]
)
def test_finding(code, table, parameter):
    grave = [one for one in found(code, **table) if one.severity is not Severity.NOTE]
    assert grave, [str(one) for one in findings(params(**table))]
    assert parameter in {one.parameter for one in grave}
    for one in grave:
        assert one.value is not None
        assert one.limit is not None or code == "spherical.setting"
        assert one.remedy


def test_every_error_and_warning_is_caused_above():
    folder = Path(assembly.__file__).parent
    text = "".join(
        (folder / f"{name}.py").read_text(encoding="utf-8")
        for name in ("assembly", "links", "setting", "stand")
    )
    notes = {"spherical.mobility", "spherical.arcs"}
    assert set(re.findall(r'"(spherical\.[a-z-]+)"', text)) - notes == {case[0] for case in CASES}


def test_a_refused_design_has_neither_motion_nor_parts():
    refused = params(five_bar={"travel": 100})
    for ask in (Spherical().parts, lambda p: Spherical().solve(p, 50)):
        with pytest.raises(MechwrightError):
            ask(refused)


# Remedies


def test_the_radius_that_is_asked_for_is_enough():
    for radius in (10, 20, 40):
        wished = max(one.limit for one in found("spherical.shafts", radius=radius))
        assert found("spherical.shafts", radius=wished) == []
        assert found("spherical.shafts", radius=0.97 * wished)


@pytest.mark.parametrize(("arc", "link"), [("input", "crank"), ("output", "rocker")])
def test_bores_of_a_short_link_stand_side_by_side_on_the_radius_that_is_named(arc, link):
    def too_near(radius):
        said = f"the pins of the {link}"
        design = {**FOUR_BAR, "radius": radius, "four_bar": {arc: 5}}
        return [one for one in found("spherical.shafts", **design) if one.message.startswith(said)]

    (one,) = too_near(40)
    assert too_near(one.limit) == []
    (less,) = too_near(one.limit - 0.2)
    assert less.limit == one.limit
    # There discs of that width across both axes touch.
    there = float(re.search(r"at ([\d.]+) mm from the centre", less.message)[1])
    width = float(re.search(r"apart, and ([\d.]+) mm", less.message)[1])
    assert there == pytest.approx(width / 2 / math.tan(math.radians(5) / 2), abs=0.3)


def test_longer_projections_need_larger_spheres():
    """Arcs shrink as 1/d, and with them the room for shafts."""
    limits = [
        max(one.limit for one in found("spherical.shafts", radius=20, five_bar={"projection_length": d}))
        for d in (5, 10)
    ]
    # The shells start standoff outside of the sphere.
    assert (limits[1] + 5) / (limits[0] + 5) == pytest.approx(2, rel=0.1)


def test_the_travel_that_is_named_can_be_travelled():
    (apart,) = found("spherical.assembly", five_bar={"travel": 100})
    assert apart.limit == pytest.approx(32.85, abs=0.2)
    assert found("spherical.assembly", five_bar={"travel": math.floor(apart.limit)}) == []


def test_the_input_range_that_is_named_can_be_travelled():
    (apart,) = found("spherical.assembly", **four(input=100, travel=360))
    low, high = map(float, re.findall(r"([\d.]+)° to ([\d.]+)°", apart.remedy)[0])
    table = four(input=100, start=low + 1, travel=high - low - 2)
    assert [one for one in found("spherical.assembly", **table) if "dead centre" not in one.message] == []


def test_the_idler_that_is_named_reaches_both_gears():
    (short,) = found("spherical.drive", drive={"idler": 1, "share": 0.5})
    assert "does not reach" in short.message
    again = found("spherical.drive", drive={"idler": short.limit + 0.01, "share": 0.5})
    assert not any("does not reach" in one.message for one in again)


def test_the_arc_of_the_stand_that_is_named_is_enough():
    (near,) = found("spherical.stand", stand={"arc": 8})
    wished = float(re.findall(r"use ([\d.]+)°", near.remedy)[0])
    assert found("spherical.stand", stand={"arc": wished}) == []


# The figures behind them


def test_the_weakest_place_is_found_between_samples():
    (phase,) = linkage_of(params(**FOUR_BAR)).phases
    at, sine = weakest(phase)
    assert math.degrees(math.asin(sine)) == pytest.approx(50.919257438, abs=1e-8)  # 180 - 129.0807425619
    assert math.degrees(at) == pytest.approx(180, abs=1e-3)


def test_the_reference_linkage_has_the_air_that_its_arcs_leave():
    design = params(**FOUR_BAR)
    linkage, shells = linkage_of(design), shells_of(design)
    (near,) = approaches(design, linkage, shells)
    radius = shells.links["crank"][0]
    # Least separation of the reference linkage, between ends that carry bosses of 12 mm.
    widths = 2 * math.degrees(math.atan2(6, radius))
    assert near.bodies == ("crank", "rocker")
    assert math.degrees(near.room / radius) == pytest.approx(40.00055 - widths, abs=0.02)


def test_clearances_are_looked_at_in_both_phases():
    design = params()
    seen = {(near.bodies, near.phase) for near in approaches(design, linkage_of(design), shells_of(design))}
    assert seen == {
        (bodies, phase) for bodies in (("crank", "rocker"), ("shaft-a0", "arm")) for phase in (1, 2)
    }
    narrow = {"five_bar": {"travel_n": 200}}
    (hit,) = [one for one in found("spherical.clearance", **narrow) if one.severity is Severity.ERROR]
    assert "phase 2" in hit.message
    assert hit.limit == AIR


def test_distances_between_arcs_are_those_of_many_points():
    generator = np.random.default_rng(5)
    for _ in range(25):
        ends = [vector(generator.normal(size=3)) for _ in range(4)]
        links = [(a[:, None], b[:, None]) for a, b in (ends[:2], ends[2:])]
        lines = []
        for a, b in (ends[:2], ends[2:]):
            angle = math.acos(float(a @ b))
            normal = vector(np.cross(a, b))
            lines.append(rotate(normal[:, None], np.linspace(0, angle, 700), a[:, None]))
        brute = np.arccos(np.clip(lines[0].T @ lines[1], -1, 1)).min()
        assert float(arcs_apart(*links)[0]) == pytest.approx(brute, abs=6e-3)
        assert float(arcs_apart(*links)[0]) <= brute + 1e-9
        point = vector(generator.normal(size=3))
        exact = np.arccos(np.clip(lines[0].T @ point, -1, 1)).min()
        assert float(point_to_arc(point[:, None], links[0])[0]) == pytest.approx(exact, abs=4e-3)


def test_common_arcs_make_one_rocker_do():
    def names(**five_bar):
        return {part.name for part in Spherical().parts(params(five_bar=five_bar))}

    assert {"rocker-n", "flat-rocker-n"} <= names()
    assert not {"rocker-n", "flat-rocker-n"} & names(common_arcs=True)
    (note,) = found("spherical.arcs", five_bar={"common_arcs": True})
    assert note.value == pytest.approx(0, abs=1e-9)


def test_the_note_names_the_kind_of_four_bar():
    (note,) = found("spherical.mobility", **FOUR_BAR)
    assert note.message == "it is a crank-rocker"


def test_no_design_without_errors_is_short_of_notes():
    for table in ({}, FOUR_BAR):
        assert errors(findings(params(**table))) == []
        assert len(findings(params(**table))) >= 2


@pytest.mark.parametrize(
    "table",
    [
        {"five_bar": {"ratio": 0}},
        {"five_bar": {"travel": 0}},
        {"five_bar": {"travel_n": 0}},
        {"five_bar": {"a1": [1.0]}},
        {"five_bar": {"path": [[0, 0]], "path_angles": []}},
        {"five_bar": {"projection_length": -1}},
        {"kind": "four-bar", "four_bar": {"ground": 0}},
        {"kind": "four-bar", "four_bar": {"travel": 0}},
        {"kind": "four-bar", "five_bar": {"ratio": 1}},
        {"kind": "four-bar", "drive": {"gears": False}},
        {"four_bar": {"ground": 70}},
        {"path_tolerance": 1},
        {"hardware": {"material": "cheese"}},
        {"hardware": {"section": "round"}},
    ],
)
def test_tables_that_make_no_sense_are_refused(table):
    with pytest.raises(ValueError, match=r"[a-z]"):
        params(**table)


def test_a_projection_of_nothing_is_refused():
    pins = {
        name: [*at, 5.0]
        for name, at in {
            "a0": (0, 0),
            "a1": (0.12, 0.99),
            "a1n": (-0.13, 0.99),
            "b0": (1.25, 0),
            "b1": (1.957, 0.707),
            "c1": (0.891, 1.454),
            "c1n": (1.217, 1.777),
            "point": (0.18, 1.9),
        }.items()
    }
    assert params(five_bar=pins).five_bar.flat_pins is False
    with pytest.raises(ValueError, match="projection_length is for pins of two numbers"):
        params(five_bar={**pins, "projection_length": 4})
