"""Rapids whose axes arrive one after the other, and rapids from places that the text does not say."""

from dataclasses import replace

import pytest
import shapely
from by_control import BY_NAME
from shop import plate_job

from mechwright_cam.proof import Check, Scene
from mechwright_cam.proof.entry_rules import rapid_height, rapids_in_stock
from mechwright_cam.proof.machine_moves import positions
from mechwright_cam.proof.plane import SNAP, overlay
from mechwright_cam.proof.tool_collisions import clamp
from mechwright_cam.setup.holding import Clamp
from mechwright_cam.setup.job import Job

HEAD = "G17 G21 G40 G49 G80 G90\nG53 G0 Z0\nT3 M6\nG54 S8000 M3\n"


def scene(moves: str, of: Job) -> Scene:
    return Scene(f"{HEAD}{moves}\nM30\n", of, BY_NAME["linuxcnc"])


def clamped() -> Job:
    """A plate under a clamp of 20 mm at X0 Y0, 15 mm high; the mill has a radius of 3 mm."""
    return replace(plate_job(), tabs=(), clamp=Clamp((0.0, 0.0), 20.0, 15.0))


def judged_clamp(moves: str) -> Check:
    return clamp(scene(moves, clamped()))


def test_a_rapid_past_a_clamp_may_go_along_the_edges_of_its_rectangle() -> None:
    up = "G0 X-30 Y-5\nG43 H3 Z10\n"
    # The line from there to X5 Y30 passes 17.7 mm from the middle of the clamp: 13 are needed.
    assert "the cutter goes 13.00 mm into the clamp" in judged_clamp(up + "X5 Y30").message
    assert judged_clamp(up + "G1 X5 Y30 F500").passed
    assert judged_clamp(up + "X-30 Y30\nX5").passed
    assert judged_clamp("G0 X-30 Y-5\nG43 H3 Z16\nX5 Y30").passed


def test_a_rapid_may_have_come_down_before_it_crosses() -> None:
    """On the straight line from the upper end the tool is half a metre over the clamp."""
    found = judged_clamp("G0 X-30 Y0\nG43 H3\nG0 X30 Y0 Z10")
    assert not found.passed
    assert found.line == 7
    assert judged_clamp("G0 X-30 Y0\nG43 H3\nG0 X30 Y0\nZ10").passed
    assert not judged_clamp("G0 X-30 Y0\nG43 H3 Z10\nG0 X30 Y0 Z50").passed  # nor may it have gone up


@pytest.mark.parametrize(("words", "passed"), [("X55 Y0", False), ("G1 X55 Y0 F500", True)])
def test_beside_the_stock_a_low_rapid_stays_clear_of_its_corners(words: str, passed: bool) -> None:
    of = plate_job()
    x1, y1 = of.stock[2:]
    low = f"G0 X{x1 - 10} Y{y1 + 30}\nG43 H3 Z5\nZ-2\n{words.replace('X55 Y0', f'X{x1 + 30} Y{y1 - 10}')}"
    assert rapid_height(scene(low, of)).passed == passed


@pytest.mark.parametrize(("count", "said"), [(1, "1 in all"), (19, "19 in all"), (300, "20 or more")])
def test_more_than_twenty_rapids_in_the_stock_are_not_counted(count: int, said: str) -> None:
    over = "G0 X0 Y0\nG43 H3 Z5\nG1 Z-2 F100\n"
    along = "\n".join(f"G0 X{7 + k / 10:.1f}" for k in range(1, count + 1))
    found = rapids_in_stock(scene(over + along, plate_job()))
    assert found.message.startswith(f"line 8: a rapid into the stock ({said}); feed there, at X7.")


CORNER = 3 / 2**0.5
"""Of the mill's radius that much lies along X, and along Y, where it goes past a corner."""


