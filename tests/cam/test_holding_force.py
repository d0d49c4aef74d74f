"""What cuts push with, and what bears it: against reference figures, and on the plates that jobs lay out."""

import json
import math
from dataclasses import replace
from pathlib import Path

import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from planning_parts import LIBRARY, bore, part, plate, rounded_box

from mechwright.contracts.materials import material
from mechwright.mechanics.strength.bolts import preload, stress_area
from mechwright_cam.planning.holding_force import (
    SAFETY,
    bed_hold,
    clamp_hold,
    heaviest,
    holding,
    holding_findings,
    screw_hold,
    strap_hold,
)
from mechwright_cam.planning.remarks import lay_out
from mechwright_cam.setup.clamping import (
    SCREW,
    SCREW_ROOM,
    STRAP_ROOM,
    rims,
    screw_places,
    straps,
    widest_channel,
)
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.cutting_force import WORN, design_force, peak_force
from mechwright_cam.shop.power import WATTS, milling_force
from mechwright_cam.shop.settings import CamSettings

CASES = json.loads((Path(__file__).parents[1] / "data" / "holding.json").read_text())["cases"]
BEARS = {
    "4 toe clamps M8, 8 kN each at the plate half of it, two faces mu 0.15": strap_hold(4, screw=8000.0),
    "4 toe clamps M8": strap_hold(4, screw=8000.0),
    "vacuum 0.08 MPa x 5000 mm2 x mu 0.25": bed_hold("vacuum", 5000.0),
    "tape 0.10 N/mm2 x 1600 mm2": bed_hold("tape", 1600.0),
    "0.5 N/mm2 x 1600 mm2": 0.5 * 1600,
    "4 M5 8.8 at 0.7 x mu 0.15 on one face": screw_hold(4),
}
"""What the holds of the reference bear here, N."""


def laid(of: object, **settings: object) -> Job:
    job, _ = lay_out(of, CamSettings.model_validate(settings), LIBRARY)  # type: ignore[arg-type]
    assert job is not None
    return job


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["name"])
def test_forces_and_holds_are_those_of_the_reference(case: dict) -> None:
    tool = case["tool"]
    cut = (material(case["material"]), tool["D"], tool["z"], tool["fz"], tool["ap"], tool["ae"])
    assert peak_force(*cut) == pytest.approx(case["peak_resultant_N"], rel=0.03)
    assert design_force(*cut) == pytest.approx(case["design_force_N"], rel=0.03)
    assert BEARS[case["hold"]] == pytest.approx(case["holding_N"], rel=1e-3)
    safety = BEARS[case["hold"]] / design_force(*cut)
    assert (safety >= SAFETY) is case["enough"] or abs(safety - SAFETY) < 0.05


@given(
    flutes=st.integers(1, 4),
    diameter=st.floats(2, 16),
    tooth=st.floats(0.01, 0.15),
    depth=st.floats(0.1, 1.5),
)
def test_the_peak_is_no_less_than_what_the_power_asks_for(
    flutes: int, diameter: float, tooth: float, depth: float
) -> None:
    """In a slot power is the mean force along the teeth times their speed: no vector sum is always smaller."""
    stuff, deep = material("aluminium"), depth * diameter
    n = 5000.0
    watts = float(milling_force(stuff, tooth, math.pi)) * diameter * deep * n * flutes * tooth / 1000 * WATTS
    mean = watts / (math.pi * diameter * n / 60 / 1000)
    peak = peak_force(stuff, diameter, flutes, tooth, deep, diameter)
    assert peak > 0.3 * mean / max(flutes / 2, 1)
    assert peak_force(stuff, diameter, flutes, tooth, deep / 2, diameter) < peak
    assert peak_force(stuff, diameter, flutes, tooth / 2, deep, diameter) < peak


def test_a_worn_edge_takes_a_third_more() -> None:
    cut = (material("steel"), 8.0, 4, 0.03, 2.0, 8.0)
    assert design_force(*cut) == pytest.approx(WORN * peak_force(*cut))


def test_the_stock_has_a_rim_for_clamps_on_its_longer_sides() -> None:
    job = laid(part(rounded_box(100, 60, 5)))
    room = rims(job)
    assert room["front"] == pytest.approx(room["rear"])
    assert room["front"] >= STRAP_ROOM
    assert room["left"] == pytest.approx(room["right"])
    assert 5 <= room["left"] < STRAP_ROOM
    assert {strap.edge for strap in straps(job)} == {"front", "rear"}
    x0, _, x1, _ = job.stock
    assert all(x0 < strap.at < x1 for strap in straps(job))
    turned = laid(part(rounded_box(60, 100, 5)))
    assert {strap.edge for strap in straps(turned)} == {"left", "right"}


