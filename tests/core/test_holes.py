"""Holes that are threaded, or made to a fit."""

import cmath
import math
from typing import get_args

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.contracts.details import Engraving, Thread, moved
from mechwright.contracts.fits import HoleClass, hole_fit
from mechwright.contracts.holes import CLEARANCE, fitted, hole, joined, threaded
from mechwright.contracts.moments import volume
from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.contracts.threads import COARSE, UNIFIED, named
from mechwright.errors import GeometryError
from mechwright.geometry import Loop, Outline, circle

SQUARE = Loop.polygon([(0, 0), (80, 0), (80, 60), (0, 60)])


def plate(diameter=6.0, thickness=8.0, at=(30.0, 30.0), machined=()):
    inner = Loop((circle(at, diameter / 2, clockwise=True, tag="hole"),))
    return Part("base", Outline(SQUARE, (inner,)), thickness, "steel", machined=machined)


@pytest.mark.parametrize(("text", "found"), [("M6", (6, 1)), (" M8x1 ", (8, 1)), ("M2.5", (2.5, 0.45))])
def test_designations(text, found):
    assert (named(text).diameter, named(text).pitch) == found


def test_unified_and_left_hand_threads():
    quarter = named("1/4-20 UNC LH")
    assert (quarter.diameter, quarter.left, quarter.inch) == (6.35, True, "1/4-20 UNC")
    assert quarter.pitch == pytest.approx(1.27)
    assert named("#10 - 32").inch == "#10-32 UNF"
    assert named("M6 LH").left
    assert not named("M6").left
    # Sizes, and minor diameters D1 as ASME B1.1 has them, in inches.
    assert [
        round(named(f"{size}-{UNIFIED['UNC'][size]}").diameter / 25.4, 4) for size in ("#4", "#10", "3/8")
    ] == [
        0.112,
        0.19,
        0.375,
    ]
    drawn = threaded(plate(5.1, 8.0, (40.0, 30.0)), "bore-1", "1/4-20")
    (thread,) = drawn.details
    assert thread.designation == "1/4-20 UNC"
    assert thread.core / 25.4 == pytest.approx(0.1959, abs=1e-4)
    with pytest.raises(GeometryError, match=r"1/4-20 UNC is no thread for .* there is .*3/8-16 UNC"):
        threaded(plate(8.5, 8.0, (40.0, 30.0)), "bore-1", "1/4-20")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("1/4-21", "no thread of ASME B1.1; there is 1/4-20 UNC and 1/4-28 UNF"),
        ("1/4-20 UNF", "there is 1/4-20 UNC and 1/4-28 UNF"),
        ("#3-48", "no such size"),
        ("6", "no metric thread, and no unified one; write M6"),
        ("M9", "no coarse pitch in ISO 261"),
        ("M6x4", "the pitch is 4"),
    ],
)
def test_designations_that_are_none(text, said):
    with pytest.raises(GeometryError, match=said):
        named(text)


@settings(deadline=None, max_examples=30)
@given(st.floats(1.6, 20))
def test_the_threads_that_are_named_for_a_hole_are_all_that_go_into_it(diameter):
    def fits(text):
        try:
            threaded(plate(diameter, 20.0, (40.0, 30.0)), "bore-1", text)
        except GeometryError as error:
            return error
        return None

    error = fits("M36")
    said = str(error).partition("for that there is ")[2]
    sizes = [f"M{size:g}" for size in COARSE if size < 36]
    assert [size for size in sizes if fits(size) is None] == ([] if said == "none" else said.split(", "))


@settings(deadline=None)
@given(
    nominal=st.sampled_from([d for d in COARSE if d <= 36]), share=st.floats(0, 1), thickness=st.floats(1, 30)
)
def test_every_coarse_thread_goes_into_holes_from_its_core_to_its_clearance(nominal, share, thickness):
    low = nominal - 1.0825 * COARSE[nominal]
    drawn = low + share * (CLEARANCE * nominal - low)
    part = threaded(plate(drawn, thickness, (40.0, 30.0)), "bore-1", f"M{nominal:g}")
    (thread,) = part.details
    assert isinstance(thread, Thread)
    assert (thread.diameter, thread.pitch, thread.depth) == (nominal, COARSE[nominal], thickness)
    # Outline, feature and detail are the same hole, of the thread's core.
    assert hole(part, "bore-1").diameter == pytest.approx(thread.core, abs=1e-6)
    taken = math.pi / 4 * thread.core**2 * thickness
    assert volume(part) == pytest.approx(80 * 60 * thickness - taken, rel=1e-6)