@pytest.mark.parametrize(
    ("x", "y", "passed"),
    [
        # The plate reaches to X39 and Y29, and may reach 0.2 mm further; the mill has a radius of 3 mm.
        *((42.15, 0.0, False), (42.25, 0.0, True), (-42.15, 0.0, False), (-42.25, 0.0, True)),
        *((0.0, 32.15, False), (0.0, 32.25, True), (0.0, -32.15, False), (0.0, -32.25, True)),
        (39.15 + CORNER, 29.15 + CORNER, False),
        (39.25 + CORNER, 29.25 + CORNER, True),
    ],
)
def test_a_rapid_goes_down_beside_the_stock_two_tenths_away(x: float, y: float, passed: bool) -> None:
    of = plate_job()
    assert of.stock == (-39.0, -29.0, 39.0, 29.0)
    over = f"G0 X{x:.4f} Y{y:.4f}\nG43 H3 Z5\n"
    found = rapids_in_stock(scene(over + "Z-2", of))
    assert found.passed == passed
    if not passed:
        assert found.line == 7
        assert (
            "a rapid goes down less than 0.2 mm beside the stock; feed there, or keep off more"
            in found.message
        )
    assert rapids_in_stock(scene(over + "G1 Z-2 F100", of)).passed
    assert rapids_in_stock(scene(over + "Z0", of)).passed  # no deeper than the top
    # Up again it may go anywhere, and down where the mill has been fed before, by itself or in passing.
    assert rapids_in_stock(scene(over + "G1 Z-2 F100\nG0 Z5\nZ-2", of)).passed
    past = "" if abs(x) > abs(y) + 10 else " X-60"
    along = f"G1 Z-2 F100\nG1{past or ' Y-60'}\nG1{past.replace('-', '') or ' Y60'}\nG0 Z5\n"
    assert rapids_in_stock(scene(over + along + f"X{x:.4f} Y{y:.4f}\nZ-2", of)).passed


def test_from_where_the_tool_was_left_x_and_y_move_above_the_clamp() -> None:
    low = "G43 H3\nG0 Z10\nX-30 Y0\nZ5"
    found = positions(scene(low, clamped()))
    assert not found.passed
    assert "moves below Z15 from a place in X and Y that the text does not say" in found.message
    assert positions(scene(low.replace("Z10", "Z20"), clamped())).passed
    assert positions(scene(low, plate_job())).passed


def test_many_rapids_where_many_cuts_have_cleared_the_way_are_worked_out() -> None:
    """What one question has found clear no other asks again; what is not clear is found behind any number."""
    passes = "\n".join(f"X{10 * (-1) ** k} Y{-10 + k / 5:g}" for k in range(101))
    to_and_fro = "\n".join(f"G0 X{k % 19 - 9} Y{k * 7 % 17 - 8}" for k in range(300))
    low = f"G0 X-10 Y-10\nG43 H3 Z5\nG1 Z-1 F500\n{passes}\nX-10\n{to_and_fro}"
    found = rapids_in_stock(scene(f"{low}\nX10.1", plate_job()))
    assert found.message.startswith(f"line {4 + 3 + 102 + 300 + 1}: a rapid into the stock (1 in all)")


def test_what_is_clear_later_was_not_clear_before() -> None:
    stock = scene("G0 X0 Y0\nG43 H3 Z5\nG0 Z-1\nX20\nG0 Z5\nX0\nG1 Z-1 F500\nX20\nG0 X0", plate_job()).stock
    along = [step for step in stock.paths.rapids.tolist() if stock.paths.low[step] == -1]
    early, late = along[1], along[-1]
    assert [stock.meets(step) for step in (late, early, late)] == [False, True, False]


def test_shapes_that_geos_cannot_put_together_are_put_on_a_grid() -> None:
    """What GEOS refuses as it is goes with its corners on a grid, and all else without one."""
    asked: list[dict[str, float]] = []

    def operation(one: shapely.Polygon, other: shapely.Polygon, **how: float) -> shapely.Geometry:
        asked.append(how)
        if not how:
            raise shapely.errors.GEOSException("TopologyException: found non-noded intersection")
        return shapely.difference(one, other, **how)

    found = overlay(operation, shapely.box(0, 0, 3, 1), shapely.box(1, 0, 3, 1))
    assert found.equals(shapely.box(0, 0, 1, 1))
    assert asked == [{}, {"grid_size": SNAP}]
    assert overlay(shapely.union, shapely.box(0, 0, 3, 1), shapely.box(1, 0, 4, 1)).area == 4.0
