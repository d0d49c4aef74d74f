"""Bull noses and balls: what they leave, what is planned with them, and what the proof finds."""

import math
from collections import Counter

import numpy as np
import pytest
import shapely
from by_control import asked, prove
from height_map import read
from hypothesis import given, settings
from hypothesis import strategies as st
from round_parts import (
    LIBRARY,
    OUTSIDE,
    PLATE,
    POCKET,
    THICK,
    box,
    cut,
    failed,
    laid,
    made,
    operations,
    stadium,
)

from mechwright.contracts.finding import Severity
from mechwright.contracts.part import Bore, Part, Pocket
from mechwright.errors import DesignError, ToolError
from mechwright.geometry import Loop, Outline, circle
from mechwright_cam.planning import lay_out, plan
from mechwright_cam.proof.fillets import fillets, stay
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import CuttingData, Tool, ToolKind


def round_pocket(radius: float, corner: float = 4.0) -> Pocket:
    return Pocket("pocket", box(14, 9, corner), (), 0.0, 4.0, radius)


class TestFlatFloors:
    """Recesses without a fillet of their own."""

    def test_a_bull_nose_leaves_its_corner_at_the_foot_of_the_wall(self) -> None:
        job = laid(POCKET, tools=("bull-6-r1",))
        text, proof = made(job)
        assert failed(proof) == []
        assert proof.leftover_reachable_max_mm < 0.01
        # Where the leftover limit is measured, 0.01 mm above the floor, the fillet is 0.859 mm wide.
        assert proof.unreachable_max_mm == pytest.approx(1 - math.sqrt(1 - 0.99**2), abs=2e-3)
        assert {spot.z for spot in proof.unreachable} == {-4.0}
        simulation = cut(text, job)
        floor = shapely.Polygon(POCKET.boundary.flatten())
        assert len(simulation.left(floor.buffer(-1.01), -3.999)) == 0
        assert len(simulation.left(floor.buffer(-0.9).difference(floor.buffer(-0.95)), -3.999)) > 20

    def test_a_flat_end_mill_of_its_size_takes_that_as_well(self) -> None:
        job = laid(POCKET, tools=("bull-6-r1", "mill-6"))
        text, proof = made(job)
        assert failed(proof) == []
        assert proof.unreachable == ()
        assert operations(text) == [
            "pocket: rough", "pocket: finish the floor", "pocket: level the floor", "pocket: finish",
        ]  # fmt: skip
        used = [section.tool.name for section in plan(job).sections]
        assert used == ["bull-6-r1", "mill-6"]
        floor = shapely.Polygon(POCKET.boundary.flatten()).buffer(-0.01)
        assert len(cut(text, job).left(floor, -3.999)) == 0

    def test_a_ball_alone_leaves_cusps_below_the_limit(self) -> None:
        job = laid(Pocket("pocket", box(9, 6, 4), (), 0.0, 4.0), tools=("ball-6",))
        text, proof = made(job)
        assert failed(proof) == []
        simulation = cut(text, job)
        floor = shapely.Polygon(box(9, 6, 4).flatten()).buffer(-3.0)
        heights = simulation.height[shapely.contains_xy(floor, *np.meshgrid(simulation.x, simulation.y))]
        assert -4.0001 < heights.min() < -3.999
        assert -3.998 < heights.max() <= -3.99

    def test_cusps_of_a_wide_step_are_leftover(self) -> None:
        # Straight rows of a ball, 1 mm apart: cusps of 3 - √(9 - 0.25) = 0.042 mm.
        pocket = Pocket("pocket", Loop.polygon([(-26, -19), (26, -19), (26, 19), (-26, 19)]), (), 0.0, 1.0)
        job = laid(pocket, tools=("ball-6",))
        for step, good in ((0.2, True), (1.0, False)):
            rows = np.arange(-22, 22.01, step)
            lines = [f"X{29 if i % 2 else -29} Y{y:.3f}\nX{-29 if i % 2 else 29}" for i, y in enumerate(rows)]
            head = "G17 G21 G40 G49 G80 G90 G94\nG53 G0 Z0\nT49 M6\nG54 S10000 M3\nG0 X-29 Y-22\nG43 H49 Z5\nM8\n"
            text = head + "G1 Z-1 F800\n" + "\n".join(lines) + "\nG0 Z5\nM9\nM5\nG53 G0 Z0\nM30\n"
            assert asked("leftover", text, job).passed == good

    def test_through_cuts_go_deeper_by_the_corner(self) -> None:
        job = laid(OUTSIDE, tools=("bull-6-r1",))
        text, proof = made(job)
        assert failed(proof) == []
        assert min(float(m.points[:, 2].min()) for m in read(text) if m.kind == "feed") == pytest.approx(-9.3)
        assert "round mills go 1.30 mm below the stock: leave room under the cuts" in text
        # The same path with its tip only where a flat end mill's may be leaves the fillet standing.
        shallow = prove(text.replace("Z-9.3", "Z-8.3"), job)
        assert "leftover" in failed(shallow)

    def test_bores_through_and_blind(self) -> None:
        bores = (Bore("through", (-12.0, 0.0), 16.0, 0.0, THICK), Bore("blind", (12.0, 0.0), 16.0, 0.0, 4.0))
        job = laid(bores[0], tools=("bull-6-r1",))
        text, proof = made(job)
        assert failed(proof) == []
        simulation = cut(text, job)
        assert len(simulation.left(shapely.Point(-12, 0).buffer(7.98), -7.999)) == 0
        # A bore is cut to its wall down to the floor, which no round mill can do.
        for name in ("bull-6-r1", "ball-6"):
            with pytest.raises(ToolError, match="nothing makes blind of 16 mm"):
                plan(laid(bores[1], tools=(name,)))
        assert failed(made(laid(bores[1], tools=("bull-6-r1", "mill-6")))[1]) == []

    def test_clearing_with_bounded_engagement(self) -> None:
        job = laid(POCKET, tools=("bull-6-r1", "mill-4"), clearing="adaptive", engagement=90)
        text, proof = made(job)
        assert failed(proof) == []
        assert operations(text)[0] == "pocket: clear"
        floor = shapely.Polygon(POCKET.boundary.flatten()).buffer(-0.01)
        assert len(cut(text, job).left(floor, -3.999)) == 0

    def test_stock_left_on_floors(self) -> None:
        job = laid(POCKET, tools=("bull-6-r1", "mill-6"), floor_to_leave=0.3)
        text, proof = made(job)
        assert failed(proof) == []
        floor = shapely.Polygon(POCKET.boundary.flatten()).buffer(-0.01)
        assert len(cut(text, job).left(floor, -3.999)) == 0

    def test_a_finer_bull_nose_comes_after_the_flat_mill(self) -> None:
        fine = LIBRARY.get("bull-6-r1").model_copy(
            update={"name": "bull-2", "number": 90, "diameter": 2.0, "corner_radius": 0.3}
        )
        job = laid(
            Pocket("pocket", box(14, 9, 1.2), (), 0.0, 4.0),
            tools=("mill-6", "bull-2"),
            library=LIBRARY.extended((fine,)),
        )
        text, proof = made(job)
        assert failed(proof) == []
        assert operations(text).count("pocket: finish") == 2
        assert proof.unreachable_max_mm < 0.3


