"""What the proof says of corners, pockets and floors."""

import math
from dataclasses import replace

import pytest
import shapely
from by_control import prove
from shop import BIAS, DRILL, MILL, SPOT, plate, plate_job, plate_program
from test_proof import CLEAN, proof_of

from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.geometry import Arc, Line, Loop, Outline, circle
from mechwright_cam.program.moves import (
    Drill,
    Feed,
    FeedArc,
    Move,
    Operation,
    Program,
    Rapid,
    ToolSection,
)
from mechwright_cam.proof import Proof
from mechwright_cam.proof.plane import closing
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.holding import Hold
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool, ToolKind

# -- corners, pockets and other parts -----------------------------------------------------------------------


def ell() -> Loop:
    """An L with one sharp inner corner at the origin."""
    return Loop.polygon([(-20, -20), (20, -20), (20, 0), (0, 0), (0, 20), (-20, 20)])


def follow(shape: shapely.Polygon, tool: Tool, z: float) -> tuple[Move, ...]:
    """Once around a shape at one depth, plunging in."""
    path = shape.buffer(tool.radius + BIAS, quad_segs=90).exterior.coords
    (x, y), *rest = path
    return (
        Rapid(x, y),
        Rapid(z=1.0),
        Feed(None, None, z, 100.0),
        *(Feed(px, py, None, 500.0) for px, py in rest),
        Rapid(z=5.0),
    )


def test_a_corner_that_no_cutter_reaches_is_measured_and_located() -> None:
    part = Part("ell", Outline(ell()), 4.0, "aluminium")
    settings = CamSettings(hold=Hold(method="tabs", tabs=2, tab_width=0.5, tab_height=0.2))
    job = replace(make_job(part, settings, (MILL,)), tabs=())
    around = follow(job.target, MILL, -4.3)
    section = ToolSection(MILL, 8000, "flood", (Operation("around", around),))
    proof = proof_of(Program("ell", "G54", 5.0, (section,)), job)
    assert [check.name for check in proof.failures] == ["holding"]  # there are no tabs
    r = MILL.radius
    assert len(proof.unreachable) == 1
    spot = proof.unreachable[0]
    assert spot.area == pytest.approx(r * r * (1 - math.pi / 4), rel=2e-3)
    assert math.hypot(spot.x, spot.y) < r
    # The deepest place is on the disc: where its distance to both walls is the same.
    assert spot.depth == pytest.approx(r - r / math.sqrt(2), abs=2e-3)
    assert proof.unreachable_area_mm2 == pytest.approx(spot.area)
    assert "in 1 place" in proof.notes[0]


def test_the_closing_is_what_a_round_cutter_leaves() -> None:
    corner = shapely.Polygon(ell().flatten())
    for radius in (0.5, 3.0):
        left = closing(corner, radius).difference(corner).area
        assert left == pytest.approx(radius**2 * (1 - math.pi / 4), rel=5e-3)


def pocket_part(half_width: float = 3.0) -> Part:
    outer = Loop.polygon([(-30, -20), (30, -20), (30, 20), (-30, 20)])
    half, r = 10.0, half_width
    rim = Loop(
        (
            Line((-half, -r), (half, -r)),
            Arc((half, 0.0), r, -math.pi / 2, math.pi),
            Line((half, r), (-half, r)),
            Arc((-half, 0.0), r, math.pi / 2, math.pi),
        )
    )
    return Part(
        "pocketed",
        Outline(outer),
        8.0,
        "aluminium",
        machined=(Pocket("slot", rim, (), 0.0, 3.0), Profile("outside", outer, "outside", 0.0, 8.0)),
    )


SMALL = Tool(name="mill-4", number=5, kind=ToolKind.END_MILL, diameter=4, flutes=3, flute_length=12)


def pocket_proof(
    depth: float, offset: float = 1 - BIAS, part: Part | None = None, *, middle: bool = True
) -> Proof:
    part, x = part or pocket_part(), 10.0
    job = make_job(part, CamSettings(hold=Hold(tabs=2, tab_width=3, tab_height=1)), (SMALL,))
    y = offset
    slot: tuple[Move, ...] = (
        Rapid(-x if middle else x, 0.0 if middle else -y),
        Rapid(z=1.0),
        Feed(None, None, -depth, 100.0),
        Feed(x, 0.0 if middle else -y, None, 300.0),
        Feed(x, -y, None, 300.0),
        FeedArc(x, y, None, 0.0, y, True, 300.0),
        Feed(-x, y, None, 300.0),
        FeedArc(-x, -y, None, 0.0, -y, True, 300.0),
        Feed(x, -y, None, 300.0),
        Rapid(z=5.0),
    )
    section = ToolSection(SMALL, 8000, "flood", (Operation("slot", slot),))
    return proof_of(Program("pocketed", "G54", 5.0, (section,)), job)


def test_a_pocket_is_judged_down_to_its_floor() -> None:
    clean = pocket_proof(3.0)
    assert clean.gouge_max_mm <= BIAS
    assert "outside" in clean.checks["depth"].message  # the pocket is done, the outside is not begun
    assert pocket_proof(2.5).checks["depth"].message.startswith("slot is cut down to Z-2.500")


