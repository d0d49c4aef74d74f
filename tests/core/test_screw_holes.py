"""Holes for screws by their names: sizes against hand values, what becomes of the part, and what is refused."""

import math

import pytest

from mechwright.contracts.details import Chamfer
from mechwright.contracts.part import Bore, Part
from mechwright.errors import DesignError, GeometryError
from mechwright.geometry import Loop, Outline, circle
from mechwright.standards.screw_holes import seat, seated

SQUARE = Loop.polygon([(-15, -15), (15, -15), (15, 15), (-15, 15)])


def plate(
    diameter: float = 5.0, thickness: float = 8.0, at: tuple[float, float] = (0.0, 0.0), deep: float = 8.0
) -> Part:
    inner = (Loop((circle(at, diameter / 2, clockwise=True),)),) if deep == thickness else ()
    bores = (Bore("bore-1", at, diameter, 0.0, deep),)
    return Part("plate", Outline(SQUARE, inner), thickness, "steel", machined=bores)


@pytest.mark.parametrize(
    ("name", "clearance", "head", "depth"),
    [
        ("ISO 4762 M3", 3.4, 6.5, 3.4),
        ("M6", 6.6, 11.0, 6.4),
        ("iso 4762  m12", 13.5, 20.0, 12.6),
        ("ISO 10642 M3", 3.4, 6.92, 1.76),
        ("ISO 10642 M8", 9.0, 18.12, 4.56),
        ("1/4", 0.281 * 25.4, 0.416 * 25.4, 0.275 * 25.4),
        ("ASME B18.3 #10", 0.221 * 25.4, 0.348 * 25.4, 0.215 * 25.4),
    ],
)
def test_sizes_are_those_of_the_tables(name: str, clearance: float, head: float, depth: float) -> None:
    found = seat(name)
    assert (found.clearance, found.head, found.depth) == pytest.approx((clearance, head, depth), abs=1e-4)


def test_a_counterbore_and_the_hole_below_it() -> None:
    made = seated(plate(), "bore-1", "ISO 4762 M5")
    head, shank = made.features
    assert (head.name, head.diameter, head.top, head.depth) == ("head-bore-1", 10, 0.0, 5.4)
    assert (shank.diameter, shank.top) == (5.5, 5.4)
    assert shank.top + shank.depth == pytest.approx(8.0)
    assert made.outline is not None
    assert made.outline.area == pytest.approx(900 - math.pi * 2.75**2, abs=1e-6)


def test_a_countersink_is_as_wide_as_the_head() -> None:
    made = seated(plate(3.0), "bore-1", "ISO 10642 M3")
    (sink,) = made.details
    assert isinstance(sink, Chamfer)
    (arc,) = sink.loop.segments
    assert 2 * (arc.radius + sink.width) == pytest.approx(6.92)
    assert [feature.diameter for feature in made.features] == [3.4]


@pytest.mark.parametrize(
    ("part", "name", "reason"),
    [
        (plate(deep=5.0), "M5", "does not go through from the top face"),
        (
            plate(3.0),
            "M5",
            "is drawn with 3 mm; the hole of ISO 4762 M5 is drawn from 3.75 mm to its head, 10 mm",
        ),
        (plate(10.1), "M5", "to its head, 10 mm"),
        (plate(thickness=6.6, deep=6.6), "M5", "in a plate of 6.6 mm; it needs 6.65 mm"),
        (plate(3, thickness=1.7, deep=1.7), "ISO 10642 M3", "it needs 1.76 mm"),
        (plate(at=(9.1, 0.0)), "M5", "leaves a wall of 0.90 mm; it needs 1 mm"),
    ],
)
def test_what_a_plate_cannot_have_is_refused(part: Part, name: str, reason: str) -> None:
    with pytest.raises(GeometryError, match=reason):
        seated(part, "bore-1", name)


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("M7", "no screws M7; one of"),
        ("ISO 10642 M12", "no countersunk screws M12; one of: M3, M4, M5, M6, M8"),
        ("1/3", r"no socket head cap screws 1/3 .*; one of: #4, #6"),
        ("ASME B18.3 M6", "has no thread M6"),
        ("ISO 4762 1/4", "has no thread 1/4"),
        ("ASME B18.3.5 1/4", "heads of 82 degrees"),
        ("wood screw", "no screw with a seat that is known"),
    ],
)
def test_a_name_that_is_none_is_refused(name: str, reason: str) -> None:
    with pytest.raises(DesignError, match=reason):
        seat(name)
