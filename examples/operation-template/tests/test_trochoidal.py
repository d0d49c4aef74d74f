import itertools
import math

import numpy as np
import pytest
import shapely
from mechwright_trochoidal import plugin
from mechwright_trochoidal.operation import Trochoidal, pitch

from mechwright.contracts.part import OpenProfile, Part, Profile
from mechwright.errors import DesignError
from mechwright.geometry import Arc, Line, Loop, Outline
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.operations.engagement import engagements
from mechwright_cam.planning import Assignments, choose_tools, plan
from mechwright_cam.program.moves import Feed, FeedArc
from mechwright_cam.proof import prove
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.settings import CamSettings

LIBRARY = load_library()
BOX = Loop.polygon([(-50, -30), (50, -30), (50, 30), (-50, 30)])
STRAIGHT = (Line((-35.0, 5.0), (30.0, -10.0)),)
CURVED = (Line((-30.0, -15.0), (10.0, -15.0)), Arc((10.0, 0.0), 15.0, -math.pi / 2, math.pi))
PATHS = {"straight": STRAIGHT, "curved": CURVED}
LIMIT = 60.0
SLACK = 3.0
"""Degrees by which a measured engagement may be more than asked for: it is counted in steps of two."""


def plate(path, width=10.0, depth=4.0, thickness=8.0):
    groove = OpenProfile("groove", 0.0, depth, path=path, side="on", width=width)
    inner = (groove.boundary.reversed(),) if depth >= thickness else ()
    outside = Profile("outside", BOX, "outside", 0.0, thickness)
    return Part("plate", Outline(BOX, inner), thickness, "aluminium", machined=(groove, outside))


def job(part, *tools, **changes):
    table = {"operations": ["trochoidal"], "tools": tools, "engagement": LIMIT, **changes}
    settings = CamSettings.model_validate(table)
    return make_job(part, settings, choose_tools(part, settings, LIBRARY, assignments()))


def assignments():
    return Assignments([Trochoidal()])


def proven(of):
    program = plan(of, assignments())
    proof = prove(LinuxCnc().write(program), of, LinuxCnc())
    assert proof.ok, [check.message for check in proof.failures]
    return program


def cuts(program):
    return {operation.name: operation.moves for one in program.sections for operation in one.operations}


def ways_of(moves):
    """The ways (n, 2) of a cut at its lowest height, in order; arcs in small steps."""
    x = y = z = 0.0
    lowest = min(move.z for move in moves if getattr(move, "z", None) is not None)
    for move in moves:
        a, b = (x if move.x is None else move.x), (y if move.y is None else move.y)
        height = getattr(move, "z", None)
        if isinstance(move, Feed | FeedArc) and z == lowest and height is None:
            if isinstance(move, FeedArc):
                cx, cy, side = x + move.i, y + move.j, 1 if move.ccw else -1
                begin, end = math.atan2(y - cy, x - cx), math.atan2(b - cy, a - cx)
                t = begin + side * np.linspace(0, ((end - begin) * side) % math.tau or math.tau, 40)
                yield np.column_stack((cx, cy)) + math.hypot(move.i, move.j) * np.column_stack(
                    (np.cos(t), np.sin(t))
                )
            else:
                yield np.linspace((x, y), (a, b), 20)
        x, y, z = a, b, z if height is None else height


def measured(moves, radius):
    """Engagement, degrees, of each way of a cut against all that was cut before; it starts with a turn."""
    first, second, *ways = ways_of(moves)
    cleared = shapely.Polygon(np.concatenate((first, second))).buffer(radius)
    found = []
    for way in ways:
        found.append(math.degrees(engagements(way, cleared, radius).max()))
        cleared = shapely.union(cleared, shapely.LineString(way).buffer(radius, quad_segs=32))
    return np.array(found)


@pytest.mark.parametrize("climb", [True, False])
@pytest.mark.parametrize("name", PATHS)
def test_a_groove_is_opened_in_loops_of_bounded_engagement_and_proven(name, climb):
    of = job(plate(PATHS[name]), "mill-6", "mill-4", climb=climb)
    moves = cuts(proven(of))
    assert next(cut for cut in moves if cut.startswith("groove")) == "groove: loops"
    engaged = measured(moves["groove: loops"], 3.0)
    assert len(engaged) > 80
    assert 0.5 * LIMIT < engaged.max() <= LIMIT + SLACK


def test_a_groove_through_the_plate_is_proven():
    assert "groove: loops" in cuts(proven(job(plate(STRAIGHT, depth=8.0), "mill-6")))


def test_the_cutters_are_chosen_for_it():
    assert "groove: loops" in cuts(proven(job(plate(STRAIGHT, width=12.0))))


@pytest.mark.parametrize(("width", "tools"), [(6.0, ("mill-6",)), (8.0, ("mill-6",))])
def test_what_has_no_room_for_loops_stays_with_the_built_in_operations(width, tools):
    assert "groove: loops" not in cuts(proven(job(plate(STRAIGHT, width), *tools)))


def test_without_its_name_nothing_changes():
    of = job(plate(CURVED), "mill-6", "mill-4", operations=[])
    assert LinuxCnc().write(plan(of, assignments())) == LinuxCnc().write(plan(of))


def test_a_name_that_is_not_known_is_refused_with_those_that_are():
    with pytest.raises(DesignError, match=r"no operation is named 'trochoid'; there is: .*clear.*trochoidal"):
        plan(job(plate(STRAIGHT), "mill-6", operations=["trochoid"]), assignments())
    with pytest.raises(DesignError, match=r"cam\.operations: no operation is named 'trochoidal'"):
        plan(job(plate(STRAIGHT), "mill-6"))


def test_the_pitch_follows_from_the_engagement():
    for angle, radius in itertools.product((30, 60, 90), (1.0, 2.0, 5.0)):
        ahead = radius + pitch(radius, 3.0, math.radians(angle))
        met = complex(ahead + 3.0 * math.cos(math.radians(angle)), 3.0 * math.sin(math.radians(angle)))
        assert abs(met) == pytest.approx(radius + 3.0)


def test_the_stock_is_a_value():
    from mechwright_cam.operations.steps import Steps
    from mechwright_cam.operations.stock import Stock

    of = job(plate(STRAIGHT), "mill-6")
    task = next(t for t in assignments().of(of).every() if t.feature.name == "groove")
    before = Stock(task.region)
    after = task.operation.cut(task, before, Steps(of, 5.0))
    assert before.left is task.region
    wall = task.region.boundary.buffer(of.settings.stock_to_leave + 0.05)
    assert (
        0 < after.left.area <= after.left.intersection(wall).area + 1e-6
    )  # what finishing takes off the wall


def test_the_plugin_registers_it():
    assert plugin.mechwright_register() == [Trochoidal]