def test_a_hold_bears_twice_the_heaviest_cut_or_is_named() -> None:
    job = laid(part(rounded_box(100, 60, 5)))
    found = holding(job)
    assert found.push is not None
    assert found.way is not None
    assert found.push.force == max(
        heaviest(replace(job, tools=(tool,))).force
        for tool in job.mills  # type: ignore[union-attr]
    )
    assert found.safety >= SAFETY
    assert found.tab_safety >= SAFETY
    assert not list(holding_findings(job))


def test_a_plate_that_is_too_small_names_the_stock_that_works() -> None:
    of = part(rounded_box(100, 60, 0.1))
    job = laid(of, stock={"margin": 14})
    (finding,) = holding_findings(job)
    assert (finding.code, finding.parameter) == ("cam.hold-room", "cam.stock.margin")
    assert "no rim for clamps" in finding.message
    assert finding.limit == pytest.approx(SAFETY * holding(job).push.force)  # type: ignore[union-attr]
    (change,) = finding.proposed
    again = laid(of, stock={"margin": change["cam.stock.margin"]})
    assert not list(holding_findings(again))
    assert straps(again)
    less = laid(of, stock={"margin": change["cam.stock.margin"] - 1})
    assert not straps(less)
    sized = laid(of, stock={"length": 128, "width": 88})
    (finding,) = holding_findings(sized)
    assert finding.parameter == "cam.stock.width"
    width = int(finding.remedy.split("width = ")[1].split(":")[0])
    assert straps(laid(of, stock={"length": 128, "width": width}))


def test_screws_go_through_the_waste_where_the_rim_is_too_narrow() -> None:
    """Beside a round part the corners of a plate are waste."""
    of = part(rounded_box(100, 100, 49.9))
    job = laid(of, stock={"margin": 18})
    assert not straps(job)
    places = screw_places(job)
    assert len(places) == 4
    way = holding(job).way
    assert way is not None
    assert way.screws == places
    assert not list(holding_findings(job))
    cut = job.target.buffer(widest_channel(job))
    edge = shapely.box(*job.stock).exterior
    for place in map(shapely.Point, places):
        assert shapely.distance(place, cut) >= SCREW_ROOM * SCREW - 0.11
        assert shapely.distance(place, edge) >= SCREW_ROOM * SCREW - 0.11


def test_tape_under_a_small_part_is_too_little_for_a_deep_slot() -> None:
    of = plate(bore(8))
    (finding,) = holding_findings(laid(of, tools=["mill-6"], hold={"method": "none", "bed": "tape"}))
    assert finding.code == "cam.hold-force"
    area = float(laid(of).target.area)
    assert finding.value == pytest.approx(0.1 * area)


def test_a_vice_bears_more_than_any_cut_of_a_light_mill() -> None:
    job = laid(
        part(rounded_box(60, 40, 0.01)),
        hold={"method": "vice"},
        stock={"finished": ["front", "rear"]},
        coolant="off",
    )
    way = holding(job).way
    assert way is not None
    assert way.holds == pytest.approx(3000.0)


def test_a_clamp_through_the_bore_bears_less_far_from_it() -> None:
    near, far = (
        laid(part(rounded_box(size, size, 5), bore(12)), hold={"method": "bore", "clamp_diameter": 20})
        for size in (50, 100)
    )
    (screw, more), (_, less) = clamp_hold(near), clamp_hold(far)  # type: ignore[misc]
    assert screw == "M10"
    assert more > 1.8 * less
    arm = 2 / 3 * (10 + 10 + near.thickness)
    reach = float(shapely.hausdorff_distance(shapely.Point(0, 0), near.target.exterior))
    friction = 0.15 * 0.7
    assert more == pytest.approx(friction * preload(stress_area(10, 1.5)) * arm / reach)


def test_coolant_takes_a_third_of_the_friction() -> None:
    of = part(rounded_box(100, 60, 5))
    wet, dry = laid(of), laid(of, coolant="off")
    assert holding(wet).way.holds == pytest.approx(0.7 * holding(dry).way.holds)  # type: ignore[union-attr]
