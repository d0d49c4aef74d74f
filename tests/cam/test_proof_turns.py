"""Turns of a milled thread: there to the last one, on the helix or off it by a distance in closed form."""

import math

import pytest
from test_proof_parts import paths_of

from mechwright.contracts.details import Thread
from mechwright_cam.proof.paths import Paths
from mechwright_cam.proof.thread_turns import FITS, off_helix, turns, unthreaded
from mechwright_cam.shop.tool import Tool, ToolKind

PITCH = 1.5
THREAD = Thread("m12", (4.0, -3.0), 12.0, PITCH, 6.0)
LEFT = Thread("m12", (4.0, -3.0), 12.0, PITCH, 6.0, left=True)
MILL = Tool(name="thread-6", number=3, kind=ToolKind.THREAD_MILL, diameter=6, flutes=3, flute_length=12)
ORBIT = 3.0
"""Radius of the mill's way, mm."""


def helix(
    low: float, count: int, *, rise: float = PITCH, orbit: float = ORBIT, x: float = 4.0, word: str = "G3"
) -> str:
    """So many turns upwards from a height; in and out along X, where the helix begins and ends."""
    turns = [f"{word} I{-orbit:.4f} Z{low + rise * (k + 1):.4f}" for k in range(count)]
    out = f"G1 X{x + orbit:.4f}"
    return "\n".join(["G0 Z5", f"G0 X{x} Y-3", f"G1 Z{low:.4f} F100", out, *turns, f"G1 X{x}"])


def paths(*lines: str) -> Paths:
    return paths_of("\n".join(lines), MILL)


def test_a_thread_of_all_its_turns_lacks_nothing() -> None:
    assert unthreaded(paths(helix(-6.0, 4)), THREAD) == ""
    assert unthreaded(paths(helix(-7.5, 5)), THREAD) == ""
    assert unthreaded(paths(helix(-6.0, 2), helix(-3.0, 2)), THREAD) == ""


@pytest.mark.parametrize(
    ("lines", "low", "high"),
    [
        ((helix(-4.5, 4),), "-4.500", "1.500"),  # as many turns, too high
        ((helix(-7.5, 4),), "-7.500", "-1.500"),  # as many turns, too low
        ((helix(-6.0, 1), helix(-1.5, 1)), "-6.000", "0.000"),  # both ends, and nothing between
        ((helix(-6.0, 1), helix(-1.5, 1), helix(-1.5, 1)), "-6.000", "0.000"),
        ((helix(-5.97, 4),), "-5.970", "0.030"),
    ],
)
def test_each_lack_alone_is_told(lines: tuple[str, ...], low: str, high: str) -> None:
    assert unthreaded(paths(*lines), THREAD) == (
        f"the thread runs from Z{low} to Z{high}, not from Z-6 to the top"
    )


def test_the_last_hundredths_of_a_thread_may_miss() -> None:
    assert unthreaded(paths(helix(-5.99, 4)), THREAD) == ""


def test_a_helix_is_one_of_the_thread_if_place_radius_pitch_and_hand_are() -> None:
    none = "no right-hand helix of 12 mm with a pitch of 1.5 mm around its axis"
    near, far = 0.9 * FITS, 1.1 * FITS
    for sign in (1, -1):
        for of in ({"x": 4 + sign * near}, {"orbit": ORBIT + sign * near}, {"rise": PITCH + sign * near}):
            assert turns(paths(helix(-7.5, 6, **of)), THREAD).size == 6, of
        for of in ({"x": 4 + sign * far}, {"orbit": ORBIT + sign * far}, {"rise": PITCH + sign * far}):
            assert unthreaded(paths(helix(-7.5, 6, **of)), THREAD) == none, of
    down = {"low": 0.0, "rise": -PITCH, "word": "G2"}
    assert unthreaded(paths(helix(count=4, **down)), THREAD) == ""
    assert unthreaded(paths(helix(-6.0, 4, word="G2")), THREAD) == none
    assert unthreaded(paths(helix(-6.0, 4, word="G2")), LEFT) == ""
    assert unthreaded(paths(helix(-6.0, 4)), LEFT) == none.replace("right", "left")
    assert unthreaded(paths(helix(count=4, low=0.0, rise=-PITCH)), LEFT) == ""


@pytest.mark.parametrize("shift", [0.0, 0.1, -0.1, 0.3, PITCH, 3 * PITCH - 0.2])
def test_off_the_helix_the_tooth_cuts_by_root_three_of_the_height(shift: float) -> None:
    """A turn more that is shifted along the axis, and one that goes less far out."""
    shifted = paths(helix(-6.0, 4), helix(-6.0 + shift, 1))
    beside = abs(shift - PITCH * round(shift / PITCH))
    found = off_helix(shifted, THREAD)
    assert found is not None
    assert found[1] == pytest.approx(math.sqrt(3.0) * beside, abs=1e-3)
    if beside:
        assert found[0] in shifted.steps[-3:]
        inner = off_helix(paths(helix(-6.0, 4), helix(-6.0 + shift, 1, orbit=ORBIT - 0.15)), THREAD)
        assert inner is not None
        assert inner[1] == pytest.approx(max(math.sqrt(3.0) * beside - 0.15, 0.0), abs=1e-3)


def test_no_tooth_cuts_deeper_than_the_core() -> None:
    found = off_helix(paths(helix(-6.0, 4), helix(-6.0 + PITCH / 2, 1)), THREAD)
    assert found is not None
    assert found[1] == pytest.approx((THREAD.diameter - THREAD.core) / 2, abs=1e-3)
    assert found[2][2] < 0
    assert math.hypot(found[2][0] - 4, found[2][1] + 3) == pytest.approx(ORBIT)


def from_an_angle(low: float, count: int, degrees: float, x: float = 4.0, y: float = -3.0) -> str:
    """So many turns upwards, which begin and end in a direction, and not on a whole number of pitches."""
    i, j = ORBIT * math.cos(math.radians(degrees)), ORBIT * math.sin(math.radians(degrees))
    turns = [f"G3 I{-i:.4f} J{-j:.4f} Z{low + PITCH * (k + 1):.4f}" for k in range(count)]
    out = f"G1 X{x + i:.4f} Y{y + j:.4f}"
    return "\n".join(["G0 Z5", f"G0 X{x} Y{y}", f"G1 Z{low:.4f} F100", out, *turns, f"G1 X{x} Y{y}"])


@pytest.mark.parametrize("degrees", [40.0, 130.0, -75.0])
def test_where_a_helix_begins_changes_nothing(degrees: float) -> None:
    def deep(*more: str) -> float:
        found = off_helix(paths(from_an_angle(-6.4, 5, degrees), *more), THREAD)
        assert found is not None
        return found[1]

    assert deep() == pytest.approx(0.0, abs=2e-3)
    assert deep(from_an_angle(-6.2, 2, degrees)) == pytest.approx(math.sqrt(3.0) * 0.2, abs=2e-3)
    # Turned by a tenth of a turn it stands off by a tenth of the pitch.
    assert deep(from_an_angle(-6.4, 2, degrees + 36.0)) == pytest.approx(math.sqrt(3.0) * 0.15, abs=2e-3)
    # What is above the plate, or in another hole, is none of it.
    assert deep(from_an_angle(0.2, 1, degrees), from_an_angle(-5.0, 2, 0.0, x=20.0)) == pytest.approx(
        0.0, abs=2e-3
    )
