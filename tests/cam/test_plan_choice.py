import math
import re

import pytest
import shapely
from by_night import examples
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from planning_parts import LIBRARY, bore, keyed_bore, lobes, part, plate
from planning_simulation import check_rules, gouge, leftover

from mechwright.contracts.finding import Severity
from mechwright.errors import DesignError, MechwrightError, ToolError
from mechwright.geometry import Loop
from mechwright_cam.operations.choice import roomy_mills
from mechwright_cam.operations.recess import without_skin
from mechwright_cam.planning import choose_tools, lay_out, plan
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import ToolKind
from mechwright_plane.reach import closing, remainder


def names(of, **changes):
    return [tool.name for tool in choose_tools(of, CamSettings.model_validate(changes), LIBRARY)]


def test_closing_of_a_square_corner():
    corner = shapely.Polygon([(0, 0), (20, 0), (20, 5), (5, 5), (5, 20), (0, 20)])
    for radius in (0.5, 3.0, 6.0):
        assert closing(corner, radius).area - corner.area == pytest.approx(
            (1 - math.pi / 4) * radius**2, rel=1e-3, abs=1e-3
        )
        assert remainder(corner, radius) == pytest.approx((math.sqrt(2) - 1) * radius, abs=3e-4)


def test_mills_with_room_are_at_most_seven_tenths_of_the_width_or_leave_the_allowance():
    mills = [tool for tool in LIBRARY.tools if tool.kind is ToolKind.END_MILL and tool.nose == 0]
    mills.sort(key=lambda mill: -mill.diameter)
    for width in (1.2, 4.0, 6.0, 10.0, 17.5):
        slot = shapely.box(0, 0, 3 * width, width)
        more = shapely.MultiPolygon([slot, shapely.box(90, 0, 90.5, 9)])
        for allowance in (0.2, 0.5):
            room = [m for m in mills if m.diameter <= max(0.7 * width, width - 2 * allowance)]
            assert roomy_mills(mills, slot, allowance) == (room or mills[-1:])
            assert roomy_mills(mills, more, allowance) == (room or mills[-1:])


def test_a_recess_that_ends_at_the_edge_leaves_no_skin():
    sharp = shapely.Polygon([(0, 0), (30, 0), (0, 0.01)])
    keep = shapely.union_all([shapely.box(0, -9, 30, 0), sharp, shapely.box(0, 5, 30, 5 + 1e-5)])
    for looked_at in (False, True):
        left = without_skin(keep, looked_at=looked_at)
        assert left.bounds[3] <= 0.011
        assert left.area == pytest.approx(270, abs=0.2)


def test_remainder_in_a_round_fillet():
    # A fillet of radius f keeps (sqrt 2 - 1)(r - f) from a larger cutter, nothing from a smaller one.
    big = shapely.box(0, 0, 30, 30).difference(
        shapely.box(10, 10, 40, 40).buffer(-2).buffer(2, quad_segs=400)
    )
    assert remainder(big, 1.9) < 0.001
    assert remainder(big, 3.0) == pytest.approx(math.sqrt(2) - 1, abs=1e-3)


def test_named_tools_are_exactly_those():
    assert names(plate(), tools=["mill-6", "spot-6"]) == ["mill-6", "spot-6"]
    with pytest.raises(ToolError, match=r"no tool 'mill-7' in the library; did you mean"):
        names(plate(), tools=["mill-7"])
    with pytest.raises(DesignError, match="listed twice"):
        names(plate(), tools=["mill-6", "mill-6"])


def test_choice_by_corners_and_thickness():
    assert names(plate()) == ["mill-6"]
    assert names(plate(bore(12))) == ["mill-6"]
    assert names(plate(bore(12), material="steel")) == ["spot-6", "drill-10", "mill-6"]
    small = part(lobes(9, 18.0, 4.0, 900, 1.5), bore(8))
    chosen = choose_tools(small, CamSettings(), LIBRARY)
    assert all(t.flute_length >= 6.3 for t in chosen if t.kind is ToolKind.END_MILL)
    # The square corner of a keyway asks for a small mill, but not for the smallest: none leaves it clean.
    keyed = plate(keyed_bore(14, 5, 16.3))
    assert names(keyed)[-1] == "mill-2"
    assert names(keyed, corner_mill=3)[-1] == "mill-3"
    assert names(keyed, corner_mill=0.1)[-1] == "mill-1.2"
    assert names(plate(keyed_bore(14, 5, 16.3), thickness=10), corner_mill=0.1)[-1] == "mill-1.5"
    # A narrow place is no corner: what fits in goes in.
    assert names(plate(keyed_bore(14, 1.3, 16.3)))[-1] == "mill-1.2"
    with pytest.raises(ToolError, match="flute length"):
        names(plate(thickness=60))


