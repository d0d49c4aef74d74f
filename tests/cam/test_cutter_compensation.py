"""Planned cutter compensation: contour, leads, tabs, D offsets, and what the proof and LinuxCNC make of it."""

import math
import re

import numpy as np
import pytest
import shapely
from by_control import BY_NAME, asked, posted, prove, read
from by_night import examples
from golden_compensation import WAYS
from hypothesis import event, given, settings
from hypothesis import strategies as st
from planning_parts import LIBRARY, bore, job, keyed_bore, part, plate
from rounded_polygons import plates

from mechwright.errors import MechwrightError, ProgramError, ToolError
from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.reading import Kind
from mechwright_cam.operations.entry import bore_lead, enters, lead_to, offsets_of
from mechwright_cam.planning import plan
from mechwright_cam.program.moves import Rapid
from mechwright_cam.proof.paths import Paths, Pieces
from mechwright_cam.setup.job import LEAST_TURN, Job
from mechwright_cam.shop.settings import CamSettings
from mechwright_plane.contour import offset_contour
from mechwright_plane.offsets import BIAS, FIT, grow, rings

TABS = {"method": "tabs", "tabs": 2}


def sample(way: str, **more: object) -> Job:
    """A plate with a bore, its outside held by tabs."""
    return job(plate(bore(14.0)), "mill-6", **{"compensation": way, "hold": TABS, **more})


def text_of(one: Job, control: str = "linuxcnc") -> str:
    return posted(one, control=host().get(Control, control))


def reader(control: str = "linuxcnc"):
    return BY_NAME[control]


def contours(text: str, one: Job, more: float = 0.0) -> shapely.Geometry:
    """The ways of the cutter's centre with compensation on, leads aside."""
    run = read(text, one, reader(), more)
    on = np.array([state.side != 0 for state in run.states])[run.state]
    steps = np.flatnonzero(on & np.isin(run.kind, (Kind.FEED, Kind.ARC)))
    paths = Paths(run, one.tools)
    zeros = np.zeros(steps.size)
    ways: shapely.Geometry = shapely.geometrycollections(paths.lines(Pieces(steps, zeros, zeros + 1, zeros)))
    return ways


# -- walls follow D -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("more", [-0.1, -0.03, 0.0, 0.1])
def test_the_wall_moves_by_just_what_d_says(way: str, more: float) -> None:
    """The nearest that the cutter's edge comes to the part, all around, is what D is larger by."""
    one = sample(way)
    wall = shapely.get_coordinates(shapely.segmentize(one.target.exterior, 0.5))
    apart = shapely.distance(contours(text_of(one), one, more), shapely.points(wall)) - 3.0
    np.testing.assert_allclose(apart, more, atol=0.005)


@pytest.mark.parametrize("way", WAYS)
def test_a_bore_grows_by_twice_what_d_is_smaller(way: str) -> None:
    one = sample(way)
    text = text_of(one)
    for more in (-0.1, 0.0, 0.1):
        reach = np.hypot(*shapely.get_coordinates(contours(text, one, more)).T)
        widest = reach[reach < 10].max() + 3.0
        assert 2 * widest == pytest.approx(14.0 - 2 * more, abs=0.004)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("climb", [True, False])
def test_the_proof_passes_and_says_what_it_has_seen(way: str, climb: bool) -> None:
    one = sample(way, climb=climb)
    text = text_of(one)
    assert ("G41" in text) == climb
    assert ("G42" in text) != climb
    proof = prove(text, one, reader())
    proof.require()
    assert "from 0.1 mm below to 0.1 mm above" in proof.checks["compensation"].message
    assert proof.checks["compensation"].value < 0.001


def test_without_compensation_nothing_changes() -> None:
    text = text_of(sample("computer"))
    assert not re.search(r"G4[12]|D\d", re.sub(r"\(.*\)", "", text))
    assert asked("compensation", text, sample("computer"), reader()).passed


def test_a_repeated_pass_begins_without_a_lift_where_its_leads_meet_nothing() -> None:
    """Once down and once up for each wall, however often it goes around."""
    lifts = []
    for passes in (0, 2):
        sections = plan(sample("control", spring_passes=passes)).sections
        finished = [one for s in sections for one in s.operations if one.name.endswith("finish")]
        lifts.append([sum(isinstance(m, Rapid) and m.z is not None for m in one.moves) for one in finished])
    assert lifts == [[2, 2, 2]] * 2