class TestRoundFloors:
    """Recesses with a fillet."""

    @pytest.mark.parametrize("tools", [("ball-6", "mill-6"), ()])
    def test_a_ball_makes_the_fillet(self, tools: tuple[str, ...]) -> None:
        pocket = round_pocket(3.0)
        job = laid(pocket, tools=tools)
        text, proof = made(job)
        assert failed(proof) == []
        assert proof.unreachable_max_mm < 0.005
        simulation = cut(text, job)
        x, y = np.meshgrid(simulation.x, simulation.y)
        region = shapely.Polygon(pocket.boundary.flatten())
        inside = shapely.contains_xy(region, x, y)
        away = shapely.distance(region.exterior, shapely.points(x[inside], y[inside]))
        want = -4 + 3 - np.sqrt(9 - np.maximum(3 - away, 0) ** 2)
        off = simulation.height[inside] - want
        assert off.min() > -0.005  # nothing is cut into the fillet
        # Near the top of the wall a hair's breadth beside it is a long way up.
        assert off[away > 0.5].max() < 0.015

    def test_its_tools_are_chosen(self) -> None:
        names = [tool.name for tool in laid(round_pocket(3.0)).tools]
        assert "ball-6" in names
        assert any(name.startswith("mill-") for name in names)
        assert "bull-6-r1" in [tool.name for tool in laid(round_pocket(1.0)).tools]
        assert all(tool.nose == 0 for tool in laid(POCKET).tools)

    def test_no_tool_has_the_radius(self) -> None:
        with pytest.raises(
            ToolError, match=r"no listed mill leaves the fillet of 2 mm .* list a ball of 4 mm"
        ):
            laid(round_pocket(2.0))
        with pytest.raises(ToolError, match="leaves the fillet of 3 mm"):
            plan(laid(round_pocket(3.0), tools=("mill-6", "bull-6-r1")))

    @pytest.mark.parametrize(
        "groove",
        [
            Pocket("groove", stadium(12, 3), (), 0.0, 4.0, 3.0),
            Pocket("groove", Loop.polygon([(-30, -3), (30, -3), (30, 3), (-30, 3)]), (), 0.0, 4.0, 3.0),
            Pocket("groove", Loop((circle((0, 0), 14),)), (Loop((circle((0, 0), 8),)),), 0.0, 4.0, 3.0),
        ],
        ids=["closed", "open", "ring"],
    )
    def test_a_groove_as_wide_as_the_ball(self, groove: Pocket) -> None:
        job = laid(groove, tools=("ball-6",))
        text, proof = made(job)
        assert failed(proof) == []
        assert operations(text) == ["groove: groove"]
        assert proof.unreachable_max_mm < 0.005
        simulation = cut(text, job)
        taken = -float(simulation.height[simulation.solid].sum()) * 0.2**2
        middle = 24 if groove.islands == () and groove.boundary.bounds[0] > -20 else 50
        length = math.tau * 11 if groove.islands else middle
        ends = 2 / 3 * math.pi * 27 + math.pi * 9 if middle == 24 and not groove.islands else 0.0
        assert taken == pytest.approx(length * (6 + math.pi / 2 * 9) + ends, rel=0.01)

    def test_a_cut_into_the_fillet_is_found(self) -> None:
        text, proof = made(laid(round_pocket(1.0), tools=("bull-6-r1",)))
        assert failed(proof) == []
        # A flat end mill on the same path, or one with a smaller corner, takes the fillet away.
        sharp = LIBRARY.get("bull-6-r1").model_copy(update={"corner_radius": 0.5})
        job = laid(round_pocket(1.0), tools=("bull-6-r1",), library=LIBRARY.extended((sharp,)))
        found = asked("gouge", text, job)
        assert not found.passed
        # √2 - 1 times what the radii differ, less what the path keeps off the wall.
        assert found.value == pytest.approx((math.sqrt(2) - 1) * 0.5, abs=3e-3)

    def test_a_fillet_that_stays_too_large_is_found(self) -> None:
        job = laid(round_pocket(1.0), tools=("bull-6-r1", "mill-4"))
        text, _ = made(job)
        low = text.replace("Z-4\n", "Z-3.98\n")
        assert "leftover" in failed(prove(low, job))

    def test_fillets_that_open_into_something_else_are_refused(self) -> None:
        beside = Pocket("slot", Loop.polygon([(10, -2), (20, -2), (20, 2), (10, 2)]), (), 0.0, 4.0)
        with pytest.raises(DesignError, match="pocket has a floor_radius and opens into slot"):
            laid(round_pocket(1.0), beside)
        through = Pocket("pocket", box(14, 9, 4), (), 0.0, THICK, 1.0)
        with pytest.raises(DesignError, match="goes through to the underside"):
            laid(through)
        bore = Bore("bore", (0.0, 0.0), 8.0, 4.0, THICK - 4)
        assert failed(made(laid(round_pocket(1.0), bore))[1]) == []

    @given(nose=st.floats(0, 3), radius=st.floats(0.1, 4), tip=st.floats(0, 4))
    def test_how_far_a_nose_stays_off_the_wall(self, nose: float, radius: float, tip: float) -> None:
        away = stay(nose, radius, tip)
        angle = np.linspace(math.pi, 1.5 * math.pi, 400)
        disc = np.array([away + nose, tip + nose]) + nose * np.column_stack((np.cos(angle), np.sin(angle)))
        low = disc[(disc < radius).all(axis=1)]
        assert (np.hypot(*(low - radius).T) <= radius + 1e-9).all()
        if radius > nose and tip < radius - nose:  # and not further than it must
            gap = np.hypot(*(disc - radius).T) - radius
            assert gap.max() == pytest.approx(0, abs=1e-3)

    def test_the_proof_sees_the_fillet_that_the_drawing_has(self) -> None:
        (fillet,) = fillets(laid(round_pocket(3.0)))
        assert fillet.floor == -4
        assert fillet.walls.length == pytest.approx(PERIMETER, rel=1e-3)
        assert fillet.solid(-1.0).is_empty
        wall = shapely.Polygon(POCKET.boundary.flatten())
        expected = wall.difference(wall.buffer(-3.0 * (1 - math.sin(math.pi / 3))))
        assert fillet.solid(-4 + 1.5).area == pytest.approx(expected.area, rel=1e-3)


