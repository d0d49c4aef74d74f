"""A small workshop for tests: a plate, its cutters, and a program made by hand from exact geometry."""

import math

from mechwright.contracts.part import Bore, Part, Profile
from mechwright.geometry import Arc, Line, Loop, Outline, circle
from mechwright_cam.program.moves import Drill, Feed, FeedArc, Move, Operation, Program, Rapid, ToolSection
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.holding import Hold
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool, ToolKind

HALF_X, HALF_Y, CORNER, BORE, THICKNESS = 30.0, 20.0, 8.0, 12.0, 6.0
BIAS = 0.001
TAB = Hold(tabs=4, tab_width=3.0, tab_height=1.0)

SPOT = Tool(name="spot-6", number=1, kind=ToolKind.SPOT_DRILL, diameter=6, flute_length=8, point_angle=90)
DRILL = Tool(name="drill-8", number=2, kind=ToolKind.DRILL, diameter=8, flute_length=40)
MILL = Tool(name="mill-6", number=3, kind=ToolKind.END_MILL, diameter=6, flutes=3, flute_length=12)
TOOLS = (SPOT, DRILL, MILL)


def rounded_box(half_x: float, half_y: float, corner: float) -> Loop:
    """A rectangle about the origin with round corners, counter-clockwise from the lower left."""
    x, y, c = half_x, half_y, corner
    quarter = math.pi / 2
    return Loop(
        (
            Line((-x + c, -y), (x - c, -y)),
            Arc((x - c, -y + c), c, -quarter, quarter),
            Line((x, -y + c), (x, y - c)),
            Arc((x - c, y - c), c, 0.0, quarter),
            Line((x - c, y), (-x + c, y)),
            Arc((-x + c, y - c), c, quarter, quarter),
            Line((-x, y - c), (-x, -y + c)),
            Arc((-x + c, -y + c), c, 2 * quarter, quarter),
        )
    )


def plate() -> Part:
    outer = rounded_box(HALF_X, HALF_Y, CORNER)
    sites = tuple((p, 20.0) for p in ((0.0, -HALF_Y), (HALF_X, 0.0), (0.0, HALF_Y), (-HALF_X, 0.0)))
    return Part(
        "plate",
        Outline(outer, (Loop((circle((0, 0), BORE / 2, clockwise=True),)),)),
        THICKNESS,
        "aluminium",
        machined=(
            Bore("bore", (0.0, 0.0), BORE, 0.0, THICKNESS),
            Profile("outside", outer, "outside", 0.0, THICKNESS, sites),
        ),
    )


def plate_job(**changes: object) -> Job:
    tools = changes.pop("tools", TOOLS)
    settings = {"hold": TAB, "ramp_angle": 3.0, "stock": {"margin": 9.0}, **changes}
    return make_job(plate(), CamSettings.model_validate(settings), tools)  # type: ignore[arg-type]


def contour(
    radius: float, z: float, feed: float, lift: float | None = None, bias: float = BIAS
) -> list[Move]:
    """Once around the plate at z, clockwise (climb), from the middle of the lower left corner's line.

    With ``lift`` the cutter goes over a tab in the middle of each side at that height.
    """
    r = radius + bias
    x, y, c = HALF_X + r, HALF_Y + r, CORNER + r
    gap = TAB.tab_width / 2 + radius + 0.01
    moves: list[Move] = []

    def side(x0: float, y0: float, x1: float, y1: float) -> None:
        if lift is not None:
            length = math.hypot(x1 - x0, y1 - y0)
            ux, uy = (x1 - x0) / length, (y1 - y0) / length
            mx, my = (x0 + x1) / 2, (y0 + y1) / 2
            before, after = (mx - ux * gap, my - uy * gap), (mx + ux * gap, my + uy * gap)
            moves.append(Feed(*before, z, feed))
            moves.append(Feed(None, None, lift, feed))
            moves.append(Feed(*after, None, feed))
            moves.append(Feed(None, None, z, feed / 4))
        moves.append(Feed(x1, y1, z, feed))

    def corner(x1: float, y1: float, i: float, j: float) -> None:
        moves.append(FeedArc(x1, y1, None, i, j, False, feed))

    side(-x, -y + c, -x, y - c)
    corner(-x + c, y, c, 0.0)
    side(-x + c, y, x - c, y)
    corner(x, y - c, 0.0, -c)
    side(x, y - c, x, -y + c)
    corner(x - c, -y, -c, 0.0)
    side(x - c, -y, -x + c, -y)
    corner(-x, -y + c, 0.0, c)
    return moves


def outside(radius: float, feed: float = 600.0, bias: float = BIAS) -> Operation:
    r = radius + bias
    x, y, c = HALF_X + r, HALF_Y + r, CORNER + r
    start = (-x, -y + c)
    moves: list[Move] = [Rapid(*start), Rapid(z=2.0), Feed(None, None, 0.0, feed / 4)]
    for top, bottom in ((0.0, -1.2), (-1.2, -2.4), (-2.4, -3.6), (-3.6, -4.8)):
        # Down along the left side, and back over the ramp when the way round is done.
        moves += [Feed(-x, y - c, bottom, feed), Feed(*start, bottom, feed)]
        moves += contour(radius, bottom, feed, bias=bias)
        assert top - bottom <= (2 * HALF_Y - 2 * CORNER) * math.tan(math.radians(3.0))
    moves.append(Feed(None, None, -THICKNESS - 0.3, feed / 4))
    moves += contour(radius, -THICKNESS - 0.3, feed, lift=-THICKNESS + TAB.tab_height + 0.1, bias=bias)
    moves.append(Rapid(z=5.0))
    return Operation("outside", tuple(moves))


def bore(radius: float, feed: float = 400.0, bias: float = BIAS) -> Operation:
    r = BORE / 2 - radius - bias
    moves: list[Move] = [Rapid(r, 0.0), Rapid(z=1.0), Feed(None, None, 0.0, feed)]
    depth, pitch = 0.0, 0.9
    while depth > -THICKNESS - 0.3:
        depth = max(depth - pitch, -THICKNESS - 0.3)
        moves.append(FeedArc(r, 0.0, depth, -r, 0.0, True, feed))
    moves.append(FeedArc(r, 0.0, None, -r, 0.0, True, feed))
    moves += [Feed(r - 1, 0.0, None, feed), Rapid(z=5.0)]
    return Operation("bore", tuple(moves))


def plate_program(name: str = "plate", mill: Tool = MILL, bias: float = BIAS) -> Program:
    spot = Operation("spot drill", (Rapid(0.0, 0.0, 5.0), Drill(0.0, 0.0, -2.0, 1.0, 150.0)))
    drill = Operation("drill", (Rapid(0.0, 0.0, 5.0), Drill(0.0, 0.0, -9.0, 1.0, 200.0, peck=3.0)))
    sections = (
        ToolSection(SPOT, 3000, "flood", (spot,)),
        ToolSection(DRILL, 2400, "flood", (drill,)),
        ToolSection(mill, 8000, "flood", (bore(mill.radius, bias=bias), outside(mill.radius, bias=bias))),
    )
    return Program(name, "G54", 5.0, sections, ("part plate, aluminium", "stock 78 x 58 x 6"))
