"""Rest stock from setup to setup: by depth, never more than was cut, and known to plan, proof and picture."""

from dataclasses import replace
from functools import cache

import height_map
import numpy as np
import pytest
import shapely
from by_control import BY_NAME, asked, cut_away, interpret, prove, simulated
from by_night import by_night
from planning_parts import LIBRARY, bore, rounded_box

from mechwright.contracts.details import Chamfer
from mechwright.contracts.finding import errors
from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.geometry import Outline
from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.machining import machine, second_setup
from mechwright_cam.planning import plan
from mechwright_cam.planning.setups import carried, lay_out_setups, turned_shape
from mechwright_cam.proof.carried import SWEPT
from mechwright_cam.setup.job import Air
from mechwright_cam.shop.settings import CamSettings

THICKNESS = 8.0
RIM = rounded_box(60, 40, 6)
FROM_ABOVE = Pocket("above", rounded_box(18, 14, 3).moved(16.0, 0.0), (), 0.0, 6.5)
FROM_BELOW = Pocket("below", rounded_box(16, 14, 3).moved(18.0, -3.0), (), 3.0, 5.0)
HOLE = Bore("bore", (-14.0, 0.0), 16.0, 0.0, THICKNESS)
WIDE = Bore("counterbore", (-14.0, 0.0), 22.0, 5.0, 3.0)
OUTSIDE = Profile("outside", RIM, "outside", 0.0, THICKNESS)
MEET = shapely.Polygon(FROM_ABOVE.boundary.flatten()) & shapely.Polygon(FROM_BELOW.boundary.flatten())
"""Where the two recesses overlap: between 3 and 6.5 mm below the top both take the same."""


@cache
def made(flip="x"):
    """Both sides, the second knowing what the first has left."""
    outline = Outline(RIM, (bore(16.0, (-14.0, 0.0)),))
    part = Part(
        "plate", outline, THICKNESS, "aluminium", machined=(HOLE, FROM_ABOVE, FROM_BELOW, WIDE, OUTSIDE)
    )
    part = replace(part, details=(Chamfer("rim", RIM, "outside", 0.4),))
    tools = ("spot-6", "drill-8", "mill-6", "mill-4", "chamfer-6")
    settings = CamSettings.model_validate({"tools": tools, "second_side": {"flip": flip}})
    jobs, found = lay_out_setups(part, settings, LIBRARY)
    assert not errors(found), found
    first = machine(jobs[0], LinuxCnc())
    return first, machine(second_setup(first, jobs[1]), LinuxCnc())


@cache
def milled(pitch=0.1):
    """The second simulator's view of both sides, one after the other."""
    first, second = made()
    above = height_map.Simulation(first.job.stock, THICKNESS, pitch)
    above.run(height_map.read(first.text), height_map.cutters(first.job))

    def opened(x, y):
        points = turned_back(np.column_stack((x.ravel(), y.ravel())))
        i = np.clip(np.searchsorted(above.x, points[:, 0]), 0, len(above.x) - 1)
        j = np.clip(np.searchsorted(above.y, points[:, 1]), 0, len(above.y) - 1)
        return (-THICKNESS - above.height[j, i]).clip(-THICKNESS, 0.0).reshape(x.shape)

    below = height_map.Simulation(second.job.stock, THICKNESS, pitch, under=opened)
    below.run(height_map.read(second.text), height_map.cutters(second.job))
    return above, below


def turned_back(points):
    """Places of the second setup in the work coordinates of the first; the plate was turned about X."""
    first, second = made()
    return (points + second.job.origin) * (1.0, -1.0) - first.job.origin


def test_both_sides_are_proven_and_no_rapid_meets_stock():
    for side, seen in zip(made(), milled(), strict=True):
        assert side.proof.ok, [check.message for check in side.proof.failures]
        assert seen.complaints == []


@pytest.mark.parametrize("flip", ["x", pytest.param("y", marks=by_night)])
def test_what_is_handed_on_was_cut(flip):
    first, second = made(flip)
    cut = cut_away(first.text, first.job)
    above = milled()[0]
    heights = [z for _, z in cut]
    assert heights == sorted(heights)
    assert {-8.0, -6.5, -0.4, -0.1} <= set(heights)
    for shape, z in cut:
        yy, xx = np.nonzero(above.solid)
        shapely.prepare(shape)
        within = shapely.contains_xy(shape, above.x[xx], above.y[yy])
        assert above.height[yy, xx][within].max() < z + 0.02
        # And nearly all of it: a cell's width along the edge is missing.
        low = (above.height <= z + 1e-3) & above.solid
        assert within.sum() > 0.97 * low.sum()
    for air, (shape, z) in zip(second.job.gone, cut, strict=True):
        assert air.top == pytest.approx(-z - THICKNESS)
        assert air.shape.area == pytest.approx(shape.area)
    # The recess of the first side is where it is seen from below.
    (recess,) = [air for air in second.job.gone if air.top == -1.5]
    middle = turned_shape(
        shapely.Point(16 - first.job.origin[0], -first.job.origin[1]), first.job, second.job
    )
    assert recess.shape.contains(middle)
    assert not second.job.air_below(-1.4).contains(middle)