PERIMETER = 2 * (28 + 18) - 8 * 4 + math.tau * 4


@settings(max_examples=3)
@given(
    diameter=st.floats(3.0, 8.0),
    share=st.one_of(st.floats(0.05, 0.6), st.just(1.0)),
    corner=st.floats(4.2, 5.5),
    wanted=st.booleans(),
    flat=st.sampled_from([None, "mill-4", "mill-6"]),
)
def test_random_round_mills(
    diameter: float, share: float, corner: float, wanted: bool, flat: str | None
) -> None:
    """Whatever the corner's radius, the proof passes, and next to the wall stands what the corner leaves."""
    nose = round(share * diameter / 2, 3)
    kind = ToolKind.BALL if share == 1.0 else ToolKind.BULL_NOSE
    data = CuttingData(cutting_speed=200, chip_load=0.03)
    tool = Tool(
        name="round",
        number=77,
        kind=kind,
        diameter=round(diameter, 3),
        flute_length=20,
        corner_radius=0 if kind is ToolKind.BALL else min(nose, 0.98 * round(diameter, 3) / 2),
        cutting={"aluminium": data},
    )
    pocket = Pocket("pocket", box(11, 8, corner), (), 0.0, 4.0, tool.nose if wanted else 0.0)
    tools = ("round",) if flat is None else ("round", flat)
    job = laid(pocket, tools=tools, library=LIBRARY.extended((tool,)))
    try:
        text, proof = made(job)
    except ToolError:
        assert flat is None
        return
    assert failed(proof) == []
    simulation = cut(text, job, 0.3)
    region = shapely.Polygon(pocket.boundary.flatten())
    assert simulation.gouge(shapely.box(*job.stock).difference(region), -3.9) <= 0.005
    if wanted:
        assert proof.unreachable_max_mm < 0.01
        middle = region.buffer(-tool.nose - 0.01)
        assert len(simulation.left(middle, -3.989)) == 0
        foot = region.difference(region.buffer(-tool.nose * 0.2))
        # At a fifth of the radius from the wall the fillet is 0.4 of it high.
        high = -4 + 0.39 * tool.nose
        whole = int(shapely.contains_xy(foot, *np.meshgrid(simulation.x, simulation.y)).sum())
        assert len(simulation.left(foot, high)) == whole