@given(size=st.integers(1, 40), name=st.sampled_from(get_args(HoleClass)))
def test_a_fit_makes_the_middle_of_its_tolerance(size, name):
    part = fitted(plate(float(size)), "bore-1", name)
    fit = hole_fit(size, name)
    bore = hole(part, "bore-1")
    assert (bore.fit, bore.diameter) == (fit, fit.middle)
    (inner,) = part.outline.inner
    assert inner.segments[0].radius * 2 == pytest.approx(fit.middle)
    # The next fit is one of the same size, and where something is pressed in, it has room.
    assert fitted(part, "bore-1", "H7") == fitted(plate(float(size)), "bore-1", "H7")
    assert hole(joined(part), "bore-1").diameter == max(fit.middle, size)


def test_what_is_screwed_in_has_room_and_other_parts_stay_the_same_object():
    part = plate()
    assert joined(part) is part
    assert hole(joined(threaded(part, "bore-1", "M6")), "bore-1").diameter == 6.0


def test_a_blind_hole_is_threaded_down_to_a_pitch_above_its_floor():
    machined = (Bore("blind", (30.0, 30.0), 6.0, 0, 5), Profile("outside", SQUARE, "outside", 0, 8))
    part = Part("base", Outline(SQUARE), 8.0, "steel", machined=machined)
    made = threaded(part, "blind", "M6")
    assert made.details[0].depth == 4.0
    assert made.outline == part.outline
    with pytest.raises(GeometryError, match="blind of part base is 5 mm deep; no thread of 6 mm"):
        threaded(part, "blind", "M6", 6.0)


@pytest.mark.parametrize(
    ("part", "name", "thread", "said"),
    [
        (plate(), "bore-2", "M6", r"no round hole 'bore-2'; it has: bore-1 \(6 mm\)"),
        (
            plate(),
            "bore-1",
            "M12",
            "no thread for bore-1 of part base, a hole of 6 mm; for that there is M5, M6",
        ),
        (plate(20.0), "bore-1", "M6", "no thread for bore-1 of part base, a hole of 20 mm"),
        (plate(6.0, at=(3.5, 30.0)), "bore-1", "M6", "leaves a wall of 0.50 mm; it needs one pitch, 1 mm"),
        (threaded(plate(), "bore-1", "M6"), "bore-1", "M6", "has a thread already"),
    ],
)
def test_threads_that_cannot_be(part, name, thread, said):
    with pytest.raises(GeometryError, match=said):
        threaded(part, name, thread)


def test_a_hole_below_the_top_face_has_no_thread_and_a_recess_beside_one_is_a_wall():
    outside = Profile("outside", SQUARE, "outside", 0, 8)
    low = (Bore("low", (30.0, 30.0), 6.0, 3, 5), outside)
    with pytest.raises(GeometryError, match="starts 3 mm below the top face; threads start at it"):
        threaded(plate(machined=low), "low", "M6")
    slot = Pocket("slot", Loop.polygon([(33.5, 20), (40, 20), (40, 40), (33.5, 40)]), (), 0, 2)
    with pytest.raises(GeometryError, match=r"leaves a wall of 0\.50 mm"):
        threaded(plate(machined=(Bore("bore-1", (30.0, 30.0), 6.0, 0, 8), slot, outside)), "bore-1", "M6")


def test_a_fit_beyond_the_tables_is_refused():
    big = Part(
        "base",
        Outline(
            Loop((circle((0, 0), 300),)),
        ),
        8.0,
        "steel",
        machined=(Bore("bore", (0.0, 0.0), 402.0, 0, 4), Profile("outside", SQUARE, "outside", 0, 8)),
    )
    with pytest.raises(GeometryError, match="the table goes up to 400 mm"):
        fitted(big, "bore", "H7")


def test_a_thread_and_an_engraving_are_turned_about_the_origin_before_they_are_shifted():
    def at(x: float, y: float) -> tuple[float, float]:
        place = complex(x, y) * cmath.exp(0.7j) + complex(5.0, -2.0)
        return place.real, place.imag

    thread = moved(Thread("m5", (3.0, 8.0), 5.0, 0.8, 6.0), 5.0, -2.0, 0.7)
    assert isinstance(thread, Thread)
    assert thread.centre == pytest.approx(at(3.0, 8.0))
    engraved = moved(Engraving("a", (((1.0, 2.0), (4.0, 7.0)),), 0.2), 5.0, -2.0, 0.7)
    assert isinstance(engraved, Engraving)
    assert engraved.strokes[0] == (pytest.approx(at(1.0, 2.0)), pytest.approx(at(4.0, 7.0)))