def test_recesses_that_meet_break_through():
    first, second = made()
    below = milled()[1]
    there = turned_shape(
        shapely.transform(MEET.buffer(-0.3), lambda p: p - first.job.origin), first.job, second.job
    )
    assert len(below.left(there, -THICKNESS)) == 0
    alone = shapely.Polygon(FROM_BELOW.boundary.flatten()) - MEET.buffer(0.3)
    beside = turned_shape(shapely.transform(alone, lambda p: p - first.job.origin), first.job, second.job)
    assert len(below.left(beside, -THICKNESS)) > 0
    assert len(below.left(beside.buffer(-0.3), -4.98)) == 0
    seen = simulated(second.text, second.job)
    x0, y0, _, _ = second.job.stock
    at = there.centroid
    assert seen.heights[int((at.y - y0) / seen.cell), int((at.x - x0) / seen.cell)] == -THICKNESS


def test_the_same_stock_stands_in_both_simulators():
    for side, seen in zip(made(), milled(), strict=True):
        grid = simulated(side.text, side.job)
        x0, y0, _, _ = side.job.stock
        i = np.clip(((seen.x - x0) / grid.cell).astype(int), 0, grid.heights.shape[1] - 1)
        j = np.clip(((seen.y - y0) / grid.cell).astype(int), 0, grid.heights.shape[0] - 1)
        ours = grid.heights[np.ix_(j, i)]
        theirs = np.where(seen.height <= seen.lowest + 1e-4, -THICKNESS, seen.height)
        cells = (seen.x > x0) & (seen.x < side.job.stock[2])
        rows = (seen.y > y0) & (seen.y < side.job.stock[3])
        off = np.abs(ours - theirs)[np.ix_(rows, cells)]
        assert (off > 0.05).mean() < 0.02


def test_the_underside_does_not_cut_air():
    _, second = made()
    blind = replace(second.job, gone=())
    plain = LinuxCnc().write(plan(blind))
    assert prove(plain, blind).ok
    knowing, not_knowing = (simulated(text, second.job) for text in (second.text, plain))
    assert knowing.feed_mm < 0.9 * not_knowing.feed_mm
    assert knowing.air_mm < 0.6 * not_knowing.air_mm
    # Without what the first side has left, mills go down into full material and finish what was not roughed.
    assert not asked("plunges", second.text, blind).passed
    assert not asked("chips", second.text, blind).passed


def rapid_into(text, x, y, z, *, first):
    """The program with a rapid down to z at a place, before it cuts, or at its end."""
    down = f"G0 X{x:.3f} Y{y:.3f}\nG0 Z{z:g}\nG0 Z5\n"
    if first:
        place = text.index("\n", text.index("G43 H")) + 1
        back = text[:place].splitlines()[-2]
        assert back.startswith("G0 X")
        return text[:place] + down + back + "\n" + text[place:]
    tool = interpret(text).tool[-1]
    return text.replace("M30\n", f"G54\nG55\nG0 X{x:.3f} Y{y:.3f}\nG43 H{tool} Z5\n{down}G53 G0 Z0\nM30\n")


def test_rapids_know_the_real_stock():
    first, second = made()
    middle = shapely.transform(MEET.centroid, lambda p: p - first.job.origin)
    at = turned_shape(middle, first.job, second.job)

    def passes(z, job, *, early=False):
        text = rapid_into(second.text, at.x, at.y, z, first=early)
        return asked("rapids-in-stock", text, job).passed

    assert passes(-7.0, second.job)  # both recesses have been there
    assert not passes(-7.0, replace(second.job, gone=()))
    assert not passes(-7.0, second.job, early=True)  # the upper 1.5 mm still stand
    through = [air for air in second.job.gone if air.top == 0.0]
    assert not passes(-7.0, replace(second.job, gone=tuple(through)))


def test_chips_are_as_thick_as_the_stock_that_is_there():
    """A cut over an opening from below takes what stands above the opening, and no more."""
    _, second = made()
    (x0, y0, x1, y1), tool = second.job.stock, second.program.sections[0].tool
    y = (y0 + y1) / 2
    text = (
        f"G21 G17 G90 G94 G40 G49 G80\nT{tool.number} M6\nG55 S5000 M3\nG0 X{x0 - 5} Y{y}\n"
        f"G43 H{tool.number} Z5\nG0 Z-6\nG1 X{x1 + 5} F300\nG0 Z5\nM5\nM30\n"
    )
    whole = replace(second.job, gone=())
    opened = replace(second.job, gone=(Air(shapely.box(x0, y0, x1, y1), -2.0),))
    through = replace(second.job, gone=(Air(shapely.box(x0 - 1, y0 - 1, x1 + 1, y1 + 1), 0.0),))
    rates = [simulated(text, job).works for job in (whole, opened, through)]
    assert rates[0][0].removal == pytest.approx(3 * rates[1][0].removal, rel=0.02)
    assert rates[2] == ()
    blank = simulated(text, through)
    assert blank.air_mm == blank.feed_mm


def test_nothing_is_carried_from_a_program_that_cuts_nothing():
    first, second = made()
    assert cut_away("G21 G90\nM30\n", first.job) == ()
    assert carried((), first.job, second.job) == ()


def test_other_controls_hand_on_the_same():
    first, _ = made()
    reference = cut_away(first.text, first.job)
    haas = host().get(Control, "haas")
    text = haas.write(first.program)
    found = cut_away(text, first.job, BY_NAME["haas"])
    assert [z for _, z in found] == [z for _, z in reference]
    for (one, _), (two, _) in zip(found, reference, strict=True):
        assert one.symmetric_difference(two).area < SWEPT * one.length
