"""Loads of what takes nothing, and ways round of what goes down along walls."""

import math
from dataclasses import fields, replace

import numpy as np
import pytest
from by_control import asked, prove, scene_of
from planning_parts import job, plate
from shop import plate_job
from test_proof_parts import paths_of

from mechwright_cam.proof.cutting_rules import BEYOND
from mechwright_cam.proof.edge_rules import too_steep
from mechwright_cam.proof.loads import Loads, Taken
from mechwright_cam.shop.tool import Tool

HEAD = "G17 G21 G40 G49 G80 G90\nG53 G0 Z0\nT3 M6\nG54 S8000 M3\nG0 X0 Y0\nG43 H3 Z5\n"
TAIL = "\nG0 Z5\nM5 M9\nG53 G0 Z0\nM30\n"


def test_a_program_that_takes_nothing_has_loads_of_the_same_kinds() -> None:
    nothing, something = (
        scene_of(f"{HEAD}G1 Z{z} F100\nG1 X10 F300{TAIL}", plate_job()).simulation.loads for z in (1, -1)
    )
    assert (nothing.step.size, bool(something.step.size)) == (0, True)
    for name in [field.name for field in fields(Loads)[1:]]:
        assert getattr(nothing, name).dtype == getattr(something, name).dtype, name


@pytest.mark.parametrize("climb", [True, False])
def test_a_program_that_takes_nothing_is_judged(climb: bool) -> None:
    proof = prove(f"{HEAD}G1 Z1 F100\nG1 X10 F300{TAIL}", plate_job(climb=climb))
    assert proof.checks["climb"].passed
    assert "leftover" in {check.name for check in proof.failures}


WALLS = (-33.0, 33.0)
"""X of the mill's axis where it finishes the left and the right side of the plate."""


def finished(left: str, right: str) -> str:
    """Both sides of the plate roughed 0.2 mm away from them, then finished so."""
    rough = "".join(f"G0 X{x + 0.2 * x / abs(x):.1f} Y-30\nG1 Z-5 F100\nG1 Y30 F300\nG0 Z5\n" for x in WALLS)
    return f"{HEAD}{rough}{left}{right}{TAIL}"


def down(x: float, legs: str, depth: float) -> str:
    """Down a side in legs of 24 mm along it, each to + or - Y; lifted and taken back where one follows its like."""
    text, z = f"G0 X{x} Y{-12 if legs[0] == '+' else 12}\nG1 Z0 F100\n", 0.0
    for before, leg in zip(" " + legs, legs, strict=False):
        end = 12 if leg == "+" else -12
        if before == leg:
            text += f"G0 Z5\nG0 Y{-end}\nG1 Z{z:.3f} F100\n"
        z -= depth / len(legs)
        text += f"G1 Y{end} Z{z:.3f} F300\n"
    return text + "G0 Z5\n"


@pytest.mark.parametrize(
    ("left", "right", "passed"),
    [
        # On the left of the plate +Y is climb milling, on its right -Y is.
        (("++++", 3), ("----", 4), True),
        (("----", 4), ("----", 3), False),
        (("++++", 3), ("++++", 4), False),  # one side each way round: neither excuses the other
        (("+-+-", 3), ("+-+-", 4), True),
        (("++++", 3), ("+-+-", 4), True),
        (("+-+-", 3), ("++++", 4), False),
    ],
)
def test_a_way_down_to_and_fro_excuses_itself_alone(
    left: tuple[str, float], right: tuple[str, float], passed: bool
) -> None:
    text = finished(down(WALLS[0], *left), down(WALLS[1], *right))
    found = asked("climb", text, plate_job(climb=True))
    assert found.passed == passed, found.message


def test_the_lowest_and_the_highest_place_of_short_moves_are_places() -> None:
    """Moves of 0.14 mm down and up, of which the places are otherwise 0.5 mm apart."""
    paths = paths_of(
        "G1 Z-1 F100\nX0.1 Z-1.1\nX0.2 Z-1.2\nX0.3 Z-1.1\nX0.4 Z-1.05\nX0.5 Z-1.1\nX0.6 Z-1.15\nX0.7"
    )
    taken = Taken.along(paths, paths.cuts, 1.0)
    assert {-1.2, -1.05, -1.15} <= set(taken.z.round(6).tolist())
    assert taken.z.size < 2 * paths.cuts.size + 6
    assert taken.length.sum() == pytest.approx(paths.length[paths.cuts].sum())


def test_places_along_two_chains_of_moves_have_their_ways_lengths_and_times() -> None:
    down = "G1 Z-2 F100\n"
    paths = paths_of(
        f"G0 X0 Y0 Z0\n{down}X6 F200\nG0 Z5\nG0 X0 Y5\nG0 Z0\n{down}Y8 F400\nG2 X3 Y11 I3 J0 F300"
    )
    taken = Taken.along(paths, paths.cuts, 1.0)
    chord = 6 * math.sin(math.pi / 20)  # a quarter of a circle of 3 mm in five
    length = [0, 1, 1, 0, *[1] * 6, 0, 1, 1, 0, 1, 1, 1, 0, *[chord] * 5]
    feed = np.repeat([100, 200, 100, 400, 300], [3, 7, 3, 4, 6])
    assert taken.chain.tolist() == [0] * 10 + [1] * 13
    np.testing.assert_array_equal(taken.step, np.repeat(paths.cuts, [3, 7, 3, 4, 6]))
    np.testing.assert_allclose(taken.length, length, atol=1e-12)
    np.testing.assert_allclose(taken.seconds, length / feed * 60, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(taken.way, axis=1), length, atol=1e-12)
    places = np.column_stack((taken.places, taken.z))
    for first, behind in ((0, 10), (10, 23)):
        np.testing.assert_allclose(
            places[first] + taken.way[first:behind].cumsum(axis=0), places[first:behind]
        )
    assert not (taken.volume.any())
    assert not (taken.depth.any())
    assert not (taken.moment.any())
    assert not (taken.cuts.size)
    some = replace(taken, volume=np.arange(23.0))
    assert some.cuts.tolist() == [place for place in range(23) if length[place]]
    assert some.of_steps(paths.cuts).tolist() == [3, 42, 33, 58, 117]


def test_a_way_straight_down_may_be_as_fast_as_its_limit_and_a_millimetre_a_minute_faster() -> None:
    of = job(plate(), "mill-6")
    head = HEAD.replace("T3", f"T{of.tools[0].number}").replace("H3", f"H{of.tools[0].number}")

    def found(feed: float) -> tuple[tuple[int, Tool, float, float], ...]:
        return too_steep(scene_of(f"{head}G1 Z-3 F{feed:.4f}\nG1 X10 F300{TAIL}", of))

    ((_, tool, speed, limit),) = found(3000.0)
    assert speed == 3000
    data = tool.cutting["aluminium"]
    assert limit == pytest.approx(BEYOND * data.plunge * data.chip_load * 8000 * tool.flutes)
    for more, bad in ((-0.5, False), (0.5, False), (1.5, True)):
        assert bool(found(limit + more)) == bad, more