def test_findings():
    assert lay_out(plate(bore(12)), CamSettings(), LIBRARY)[1] == []
    narrow = plate(Loop.polygon([(-10, -1), (-10, 1), (10, 1), (10, -1)]))
    for of, changes, code, parameter in (
        (plate(bore(3)), {"tools": ["mill-6"]}, "cam.cannot-cut", "cam.tools"),
        (narrow, {"tools": ["mill-6"]}, "cam.cannot-cut", "cam.tools"),
        (plate(thickness=60), {}, "cam.too-deep", "cam.tools"),
        (plate(), {"tools": ["mill-99"]}, "cam.cannot-cut", "cam.tools"),
        (plate(), {"stock": {"margin": 1}}, "cam.cannot-cut", "cam.stock"),
        (plate(), {"hold": {"method": "bore"}}, "cam.cannot-cut", "cam.hold.method"),
        (
            plate(),
            {"tools": ["mill-6"], "machine": {"spindle_min": 11900}},
            "cam.too-fast",
            "cam.machine.spindle_min",
        ),
        (plate(), {"machine": {"max_feed": 200}}, "cam.rubbing", "cam.machine.max_feed"),
        (
            plate(),
            {"tools": ["mill-6"], "machine": {"max_feed": 600, "spindle_min": 11000}},
            "cam.rubbing",
            "cam.machine.max_feed",
        ),
        (narrow, {}, "cam.unreachable", "cam.tools"),
        (plate(bore(3), thickness=12), {"tools": ["mill-2", "mill-6"]}, "cam.cannot-cut", "cam.tools"),
    ):
        found = lay_out(of, CamSettings.model_validate(changes), LIBRARY)[1]
        assert (code, parameter) in [(f.code, f.parameter) for f in found], (changes, found)
        if code == "cam.cannot-cut":
            assert [f.severity for f in found if f.code == code] == [Severity.ERROR]
    note = lay_out(plate(thickness=10), CamSettings(tools=("mill-1.6",)), LIBRARY)[1]
    assert [f.code for f in note] == ["cam.better-process", "cam.slender"]


@settings(max_examples=examples(1, 40), deadline=None, suppress_health_check=list(HealthCheck))
@given(
    count=st.integers(3, 12),
    radius=st.floats(8, 30),
    depth=st.floats(0.2, 5),
    sharpness=st.sampled_from([0.0, 1.0, 2.0]),
    hole=st.one_of(st.none(), st.floats(1.5, 12)),
    thickness=st.floats(1, 12),
    named=st.one_of(
        st.just([]), st.lists(st.sampled_from([t.name for t in LIBRARY]), min_size=1, max_size=5, unique=True)
    ),
    method=st.sampled_from(["tabs", "bore"]),
    allowance=st.sampled_from([0.0, 0.03, 0.2, 1.0]),
    margin=st.sampled_from([None, 0.0, 3.0, 12.0]),
    climb=st.booleans(),
)
def test_any_part_is_cut_or_refused(
    count, radius, depth, sharpness, hole, thickness, named, method, allowance, margin, climb
):
    of = part(
        lobes(count, radius, depth, 400, sharpness), *([bore(hole)] if hole else []), thickness=thickness
    )
    wanted = CamSettings.model_validate(
        {
            "tools": named,
            "hold": {"method": method, "clamp_diameter": 6, "tab_height": 0.8},
            "stock": {"margin": margin},
            "stock_to_leave": allowance,
            "climb": climb,
        }
    )
    try:
        job = make_job(of, wanted, choose_tools(of, wanted, LIBRARY))
        program = plan(job)
    except MechwrightError as error:
        assert re.fullmatch(r"cam\.[a-z_.]+: .*", str(error)), error  # noqa: PT017 - either way is right
        return
    assert gouge(job, program) <= 0.005
    assert leftover(job, program) == 0
    check_rules(job, program)
    if not named:  # every cutter that was chosen has something to do
        assert "cam.tool-unused" not in [f.code for f in lay_out(of, wanted, LIBRARY)[1]]


@pytest.mark.parametrize("method", ["tabs", "bore"])
@pytest.mark.parametrize("margin", [None, 0.0, 4.0, 9.0, 14.0])
def test_every_mill_that_is_chosen_is_used(method, margin):
    of = part(lobes(9, 30.0, 6.0, 400, 1.5), bore(12), thickness=6)
    wanted = CamSettings.model_validate({"hold": {"method": method}, "stock": {"margin": margin}})
    if margin == 0.0 and method == "tabs":
        with pytest.raises(DesignError, match="no frame"):
            choose_tools(of, wanted, LIBRARY)
        return
    job, found = lay_out(of, wanted, LIBRARY)
    assert "cam.tool-unused" not in [finding.code for finding in found]
    assert {section.tool.name for section in plan(job).sections} == {tool.name for tool in job.tools}


def test_a_mill_too_wide_for_the_frame_is_not_used():
    of = part(lobes(3, 8.0, 1.0, 400), thickness=2)
    wanted = CamSettings.model_validate({"tools": ["mill-16", "mill-2.5"], "stock": {"margin": 12}})
    job = make_job(of, wanted, choose_tools(of, wanted, LIBRARY))
    program = plan(job)
    assert [section.tool.name for section in program.sections] == ["mill-2.5"]
    assert leftover(job, program) == 0


@pytest.mark.parametrize(
    ("material", "slowest", "expected"),
    [
        ("aluminium", 100, ["alu-5"]),
        ("aluminium", 5000, ["alu-5"]),
        ("steel", 5000, ["mill-5"]),  # 90 m/min: mills up to 5.7 mm, drills of 28 m/min up to 1.8 mm
    ],
)
def test_cutters_that_the_slowest_speed_overspeeds_are_not_chosen(material, slowest, expected):
    of = plate(bore(8), material=material)
    settings = CamSettings.model_validate({"machine": {"spindle_min": slowest, "spindle_max": 24000}})
    job, found = lay_out(of, settings, LIBRARY)
    assert job is not None
    assert [tool.name for tool in job.tools] == expected
    assert "cam.too-fast" not in {finding.code for finding in found}
    assert plan(job).sections


def test_one_that_runs_too_fast_is_chosen_where_no_other_does_the_work():
    """Of the mills that steel lets run at 9000 rev/min none is longer than 16 mm."""
    settings = CamSettings.model_validate({"machine": {"spindle_min": 9000, "spindle_max": 24000}})
    job, found = lay_out(plate(thickness=18, material="steel"), settings, LIBRARY)
    assert job is not None
    assert "cam.too-fast" in {finding.code for finding in found}
