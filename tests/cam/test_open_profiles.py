"""Grooves on a path and steps beside one: from the feature to the proven program."""

import io
import math
import re

import ezdxf
import numpy as np
import pytest
import shapely
from by_control import posted, prove
from by_night import examples, thinned
from height_map import Simulation, cutters, read
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from planning_parts import LIBRARY, job, plate, rounded_box
from planning_simulation import leftover
from proving import proven

from mechwright.contracts.part import Bore, OpenProfile, Part, Profile
from mechwright.errors import GeometryError, MechwrightError
from mechwright.geometry import Arc, BSpline, Line
from mechwright_cad.exporters import dxf
from mechwright_cam.planning import choose_tools, lay_out, plan
from mechwright_cam.planning.setups import lay_out_setups
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.setup.sides import sides
from mechwright_cam.shop.settings import CamSettings
from mechwright_plane.nest import moved_feature

OUTSIDE = Profile("outside", rounded_box(60, 40, 6), "outside", 0, 6.0)
BENT = (Line((-40.0, -8.0), (0.0, -8.0)), Arc((0.0, 2.0), 10.0, -math.pi / 2, 1.2))
WAVE = (BSpline.bezier([(-20, -8), (-5, 18), (5, -20), (20, 8)]),)
LIMITS = {"groove": ("on", 6.0), "left": ("left", 8.0), "right": ("right", 7.0)}


def opened(side, width, path=BENT, depth=2.0):
    return plate(machined=(OpenProfile("open", 0.0, depth, path=path, side=side, width=width), OUTSIDE))


def names(program):
    return [o.name for s in program.sections for o in s.operations if o.name.startswith("open")]


@pytest.mark.parametrize(("name", "path"), thinned(2, [*LIMITS], [BENT, WAVE]))
def test_open_profiles_are_cut(name, path):
    of = job(opened(*LIMITS[name], path=path), "mill-6", "mill-4")
    program, _, _ = proven(of)
    if name != "groove":  # that helper knows no groove as wide as its cutter
        assert leftover(of, program) == 0


@pytest.mark.parametrize("path", [BENT, WAVE])
def test_a_mill_as_wide_as_the_groove_runs_on_its_centre_line(path):
    program, text, proof = proven(job(opened("on", 6.0, path), "mill-6", "mill-3"))
    assert names(program) == ["open: slot"]
    slot = text[text.index("open: slot") : text.index("(operation: outside")]
    places = [tuple(map(float, m)) for m in re.findall(r"X(-?[\d.]+) Y(-?[\d.]+)", slot)]
    line = shapely.union_all([shapely.LineString(segment.flatten(1e-5)) for segment in path])
    assert len(places) > 4
    assert max(line.distance(shapely.Point(place)) for place in places) < 0.0025
    assert proof.leftover_reachable_max_mm < 0.010


def test_a_slot_that_is_not_cut_or_is_cut_beside_its_line_is_found():
    of = job(opened("on", 6.0), "mill-6", "mill-3")
    text = posted(of)
    first, last = text.index("(operation: open"), text.index("(operation: outside")
    shallow = text[first:last].replace("Z-2", "Z-1.9")
    assert {"depth", "leftover"} <= {c.name for c in prove(text[:first] + shallow + text[last:], of).failures}
    slot = re.sub(r"Y(-?[\d.]+)", lambda m: f"Y{float(m[1]) + 0.02:.4f}", text[first:last])
    assert {"gouge", "leftover"} <= {
        check.name for check in prove(text[:first] + slot + text[last:], of).failures
    }


def test_a_slot_cut_too_short_is_found():
    straight = (Line((-15.0, 0.0), (15.0, 0.0)),)
    of = job(opened("on", 6.0, straight), "mill-6")
    text = posted(of)
    first, last = text.index("(operation: open"), text.index("(operation: outside")
    slot = text[first:last].replace("X15", "X14.9")
    assert slot != text[first:last]
    names = {check.name for check in prove(text[:first] + slot + text[last:], of).failures}
    assert "leftover" in names


def test_the_height_map_sees_the_groove():
    straight = (Line((-15.0, 0.0), (15.0, 4.0)),)
    of = job(opened("on", 6.0, straight), "mill-6")
    seen = Simulation(of.stock, of.thickness, pitch=0.2)
    seen.run(read(posted(of)), cutters(of))
    deep = seen.solid & (np.abs(seen.height + 2.0) < 1e-3)
    wanted = shapely.LineString([(-15, 0), (15, 4)]).buffer(3.0, quad_segs=64)
    assert deep.sum() * 0.04 == pytest.approx(wanted.area, rel=0.02)
    assert not seen.complaints


def test_the_mill_of_the_grooves_width_is_chosen():
    of = opened("on", 5.0)
    chosen = choose_tools(of, CamSettings(), LIBRARY)
    assert "mill-5" in {tool.name for tool in chosen}
    program, _, _ = proven(make_job(of, CamSettings(), chosen))
    assert names(program) == ["open: slot"]


def test_a_narrower_mill_cuts_both_walls_and_adaptive_clearing_turns_in_loops():
    straight = (Line((-40.0, 0.0), (40.0, 0.0)),)
    wide = job(opened("on", 9.0, straight), "mill-6", "mill-4")
    assert names(proven(wide)[0]) == ["open: rough", "open: finish the floor", "open: finish"]
    short = (Line((-8.0, 0.0), (8.0, 0.0)),)
    loops = job(opened("on", 8.0, short), "mill-8", "mill-4", clearing="adaptive")
    assert names(proven(loops)[0])[0] == "open: clear"
    only = job(opened("on", 6.0), "mill-6", clearing="adaptive")
    assert names(proven(only)[0]) == ["open: slot"]