class TestRemarks:
    """Findings and figures."""

    def found(self, *tools: str, pocket: Pocket = POCKET) -> list[tuple[str, str]]:
        part = Part("plate", Outline(PLATE), THICK, "aluminium", machined=(pocket,))
        wanted = CamSettings.model_validate({"tools": tools, "stock": {"margin": 0}})
        return [
            (f.code, f.message) for f in lay_out(part, wanted, LIBRARY)[1] if f.severity is not Severity.ERROR
        ]

    def test_a_tool_without_work_is_named(self) -> None:
        (found,) = self.found("ball-6", "mill-6")
        assert found[0] == "cam.tool-unused"
        assert "ball-6 has nothing to do" in found[1]
        assert "no floor has a fillet of 3 mm" in found[1]
        assert self.found("bull-6-r1", "mill-6") == []
        idle = self.found("mill-8", "mill-6")  # corners of 4 mm are for the larger one
        assert idle == [("cam.tool-unused", "mill-6 has nothing to do in plate: the others reach as far")]

    def test_a_fillet_that_nobody_asked_for_is_told(self) -> None:
        (found,) = self.found("bull-6-r1")
        assert found == (
            "cam.unreachable",
            "bull-6-r1 leaves a fillet of 1 mm at the foot of pocket of plate",
        )
        assert self.found("bull-6-r1", pocket=round_pocket(1.0)) == []

    def test_plunging_needs_a_centre(self) -> None:
        job = laid(POCKET, tools=("ball-6",))
        text = "G17 G21 G40 G49 G80 G90 G94\nG53 G0 Z0\nT49 M6\nG54 S10000 M3\nG0 X0 Y0\nG43 H49 Z5\nM8\n"
        text += "G1 Z-2 F100\nG0 Z5\nM9\nM5\nG53 G0 Z0\nM30\n"
        assert asked("entries", text, job).passed
        hollow = LIBRARY.get("ball-6").model_copy(update={"centre_cutting": False})
        other = laid(POCKET, tools=("ball-6",), library=LIBRARY.extended((hollow,)))
        assert not asked("entries", text, other).passed

    def test_shallow_cuts_of_a_round_corner_are_fed_faster(self) -> None:
        shallow = Pocket("pocket", box(14, 9, 4), (), 0.0, 0.3)
        fast, slow = (
            Counter(
                m.feed
                for m in read(
                    made(laid(shallow, tools=("bull-6-r1",), chip_thinning=thin, floor_to_leave=0))[0]
                )
            )
            for thin in (True, False)
        )
        # Most moves are of clearing; those of finishing have an engagement that makes chips half as thick once more.
        roughing, usual = (feeds.most_common(1)[0][0] for feeds in (fast, slow))
        assert roughing / usual == pytest.approx(1 / math.sqrt(1 - 0.7**2), rel=2e-3)
        assert max(fast) == 2 * roughing