# -- the proof does not trust the plan ----------------------------------------------------------------------


def test_a_d_that_the_entry_is_too_short_for_fails() -> None:
    text = text_of(sample("control", wear_limit=0.1))
    check = asked("compensation", text, sample("control", wear_limit=0.5), reader())
    assert not check.passed
    assert "with D 0.5 mm larger: line" in check.message


def test_the_wrong_side_fails() -> None:
    one = sample("control")
    proof = prove(text_of(one).replace("G41", "G42"), one, reader())
    assert not proof.ok


def test_a_wall_without_compensation_among_others_is_not_taken_for_one_that_follows() -> None:
    """A lead that is not tangential moves the contour's beginning by something else than D."""
    one = sample("wear")
    lines = text_of(one).splitlines()
    at = next(i for i, line in enumerate(lines) if "G41" in line)
    x, y = (float(v) for v in re.findall(r"[XY](-?[\d.]+)", lines[at]))
    lines[at] = re.sub(r"X.*Y\S+", f"X{x + 0.4:.4f} Y{y - 0.3:.4f}", lines[at])
    try:
        proof = prove("\n".join(lines), one, reader())
    except ProgramError:
        return
    assert not proof.ok


def test_an_inside_arc_as_narrow_as_the_planned_d_fails() -> None:
    """The planned cutter just passes; one that is 0.1 mm larger, as D may be, would not."""
    one = sample("control")
    text = (
        "G17 G21 G40 G49 G80 G90 G94\nG54\nT24 M6\nS3000 M3\nG0 X-60 Y40\nG43 H24 Z5\nM8\nZ1\nG1 Z0.5 F100\n"
        "G41 D24 X-50 Y40\nX-40\nG3 X-36.96 Y43.04 I0 J3.04\nG1 Y60\nG40 Y70\nG0 Z5\nM9\nM5\nG53 G0 Z0\nM30\n"
    )
    check = asked("compensation", text, one, reader())
    assert not check.passed
    assert (
        "with D 0.1 mm larger: line 12: the tool of radius 3.1 mm does not fit into an arc" in check.message
    )


# -- leads --------------------------------------------------------------------------------------------------


@given(st.floats(1.0, 8.0), st.floats(1.0, 8.0), st.floats(0.0, 1.0))
@settings(max_examples=50)
def test_a_lead_is_tangential_and_starts_at_its_height(radius: float, straight: float, share: float) -> None:
    lead = lead_to(radius, straight, share * radius)
    assert lead is not None
    assert lead.start[1] == pytest.approx(share * radius, abs=1e-9)
    line = np.subtract(lead.turn, lead.start)
    assert np.hypot(*line) == pytest.approx(straight)
    spoke = np.subtract(lead.turn, (0.0, radius))
    assert np.hypot(*spoke) == pytest.approx(radius)
    assert line @ spoke == pytest.approx(0.0, abs=1e-9)


@given(st.floats(0.2, 3.5), st.floats(4.0, 40.0))
@settings(max_examples=50)
def test_the_lead_of_a_bore_starts_on_the_line_of_the_middles(least: float, contour: float) -> None:
    tool = LIBRARY.get("mill-6")
    way = "wear" if least < 3 else "control"
    offsets = offsets_of(tool, CamSettings(compensation=way, wear_limit=min(least, 0.5)))
    lead = bore_lead(offsets, contour)
    assert lead.start[0] == pytest.approx(0.0, abs=1e-9)
    assert lead.straight >= offsets.most
    assert lead.radius >= offsets.most