def test_what_a_slot_leaves_on_its_floor_goes_last():
    texts = {leave: proven(job(opened("on", 6.0), "mill-6", floor_to_leave=leave))[1] for leave in (0.0, 0.3)}
    assert "Z-1.7" in texts[0.3]
    assert "Z-1.7" not in texts[0.0]


def test_a_groove_through_the_plate():
    groove = OpenProfile("slot", 0.0, 6.0, path=(Line((-12.0, 0.0), (12.0, 0.0)),), side="on", width=6.0)
    of = plate(groove.boundary.reversed(), machined=(groove, OUTSIDE))
    program, _, _ = proven(job(of, "mill-6"))
    assert [o.name for s in program.sections for o in s.operations][:1] == ["slot: slot"]


def test_a_groove_narrower_than_every_cutter_is_refused():
    found = lay_out(opened("on", 2.5), CamSettings(tools=("mill-6",)), LIBRARY)[1]
    assert any("no listed end mill enters open" in finding.message for finding in found)


@pytest.mark.parametrize("name", LIMITS)
def test_solid_and_drawing_follow_from_the_feature(name):
    from mechwright.contracts.moments import volume
    from mechwright_cad.solids.solid import part_solid

    of = opened(*LIMITS[name])
    assert part_solid(of).Volume() == pytest.approx(volume(of), rel=1e-5)
    assert volume(of) < volume(plate()) - 50
    drawing = ezdxf.read(io.StringIO(dxf.part(of).decode()))
    layers = [entity.dxf.layer for entity in drawing.modelspace()]
    assert sum(layer.startswith("POCKET_") for layer in layers) >= 3
    # The centre line of a groove, beside the cross on the part's axis.
    assert layers.count("CENTRE") == 2 + (2 if name == "groove" else 0)


def test_turned_over_and_nested_it_is_the_same_strip():
    feature = OpenProfile("open", 4.0, 2.0, path=BENT, side="left", width=5.0)
    hole = Bore("bore", (10.0, 12.0), 8.0, 0.0, 6.0)
    of = plate(rounded_box(2, 2, 0.5, clockwise=True), machined=(hole, feature, OUTSIDE))
    upper, under = sides(Part("plate", of.outline, 6.0, "aluminium", machined=(hole, feature, OUTSIDE)))
    assert under == (feature,)
    assert feature not in upper
    part = plate(machined=(feature, OUTSIDE))
    jobs, findings = lay_out_setups(
        part, CamSettings.model_validate({"second_side": {"locate": "edges"}}), LIBRARY
    )
    assert len(jobs) == 2, findings
    turned = next(f for f in jobs[1].part.features if f.name == "open")
    assert (turned.side, turned.top) == ("right", 0.0)
    mirrored = shapely.transform(shapely.Polygon(feature.boundary.flatten()), lambda p: p * (1, -1))
    assert shapely.symmetric_difference(shapely.Polygon(turned.boundary.flatten()), mirrored).area < 0.01
    moved = moved_feature(feature, 5.0, 1.0, 0.4)
    assert isinstance(moved, OpenProfile)
    assert moved.side == "left"


@settings(
    max_examples=examples(3, 12),
    deadline=None,
    suppress_health_check=list(HealthCheck),
    phases=[Phase.explicit, Phase.reuse, Phase.generate],
)
@given(
    start=st.tuples(st.floats(-34, 34), st.floats(-24, 24)),
    heading=st.floats(0, 6.28),
    items=st.lists(st.tuples(st.floats(3, 40), st.floats(4, 20), st.floats(-2, 2)), min_size=1, max_size=2),
    side=st.sampled_from(["left", "right", "on"]),
    width=st.sampled_from([3.0, 4.0, 6.0, 7.3]),
    tools=st.sampled_from([(), ("mill-6", "mill-3"), ("mill-4", "mill-2")]),
)
def test_any_path_is_cut_or_refused(start, heading, items, side, width, tools):
    path, place = [], start
    for length, radius, turn in items:
        end = (place[0] + length * math.cos(heading), place[1] + length * math.sin(heading))
        path.append(Line(place, end))
        if abs(turn) > 0.05:
            away = math.copysign(math.pi / 2, turn)
            centre = (end[0] + radius * math.cos(heading + away), end[1] + radius * math.sin(heading + away))
            path.append(Arc(centre, radius, heading - away, turn))
            heading += turn
        place = path[-1].end
    try:
        of = opened(side, width, tuple(path))
        wanted = CamSettings.model_validate({"tools": tools})
        made = make_job(of, wanted, choose_tools(of, wanted, LIBRARY))
        program = plan(made)
    except GeometryError as error:
        assert "meets itself" in str(error) or "too sharply" in str(error)  # noqa: PT017
        return
    except MechwrightError as error:
        assert re.match(r"cam\.[a-z_.]+: |part plate: open takes nothing", str(error)), error  # noqa: PT017
        return
    proof = prove(posted(made, program), made)
    assert proof.ok, [check.message for check in proof.failures]
