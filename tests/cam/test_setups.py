"""The second side: which features are on it, how the plate lies then, and that both programs are proven."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import shapely
from by_control import BY_NAME, asked, interpret
from by_night import examples, thinned
from hypothesis import given, settings
from hypothesis import strategies as st
from planning_parts import LIBRARY, bore, rounded_box
from plate_shapes import many_spans, wavy

from mechwright.contracts.finding import errors
from mechwright.contracts.part import Bore, OpenProfile, Part, Pocket, Profile
from mechwright.errors import DesignError
from mechwright.geometry import Line, Outline
from mechwright.geometry.mirror import turned_over, turned_point
from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import machine, second_setup
from mechwright_cam.planning.setups import lay_out_setups, turned_shape
from mechwright_cam.setup.sides import sides
from mechwright_cam.setup.views import inside_of
from mechwright_cam.shop.settings import CamSettings

THICKNESS = 8.0
HOLE = Bore("bore", (0.0, 0.0), 10.0, 0.0, THICKNESS)
OUTSIDE = Profile("outside", rounded_box(60, 40, 6), "outside", 0.0, THICKNESS)
COUNTERBORE = Bore("counterbore", (0.0, 0.0), 16.0, 5.0, 3.0)
CORNER = Pocket("mark", rounded_box(8, 6, 3).moved(20.0, 10.0), (), 6.0, 2.0)


def part(*features, name="bracket"):
    outline = Outline(rounded_box(60, 40, 6), (bore(10.0),))
    return Part(name, outline, THICKNESS, "aluminium", machined=(HOLE, *features, OUTSIDE))


def cam(**changes):
    tools = ("spot-6", "drill-8", "mill-6", "mill-4")
    return CamSettings.model_validate({"tools": tools, **changes})


# -- turning over -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("about", ["x", "y"])
@pytest.mark.parametrize("loop", [wavy(), many_spans(), rounded_box(30, 20, 4).moved(7, -3)])
def test_a_loop_turned_over_is_its_mirror_image(loop, about) -> None:
    over = turned_over(loop, about)
    sign = np.array((1, -1) if about == "x" else (-1, 1))
    mirrored = shapely.Polygon(loop.flatten() * sign)
    assert shapely.Polygon(over.flatten()).symmetric_difference(mirrored).area < 1e-2
    assert over.area == pytest.approx(loop.area, rel=1e-12)
    back = turned_over(over, about)
    assert np.abs(back.flatten() - loop.flatten()).max() < 1e-9 or back.area == pytest.approx(loop.area)
    assert turned_point(turned_point((3.0, 4.0), about), about) == (3.0, 4.0)


# -- which side a feature is on -----------------------------------------------------------------------------

STEP = Bore("step", (0.0, 0.0), 8.0, 5.0, 3.0)
WIDE = Bore("wide", (0.0, 0.0), 12.0, 0.0, 5.0)


@pytest.mark.parametrize(
    ("features", "under"),
    [
        ((), []),
        ((COUNTERBORE,), ["counterbore"]),
        ((COUNTERBORE, CORNER), ["counterbore", "mark"]),
        ((replace(CORNER, top=0.0),), []),
    ],
)
def test_underside_features_are_told_by_their_heights(features, under) -> None:
    upper, below = sides(part(*features))
    assert [feature.name for feature in below] == under
    assert {f.name for f in upper} | {f.name for f in below} == {f.name for f in part(*features).features}


def test_the_narrow_part_of_a_stepped_bore_is_cut_from_above() -> None:
    stepped = replace(part(), machined=(WIDE, STEP, OUTSIDE))
    assert sides(stepped)[1] == ()
    upside_down = replace(part(), machined=(replace(WIDE, top=3.0), replace(STEP, top=0.0), OUTSIDE))
    assert [f.name for f in sides(upside_down)[1]] == ["wide"]


def test_a_hollow_inside_the_plate_is_refused() -> None:
    hollow = part(Pocket("hollow", rounded_box(8, 6, 3).moved(20, 10), (), 3.0, 2.0))
    with pytest.raises(DesignError, match="hollow starts 3 mm below the top, is 2 mm deep, and closed"):
        sides(hollow)
    jobs, found = lay_out_setups(hollow, cam(), LIBRARY)
    assert jobs == []
    assert [f.code for f in errors(found)] == ["cam.second-side"]


# -- both setups --------------------------------------------------------------------------------------------


@cache
def counterbored():
    """Both sides of the part with a counterbore."""
    return both(part(COUNTERBORE))


def both(made_part, control="linuxcnc", **changes):
    jobs, found = lay_out_setups(made_part, cam(control=control, **changes), LIBRARY)
    assert not errors(found), found
    assert [job.side for job in jobs] == ["top", "underside"]
    post = host().get(Control, control)
    first = machine(jobs[0], post)
    return first, machine(second_setup(first, jobs[1]), post)


@pytest.mark.parametrize(
    ("locate", "flip", "origin"), [("bore", "x", "axis"), ("edges", "y", "corner"), ("dowels", "y", "axis")]
)
def test_both_sides_are_proven(locate, flip, origin) -> None:
    first, second = both(
        part(COUNTERBORE, CORNER), origin=origin, second_side={"locate": locate, "flip": flip}
    )
    assert first.proof.ok
    assert second.proof.ok
    assert second.job.settings.work_offset == "G55"
    assert second.program.name == "bracket-underside"
    run = interpret(second.text)
    assert {run.states[i].work_offset for i in run.state[run.cutting]} == {"G55"}
    # The mark is where it is seen from below.
    x, y = turned_point((20.0, 10.0), flip)
    x, y = x - second.job.origin[0], y - second.job.origin[1]
    near = run.cutting & (np.hypot(run.end[:, 0] - x, run.end[:, 1] - y) < 4)
    assert run.end[near, 2].min() == -2.0
    # The same plate, turned over.
    assert second.job.stock == pytest.approx(
        turned_shape(shapely.box(*first.job.stock), first.job, second.job).bounds, abs=1e-9
    )


def test_what_the_first_side_has_cut_is_gone_from_the_second() -> None:
    first, second = counterbored()
    gone = second.job.air_below(0.0)
    x, y = -second.job.origin[0], -second.job.origin[1]
    assert gone.contains(shapely.Point(x, y))  # the bore
    assert not gone.contains(shapely.Point(x + 6.0, y))
    assert gone.contains(shapely.Point(x + 33.0, y + 10))  # the channel
    # It is what was cut, no more: the finished part and its tabs are not in it.
    target = turned_shape(first.job.target, first.job, second.job)
    assert gone.intersection(target).area < 0.5
    for tab in first.job.tabs:
        assert gone.intersection(turned_shape(tab.shape, first.job, second.job)).area < 0.5
    # A rapid down the bore is none into stock there; without what the first side left it would be.
    text = second.text.replace(
        "M30\n",
        f"G54\nG55\nG0 X{x:g} Y{y:g}\nG43 H{second.program.sections[-1].tool.number} Z5\nG0 Z-7\nG53 G0 Z0\nM30\n",
    )
    assert asked("rapids-in-stock", text, second.job).passed
    assert not asked("rapids-in-stock", text, replace(second.job, gone=())).passed


def test_dowels_stand_on_the_flip_axis_and_fit_both_sides() -> None:
    first, second = both(part(COUNTERBORE), second_side={"locate": "dowels", "dowel_diameter": 8.0})
    dowels = [f for f in first.job.features if f.name.startswith("dowel")]
    assert len(dowels) == 2
    for dowel in dowels:
        assert dowel.diameter == 8.0
        assert dowel.centre[1] == -first.job.origin[1]
        hole = turned_shape(shapely.Point(dowel.centre).buffer(3.9), first.job, second.job)
        assert second.job.air_below(0.0).contains(hole)
        assert not first.job.target.intersects(shapely.Point(dowel.centre).buffer(4.0))
        # Turned over it is where it was.
        at = shapely.Point(turned_shape(shapely.Point(dowel.centre), first.job, second.job))
        assert (at.x, at.y) == pytest.approx(dowel.centre)


@pytest.mark.parametrize(
    ("changes", "code", "words"),
    [
        ({"second_side": {"work_offset": "G54"}}, "cam.second-side", "is the first side's"),
        ({"hold": {"method": "bore", "clamp_diameter": 12}}, "cam.second-side", "would be loose by then"),
        (
            {"stock": {"margin": 12}, "second_side": {"locate": "dowels"}},
            "cam.second-side",
            "take a larger plate",
        ),
    ],
)
def test_what_cannot_be_is_refused(changes, code, words) -> None:
    jobs, found = lay_out_setups(part(COUNTERBORE), cam(**changes), LIBRARY)
    assert jobs == []
    (finding,) = errors(found)
    assert finding.code == code
    assert words in finding.message
    assert finding.parameter.startswith("cam.")


def test_a_part_without_a_bore_cannot_be_picked_up_by_it() -> None:
    blank = replace(part(), outline=Outline(rounded_box(60, 40, 6)), machined=(CORNER, OUTSIDE))
    jobs, found = lay_out_setups(blank, cam(), LIBRARY)
    assert jobs == []
    assert "has no bore" in errors(found)[0].message
    jobs, found = lay_out_setups(blank, cam(second_side={"locate": "edges"}), LIBRARY)
    assert len(jobs) == 2


STEP_BELOW = OpenProfile("step", 5.0, 3.0, path=(Line((-40.0, 12.0), (40.0, 12.0)),), side="left", width=12.0)


GROOVE_BELOW = Pocket("groove", rounded_box(10, 60, 3).moved(24, 0), (), 6.0, 2.0)


@pytest.mark.parametrize(("feature", "tabs"), thinned(2, [GROOVE_BELOW, STEP_BELOW], [2, 3, 4, 7]))
def test_tabs_stay_clear_of_what_is_cut_from_below(feature, tabs) -> None:
    first, second = both(part(feature), hold={"tabs": tabs})
    assert len(first.job.tabs) == tabs
    for tab in first.job.tabs:
        below = turned_shape(tab.shape, first.job, second.job)
        assert not any(shapely.intersects(inside_of(one), below) for one in second.job.features)
    # They hold it from more than one side.
    middle = shapely.MultiPoint([tab.at for tab in first.job.tabs])
    assert tabs < 3 or middle.convex_hull.area > 0.1 * first.job.target.area


OVER_THE_RIM = {
    "step": STEP_BELOW,
    "groove": OpenProfile("groove", 5.0, 3.0, path=(Line((-40.0, 8.0), (40.0, 8.0)),), side="on", width=7.0),
    "mouth": Pocket("mouth", rounded_box(30, 14, 3).moved(30.0, 6.0), (), 5.0, 3.0),
}


@pytest.mark.parametrize(("name", "locate"), thinned(2, [*OVER_THE_RIM], ["dowels", "edges"]))
def test_a_recess_over_the_rim_is_open_into_the_frame(name, locate) -> None:
    feature = OVER_THE_RIM[name]
    wanted = CamSettings.model_validate({"second_side": {"locate": locate, "flip": "y"}})
    jobs, found = lay_out_setups(part(feature), wanted, LIBRARY)
    # No corner of it is one: those drawn out in the frame are no walls, and no fine mill is taken for them.
    assert not [f for f in found if f.code == "cam.unreachable"]
    assert min(mill.diameter for mill in jobs[1].mills) >= 4.0
    first = machine(jobs[0], host().get(Control, "linuxcnc"))
    second = machine(second_setup(first, jobs[1]), host().get(Control, "linuxcnc"))
    assert second.proof.unreachable_max_mm < 0.01
    # The cutter runs out over the rim, and no further into the frame than it needs.
    run, mill = interpret(second.text), second.program.sections[-1].tool
    drawn = shapely.intersection(inside_of(second.job.features[0]), second.job.body)
    ends = shapely.points(run.end[run.cutting & (run.end[:, 2] < 0), :2])
    assert shapely.distance(ends, second.job.body).max() > 0.9 * mill.radius
    assert shapely.distance(ends, drawn).max() < 1.5 * mill.diameter


def test_the_proof_knows_how_much_of_the_frame_may_go() -> None:
    first, second = both(part(STEP_BELOW), second_side={"locate": "dowels", "flip": "y"})
    job = second.job

    def into(at, z=-3.0):
        tool = second.program.sections[-1].tool.number
        down = f"G54\nG55\nG0 X{at.x:.3f} Y{at.y:.3f}\nG43 H{tool} Z5\nG1 Z{z} F100\nG53 G0 Z0\n"
        return asked("gouge", second.text.replace("M30\n", down + "M30\n"), job)

    x0, _, x1, y1 = job.body.bounds
    assert into(shapely.Point(x1 + 3.0, y1 - 4.0)).passed  # beside the end of the step
    assert not into(shapely.Point(x1 + 3.0, y1 - 4.0), -3.1).passed  # deeper than it is
    assert not into(shapely.Point(x1 + 3.0, -y1 - 4.0)).passed  # far from it
    assert not into(shapely.Point(x0 + 3.0, -y1 + 4.0)).passed  # in the part
    holes = [inside_of(f) for f in first.job.features if f.name.startswith("dowel")]
    assert len(holes) == 2
    for one in [*holes, *(shapely.difference(tab.shape, first.job.target) for tab in first.job.tabs)]:
        held = turned_shape(one.representative_point(), first.job, job)
        assert not into(held, -0.1).passed


def test_a_step_drawn_over_a_dowel_leaves_it_alone() -> None:
    wide = replace(STEP_BELOW, width=40.0)
    first, second = both(part(wide), second_side={"locate": "dowels", "flip": "y"})
    assert second.proof.ok
    for dowel in (f for f in first.job.features if f.name.startswith("dowel")):
        pin = turned_shape(inside_of(dowel), first.job, second.job)
        run = interpret(second.text)
        ends = shapely.points(run.end[run.cutting & (run.end[:, 2] < 0), :2])
        assert shapely.distance(ends, pin).min() > second.program.sections[-1].tool.radius


def box_at(name, x, top, depth, width=12.0):
    return Pocket(name, rounded_box(width, 8, 3).moved(x, 8.0), (), top, depth)


@pytest.mark.parametrize(
    ("features", "said"),
    [
        ((box_at("a", 0, 0.0, 4.0), box_at("b", 2, 4.3, 3.7)), "0.3 mm of part bracket stay between a and b"),
        ((box_at("a", 0, 0.0, 7.8),), "0.2 mm of part bracket stay between a and the underside"),
        ((box_at("a", 0, 0.1, 7.9),), "0.1 mm of part bracket stay between the top face and a"),
        ((box_at("a", 0, 0.0, 4.0), box_at("b", 2, 4.6, 3.4)), ""),  # thick enough
        ((box_at("a", -14, 0.0, 4.0), box_at("b", 14, 4.3, 3.7)), ""),  # beside each other
        ((box_at("a", 0, 0.0, 4.0), box_at("b", 11.5, 4.3, 3.7)), ""),  # they overlap by a ledge
        ((box_at("a", 0, 0.0, 7.8), box_at("b", 0, 7.8, 0.2)), ""),  # they meet
    ],
)
def test_floors_that_are_too_thin_are_told_of(features, said) -> None:
    _, found = lay_out_setups(part(*features), cam(), LIBRARY)
    assert [f.message for f in found if f.code == "cam.thin-floor"] == ([said] if said else [])


def test_tabs_stay_clear_of_dowels() -> None:
    # Even steps from the ring's start would put a tab where a dowel is: on the flip axis.
    first, _ = both(part(STEP_BELOW), second_side={"locate": "dowels", "flip": "y"})
    dowels = [inside_of(f) for f in first.job.features if f.name.startswith("dowel")]
    assert not any(shapely.intersects(hole, tab.shape) for hole in dowels for tab in first.job.tabs)


def test_a_face_below_leaves_no_place_for_tabs() -> None:
    face = Pocket("face", rounded_box(80, 60, 3), (), 7.0, 1.0)
    jobs, found = lay_out_setups(part(face), cam(), LIBRARY)
    assert "face, for the underside of part bracket, leaves too little" in errors(found)[0].message
    assert jobs == []


@pytest.mark.parametrize("control", ["fanuc", "grbl"])
def test_second_sides_on_every_control(control) -> None:
    _, second = both(part(COUNTERBORE), control=control)
    run = interpret(second.text, BY_NAME[control])
    assert {run.states[i].work_offset for i in run.state[run.cutting]} == {"G55"}


@given(
    x=st.floats(-20, 20),
    y=st.floats(-10, 10),
    width=st.floats(5, 14),
    depth=st.floats(0.5, 5),
    flip=st.sampled_from(["x", "y"]),
)
@settings(max_examples=examples(2, 12))
def test_random_underside_pockets_are_proven_or_refused(x, y, width, depth, flip) -> None:
    pocket = Pocket("pocket", rounded_box(width, 6.0, 2.2).moved(x, y), (), THICKNESS - depth, depth)
    jobs, found = lay_out_setups(part(pocket), cam(second_side={"flip": flip}), LIBRARY)
    if errors(found):
        assert all(finding.parameter.startswith("cam") for finding in errors(found))
        return
    if len(jobs) == 1:  # all of it lies in the bore
        assert inside_of(HOLE).buffer(1e-3).contains(inside_of(pocket))
        return
    made = machine(jobs[1], host().get(Control, "linuxcnc"))
    assert made.proof.ok
    assert math.isclose(
        interpret(made.text).end[:, 2][np.isfinite(interpret(made.text).end[:, 2])].min(),
        -depth,
        abs_tol=1e-3,
    )