def test_a_floor_is_gouged_by_the_depth_of_the_cut() -> None:
    assert pocket_proof(3.05).gouge_max_mm == pytest.approx(0.05, abs=1e-4)
    assert pocket_proof(3.003).checks["gouge"].passed
    assert pocket_proof(3.0, offset=1.1).gouge_max_mm == pytest.approx(0.1, abs=1e-3)


def test_stock_that_stands_on_a_floor_is_found() -> None:
    """A pocket 10 mm wide, cut by a 4 mm mill along its walls only: a rib of 2 mm stays in the middle."""
    part = pocket_part(half_width=5.0)
    around = pocket_proof(3.0, part=part, offset=3 - BIAS, middle=False)
    rib = around.checks["leftover"]
    assert not rib.passed
    assert rib.at is not None
    assert rib.at[1] == pytest.approx(0.0, abs=1.1)
    # Its sides stand 4 mm from the walls.
    assert around.leftover_reachable_max_mm == pytest.approx(4.0, abs=0.01)


def test_a_gap_in_the_middle_of_a_straight_wall_is_found() -> None:
    part = Part("box", Outline(Loop.polygon([(0, 0), (40, 0), (40, 20), (0, 20)])), 4.0, "aluminium")
    job = replace(make_job(part, CamSettings(hold=Hold(tab_width=1, tab_height=0.2)), (MILL,)), tabs=())
    r = MILL.radius + BIAS
    for gap in (0.0, 0.6, 1.0, 9.0):
        start, end = 20 + gap / 2, 20 - gap / 2
        corners = [(40 + r, -r), (40 + r, 20 + r), (-r, 20 + r), (-r, -r), (end, -r)]
        feeds = tuple(Feed(x, y, None, 500.0) for x, y in corners)
        moves: tuple[Move, ...] = (Rapid(start, -r), Rapid(z=1.0), Feed(None, None, -4.3, 100.0), *feeds)
        section = ToolSection(MILL, 8000, "flood", (Operation("around", (*moves, Rapid(z=5.0))),))
        proof = proof_of(Program("box", "G54", 5.0, (section,)), job)
        # The wall's middle is as far from both discs: Pythagoras.
        cusp = math.hypot(r, gap / 2) - MILL.radius
        assert proof.leftover_reachable_max_mm == pytest.approx(cusp, rel=3e-3, abs=1e-3)


def test_tabs_need_a_frame() -> None:
    job = plate_job()
    x0, y0, x1, y1 = job.stock
    narrow = replace(job, stock=(x0 + 4, y0 + 4, x1 - 4, y1 - 4))  # the cutter takes all of that margin
    proof = prove(CLEAN, narrow)
    assert [c.name for c in proof.failures] == ["holding"]
    assert "larger margin" in proof.failures[0].message


def test_a_loose_piece_is_remarked_on() -> None:
    ring = plate_program(mill=SMALL)
    proof = proof_of(ring, plate_job(tools=(SPOT, SMALL, DRILL)))
    assert proof.notes == ()  # the drill has taken the middle of the bore
    undrilled = replace(ring, sections=ring.sections[2:])
    notes = proof_of(undrilled, plate_job(tools=(SMALL,))).notes
    assert len(notes) == 1
    assert "comes loose in bore" in notes[0]


def test_a_hole_of_a_drill_s_size_is_reached_by_the_drill() -> None:
    outer = plate().outline
    assert outer is not None
    small = Outline(outer.outer, (Loop((circle((0, 0), 4.0, clockwise=True),)),))
    part = replace(
        plate(),
        outline=small,
        machined=(Bore("hole", (0.0, 0.0), 8.0, 0.0, 6.0), plate().machined[1]),
    )
    wide = MILL.model_copy(update={"diameter": 10.0})
    job = make_job(part, CamSettings(hold=Hold(tabs=4, tab_width=3, tab_height=1)), (SPOT, DRILL, wide))
    drill = Operation("drill", (Rapid(0.0, 0.0, 5.0), Drill(0.0, 0.0, -9.0, 1.0, 200.0)))
    edge: tuple[Move, ...] = (Rapid(-35.1, 0.0), Rapid(z=1.0), Feed(None, None, -0.5, 50.0), Rapid(z=5.0))
    sections = (
        ToolSection(DRILL, 2400, "flood", (drill,)),
        ToolSection(wide, 8000, "flood", (Operation("edge", edge),)),
    )
    proof = proof_of(Program("hole", "G54", 5.0, sections), job)
    assert proof.unreachable_area_mm2 == 0
    shallow = replace(drill, moves=(Rapid(0.0, 0.0, 5.0), Drill(0.0, 0.0, -7.0, 1.0, 200.0)))
    narrow = replace(sections[0], operations=(shallow,))
    cone = proof_of(Program("hole", "G54", 5.0, (narrow, sections[1])), job)
    # 1 mm below the underside a 118° point is 1.66 mm in radius: the ring outside it stays.
    ring = math.pi * (16 - math.tan(math.radians(59)) ** 2)
    assert cone.unreachable_area_mm2 == pytest.approx(ring, rel=1e-2)
