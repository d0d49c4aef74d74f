"""The channel around an outside, peeled with bounded engagement."""

import math

import numpy as np
import pytest
import shapely
from by_control import BY_NAME
from planning_parts import bore, job, lobes, part, plate, rounded_box

from mechwright.contracts.part import Part, is_outside
from mechwright_cam.machining import Machined, machine
from mechwright_cam.operations.engagement import engagements
from mechwright_cam.operations.peel import AHEAD, BACK, Peel, step_of
from mechwright_cam.program.moves import FeedArc
from mechwright_plane.offsets import densified


def made(of: Part, *tools: str, **settings: object) -> Machined:
    return machine(job(of, *tools, **settings), BY_NAME["linuxcnc"])


def peeling(one: Machined) -> list[FeedArc]:
    operations = [o for section in one.program.sections for o in section.operations]
    (peel,) = [o for o in operations if o.name == "outside: peel"]
    return [move for move in peel.moves if isinstance(move, FeedArc) and move.z is None]


@pytest.mark.parametrize("engagement", [45, 60, 90, 120])
def test_a_cutter_before_a_disc_engages_by_the_angle_asked_for(engagement: int) -> None:
    angle, radius, loop = math.radians(engagement), 3.0, 0.9
    step = step_of(radius, loop, angle)
    assert 0 < step < radius
    turn = np.linspace(BACK, AHEAD, 400)
    ways = np.column_stack((step + loop * np.cos(turn), loop * np.sin(turn)))
    cleared = shapely.Point(0, 0).buffer(radius + loop, quad_segs=256)
    assert engagements(ways, cleared, radius).max() == pytest.approx(angle, abs=math.radians(3))


@pytest.mark.parametrize("engagement", [60, 90])
@pytest.mark.parametrize("outer", [rounded_box(60, 40, 6), lobes(5, 30, 6)])
def test_no_loop_engages_more_however_the_wall_bends(outer, engagement: int) -> None:
    """The discs that the loops before have cleared, and every cutting arc laid on them."""
    one = made(part(outer, thickness=10.0), "mill-6", outsides="adaptive", engagement=engagement)
    assert one.proof.ok
    arcs, here, radius = peeling(one), None, 3.0
    most, cleared, loops = 0.0, shapely.Polygon(), 0
    for move in arcs[2:]:  # behind the helix, which opens the first disc
        if here is not None:
            centre = np.add(here, (move.i, move.j))
            start, end = (np.arctan2(*(np.array(at) - centre)[::-1]) for at in (here, (move.x, move.y)))
            sweep = (end - start) % math.tau
            turn = start + sweep * np.linspace(0, 1, 60)
            way = centre + math.hypot(move.i, move.j) * np.column_stack((np.cos(turn), np.sin(turn)))
            if loops > 4:
                most = max(most, float(engagements(densified(way, 0.2), cleared, radius).max()))
            cleared = shapely.union(cleared, shapely.LineString(way).buffer(radius, quad_segs=32))
            loops += 1
            if loops > 44:
                break
        here = (move.x, move.y)
    assert loops > 40
    assert math.degrees(most) <= engagement + 5


def test_by_default_outsides_are_cut_as_ever() -> None:
    names = [o.name for o in made(plate(bore(12.0)), "mill-6").proof.operations]
    assert "outside: rough" in names
    assert "outside: peel" not in names
    of = job(plate(bore(12.0)), "mill-6")
    outside = next(feature for feature in of.features if is_outside(feature))
    assert Peel().claim(outside, of) is None
    assert Peel().choose(outside, of, ()) is None


def test_the_faster_of_both_is_taken() -> None:
    of = part(rounded_box(30, 24, 5), thickness=10.0)
    each = {way: made(of, "mill-6", outsides=way, engagement=90) for way in ("contour", "adaptive", "faster")}
    seconds = {way: one.proof.time_estimate_s for way, one in each.items()}
    # Its stock is as large as peeling wants it.
    assert seconds["faster"] == pytest.approx(min(seconds["contour"], seconds["adaptive"]), rel=0.02)


@pytest.mark.parametrize("control", ["fanuc", "heidenhain-tnc", "grbl"])
def test_bound_by_the_bore_the_whole_channel_is_peeled(control: str) -> None:
    hold = {"method": "bore", "clamp_diameter": 10, "clamp_height": 8}
    of = job(
        part(rounded_box(60, 40, 6), bore(16.0), thickness=10.0), "mill-6", outsides="adaptive", hold=hold
    )
    one = machine(of, BY_NAME[control])
    assert one.proof.ok
    assert "outside: peel" in [o.name for o in one.proof.operations]