@pytest.mark.parametrize("way", WAYS)
def test_every_entry_is_straight_longer_than_any_d_and_tangential(way: str) -> None:
    one = sample(way)
    lines = [re.sub(r"\(.*?\)", "", line) for line in text_of(one).splitlines()]
    place: tuple[float, float] = (math.nan, math.nan)
    entries = 0
    for number, line in enumerate(lines):
        before = place
        words = dict(re.findall(r"([XYIJ])(-?[\d.]+)", line))
        place = float(words.get("X", place[0])), float(words.get("Y", place[1]))
        if "G41" in line:
            entries += 1
            assert math.dist(before, place) > (3.1 if way == "control" else 0.1)
            arc = dict(re.findall(r"([XYIJ])(-?[\d.]+)", lines[number + 1]))
            spoke = np.array([float(arc["I"]), float(arc["J"])])
            entry = np.subtract(place, before)
            assert abs(entry @ spoke) / np.hypot(*entry) / np.hypot(*spoke) < 2e-3
    assert entries >= 4


def test_a_bore_that_leaves_no_room_is_refused_or_gets_a_smaller_mill() -> None:
    mill = LIBRARY.get("mill-6")
    assert enters(mill, 9.0, CamSettings())
    assert not enters(mill, 9.0, CamSettings(compensation="control"))
    assert enters(mill, 9.0, CamSettings(compensation="wear"))
    with pytest.raises(ToolError, match=r"cam\.compensation: no listed end mill has room in bore-1 of 9 mm"):
        plan(job(plate(bore(9.0)), "mill-6", compensation="control"))
    both = plan(job(plate(bore(9.0)), "mill-6", "mill-4", compensation="control"))
    assert {"mill-4"} == {
        section.tool.name
        for section in both.sections
        for operation in section.operations
        if operation.name == "bore-1: finish"
    }


def test_a_recess_without_room_for_an_entry_is_refused_by_name() -> None:
    with pytest.raises(ToolError, match=r'no room for a straight entry of 3\.20 mm.*opening-1.*"wear"'):
        plan(job(plate(keyed_bore(11, 7, 12.5)), "mill-6", compensation="control", hold=TABS))


def test_a_wear_as_large_as_the_cutter_is_refused() -> None:
    with pytest.raises(ToolError, match=r"cam\.wear_limit: 1 mm is too much for mill-2"):
        plan(job(plate(), "mill-2", compensation="wear", wear_limit=1.0, hold=TABS))


# -- random plates ------------------------------------------------------------------------------------------


@given(
    plates(),
    st.sampled_from(WAYS),
    st.sampled_from(["mill-6", "mill-3"]),
    st.sampled_from([0.02, 0.1, 0.2]),
    st.booleans(),
    st.sampled_from(["linuxcnc", "fanuc"]),
)
@settings(max_examples=examples(2, 20))
def test_random_plates_are_proven_or_refused(loop, way, mill, wear, climb, control) -> None:
    """Corners of both kinds, sharp or round, narrower than the cutter or not."""
    try:
        one = job(
            part(loop, bore(12.0)),
            *("mill-6", "mill-3")[:: 1 if mill == "mill-3" else -1],
            compensation=way,
            wear_limit=wear,
            climb=climb,
            control=control,
            hold=TABS,
        )
        text = text_of(one, control)
    except MechwrightError as error:
        event(f"refused: {str(error)[:40]}")
        return
    event("proven")
    prove(text, one, reader(control)).require()


@given(plates(), st.sampled_from([(3.0, 0.0), (3.0, 3.0), (1.5, 0.0)]), st.sampled_from([1, -1]))
@settings(max_examples=examples(6, 30))
def test_a_contour_is_the_parallel_of_its_ring(loop, sizes: tuple[float, float], side: int) -> None:
    """Moved back by the inset, it is the ring again, all along; and no inside arc is narrower than that."""
    radius, base = sizes
    reach = radius + 0.15
    ring = max(rings(grow(shapely.Polygon(loop.flatten()), reach + BIAS), side > 0), key=len)
    path = offset_contour(ring, reach - base, side, FIT, LEAST_TURN)
    assert path.closed
    here = path.start
    for cut in path.cuts:
        if cut.turn == side and cut.length > 0.05:
            assert math.hypot(here[0] - cut.cx, here[1] - cut.cy) > reach - base - 0.003
        here = (cut.x, cut.y)
    gap = shapely.distance(shapely.LineString(ring), shapely.points(path.points(0.5)))
    assert np.abs(gap - (reach - base)).max() < FIT + 0.003 + 0.001
