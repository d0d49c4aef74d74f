"""Chamfers, threads and engravings: planned, posted, proven, and missed when they are not there."""

import dataclasses
import math
import re
from functools import cache

import numpy as np
import pytest
import shapely
from by_control import LINUXCNC, posted, prove, read
from by_night import by_night, thinned
from planning_parts import LIBRARY, job, plate, rounded_box

from mechwright.contracts.details import Chamfer, Engraving, Thread
from mechwright.contracts.part import Bore, Pocket, Profile
from mechwright.errors import DesignError, GeometryError, ToolError
from mechwright.geometry import Loop, Outline, circle
from mechwright.geometry.lettering import LETTERS, lettering
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.machining import machine
from mechwright_cam.planning import choose_tools, lay_out, plan
from mechwright_cam.program.moves import FeedArc
from mechwright_cam.proof.details import deepest_in_fillet
from mechwright_cam.proof.fillets import fillets
from mechwright_cam.proof.paths import Paths
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.holding import Hold
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import ToolKind

TOOLS = ("mill-6", "mill-4", "chamfer-6", "engrave-3", "thread-m6", "spot-6", "drill-4")
RIM = rounded_box(60, 40, 6)
HOLE = Loop((circle((-15, 0), 6.0),))
CORE = Thread("m6", (12.0, 5.0), 6.0, 1.0, 5.0).core
SHAPE = (
    Bore("hole", (-15.0, 0.0), 12.0, 0, 6),
    Bore("core", (12.0, 5.0), CORE, 0, 6),
    Profile("outside", RIM, "outside", 0, 6),
)
DETAILS = {
    "rim": Chamfer("rim", RIM, "outside", 0.5),
    "hole": Chamfer("hole-edge", HOLE, "inside", 0.4),
    "thread": Thread("m6", (12.0, 5.0), 6.0, 1.0, 5.0),
    "text": Engraving("number", lettering("MW-25/3", 4.0, (4.0, -12.0)), 0.2),
}


def detailed(*details):
    core = Loop((circle((12, 5), CORE / 2, clockwise=True),))
    return dataclasses.replace(plate(HOLE.reversed(), core, machined=SHAPE), details=details)


@cache
def made(*details, **settings):
    of = job(detailed(*details), *TOOLS, **settings)
    program = plan(of)
    return of, program, prove(posted(of, program), of)


def test_the_chamfer_of_a_rim_keeps_off_the_clamp():
    """The mill stands over the part, further in than the wall."""
    with pytest.raises(
        DesignError, match=r"come within 1 mm of a clamp of 26 mm; use at most [\d.]+ mm"
    ) as said:
        made(DETAILS["rim"], hold=Hold(method="bore", clamp_diameter=26.0))
    most = float(re.findall(r"at most ([\d.]+) mm", str(said.value))[0])
    assert 22.0 < most < 26.0
    _, _, proof = made(DETAILS["rim"], hold=Hold(method="bore", clamp_diameter=most))
    assert proof.ok, [check.message for check in proof.failures]


@pytest.mark.parametrize(
    ("name", "settings"), [*thinned(1, DETAILS, [{}]), *thinned(2, DETAILS, [{"climb": False}])]
)
def test_each_detail_is_cut_and_proven(name, settings):
    _, program, proof = made(DETAILS[name], **settings)
    assert proof.ok, [check.message for check in proof.failures]
    names = [o.name for s in program.sections for o in s.operations]
    assert (
        names.count(
            f"{DETAILS[name].name}: "
            + {"rim": "chamfer", "hole": "chamfer", "thread": "thread", "text": "engrave"}[name]
        )
        == 1
    )


def test_all_details_together_and_the_rim_comes_last():
    _, program, proof = made(*DETAILS.values())
    assert proof.ok, [check.message for check in proof.failures]
    names = [o.name for s in program.sections for o in s.operations]
    assert names.index("rim: chamfer") > max(i for i, n in enumerate(names) if n.startswith("outside"))
    assert names.index("m6: thread") > max(i for i, n in enumerate(names) if n.startswith("core"))


@pytest.mark.parametrize("name", DETAILS)
def test_a_program_without_the_detail_fails(name):
    plain = job(detailed(), *TOOLS)
    proof = prove(posted(plain), job(detailed(DETAILS[name]), *TOOLS))
    assert [check.name for check in proof.failures] == ["details"]
    assert DETAILS[name].name in proof.failures[0].message


@pytest.mark.parametrize("name", DETAILS)
def test_the_detail_gouges_a_part_without_it(name):
    _, program, _ = made(DETAILS[name])
    proof = prove(LinuxCnc().write(program), job(detailed(), *TOOLS))
    assert "gouge" in {check.name for check in proof.failures}


@pytest.mark.parametrize(
    ("planned", "asked"),
    [
        (Chamfer("rim", RIM, "outside", 0.5), Chamfer("rim", RIM, "outside", 0.4)),
        (Thread("m6", (12.0, 5.0), 6.0, 1.0, 5.0), Thread("m6", (12.0, 5.0), 6.0, 0.75, 5.0)),
        (Thread("m6", (12.0, 5.0), 6.0, 1.0, 3.0), Thread("m6", (12.0, 5.0), 6.0, 1.0, 5.0)),
        (DETAILS["text"], Engraving("number", lettering("MW-25/4", 4.0, (4.0, -12.0)), 0.2)),
        (DETAILS["text"], Engraving("number", lettering("MW-25/3", 4.0, (4.0, -12.0)), 0.3)),
    ],
)
def test_a_detail_that_differs_fails(planned, asked):
    _, program, proof = made(planned)
    assert proof.ok
    assert not prove(LinuxCnc().write(program), job(detailed(asked), *TOOLS)).ok


@pytest.mark.parametrize(("longer", "good"), [(0.03, True), (0.08, True), (0.1, False)])
def test_a_line_of_a_mark_may_be_longer_within_its_width(longer, good):
    """The point's cone is 0.085 mm narrower at the top than the line that the design allows, on either side."""
    _, program, proof = made(mark := Engraving("line", (((4.0, -12.0), (8.0, -12.0)),), 0.2, 0.6))
    text = LinuxCnc().write(program)
    assert proof.ok
    assert text.count("\nX8 F120\n") == 1
    found = prove(text.replace("\nX8 F120\n", f"\nX{8 + longer:g} F120\n"), job(detailed(mark), *TOOLS))
    assert found.ok is good, [check.message for check in found.failures]
    short = prove(text.replace("\nX8 F120\n", "\nX7.8 F120\n"), job(detailed(mark), *TOOLS))
    assert [check.name for check in short.failures] == ["details"]


def across(depth, floor_radius, width):
    """A chamfered rim, with a recess across it whose floor has a fillet."""
    over = Pocket("over", rounded_box(24, 12, 4).moved(30.0, 2.0), (), 0.0, depth, floor_radius)
    part = plate(machined=(over, Profile("outside", RIM, "outside", 0, 6)))
    part = dataclasses.replace(part, outline=Outline(RIM), details=(Chamfer("rim", RIM, "outside", width),))
    return make_job(part, CamSettings(), choose_tools(part, CamSettings(), LIBRARY))


@pytest.mark.parametrize(
    ("depth", "floor_radius", "width"),
    [
        (1.3, 1.0, 0.4),
        pytest.param(1.3, 1.0, 0.8, marks=by_night),
        (3.0, 3.0, 0.5),
        pytest.param(2.0, 1.0, 0.3, marks=by_night),
    ],
)
def test_a_rim_is_chamfered_across_the_fillet_of_an_open_recess(depth, floor_radius, width):
    """Where the fillet is higher than the chamfer's foot, the part has the chamfer, as its sections say."""
    proof = machine(across(depth, floor_radius, width), LinuxCnc()).proof
    assert proof.ok, [check.message for check in proof.failures]


def test_a_chamfer_mill_that_cuts_into_a_fillet_is_seen():
    of = across(1.3, 1.0, 0.4)
    text = LinuxCnc().write(plan(of))
    (fillet,) = fillets(of)
    (mill,) = (tool for tool in of.tools if tool.kind is ToolKind.CHAMFER)
    deepest = []
    for planted in ("", f"G0 X25 Y-3.6\nG43 H{mill.number} Z5\nG1 Z-1.2 F99\nX26\n"):
        run = read(text.replace("M9\nM5\nG53 G0 Z0\nM30", planted + "M9\nM5\nG53 G0 Z0\nM30"), of, LINUXCNC)
        cuts = deepest_in_fillet(Paths(run, of.tools), of, fillet)
        deepest.append(max((cut.depth for cut in cuts if cut is not None), default=0.0))
    # 0.4 mm off the wall, 0.1 mm above the floor: a cone of 45 degrees meets the fillet.
    assert deepest[0] <= 0.005
    assert 0.05 < deepest[1] < 0.5


def test_the_chamfer_is_as_wide_as_drawn():
    _, program, _ = made(DETAILS["rim"])
    (moves,) = [o.moves for s in program.sections for o in s.operations if o.name == "rim: chamfer"]
    z = min(m.z for m in moves if getattr(m, "z", None) is not None)
    ys = [m.y for m in moves if getattr(m, "y", None) is not None]
    # A cone of 45 degrees: its radius at the top face is its height above the tip.
    assert 20 - (max(ys) - (-z)) == pytest.approx(0.5, abs=0.005)


def test_the_thread_is_a_helix_of_one_pitch_per_turn():
    _, program, _ = made(DETAILS["thread"])
    (moves,) = [o.moves for s in program.sections for o in s.operations if o.name == "m6: thread"]
    arcs = [m for m in moves if isinstance(m, FeedArc) and m.z is not None]
    assert all(m.ccw for m in arcs)
    z = np.array([m.z for m in arcs])
    assert np.diff(z) == pytest.approx(0.5)
    assert len(arcs) == 12


def test_tools_for_details_are_chosen():
    of = detailed(*DETAILS.values())
    kinds = [tool.kind for tool in choose_tools(of, CamSettings(), LIBRARY)]
    assert kinds.count(ToolKind.CHAMFER) == 2
    assert (kinds.count(ToolKind.TAP), kinds.count(ToolKind.THREAD_MILL)) == (1, 0)
    laid = make_job(of, CamSettings(), choose_tools(of, CamSettings(), LIBRARY))
    assert machine(laid, LinuxCnc()).proof.ok


@pytest.mark.parametrize(
    ("detail", "tools", "message"),
    [
        (DETAILS["rim"], ("mill-6", "mill-4"), "no chamfer mill"),
        (Engraving("fine", (((0, 0), (5, 0)),), 0.2, 0.3), TOOLS, "no pointed cutter"),
        (DETAILS["thread"], ("mill-6", "mill-4"), "no thread mill"),
        (Thread("m8", (12.0, 5.0), 8.0, 1.25, 5.0), TOOLS, "has no bore of 6.65 mm"),
        (Thread("m6", (0.0, 5.0), 6.0, 1.0, 5.0), TOOLS, "has no bore of 4.92 mm"),
        (Chamfer("hole-edge", Loop((circle((-15, 0), 0.08),)), "inside", 0.2), TOOLS, "no chamfer mill"),
    ],
)
def test_what_no_tool_makes_is_refused(detail, tools, message):
    with pytest.raises(ToolError, match=message):
        plan(job(detailed(detail), *tools))
    found = lay_out(detailed(detail), CamSettings(tools=tools), LIBRARY)[1]
    assert any(message in finding.message for finding in found)


def test_every_letter_stands_on_its_grid():
    for letter in LETTERS:
        for stroke in lettering(letter, 6.0):
            assert len(stroke) >= 2
            assert np.abs(np.array(stroke)).max() <= 3.0
    turned = lettering("AB", 5.0, (10.0, 20.0), math.pi / 2)
    line = shapely.MultiLineString(list(turned))
    assert line.centroid.distance(shapely.Point(10, 20)) < 1.5
    assert line.bounds[3] - line.bounds[1] > line.bounds[2] - line.bounds[0]
    with pytest.raises(DesignError, match="no letter 'Ä'"):
        lettering("Ä", 5.0)


@pytest.mark.parametrize(
    "make",
    [
        lambda: Chamfer("a", RIM, "outside", 0.0),
        lambda: Thread("a", (0, 0), 6.0, 0.0, 5.0),
        lambda: Thread("a", (0, 0), 6.0, 4.0, 5.0),
        lambda: Engraving("a", (), 0.2),
        lambda: Engraving("a", (((0, 0), (1, 1)),), 0.0),
    ],
)
def test_details_that_cannot_be(make):
    with pytest.raises(GeometryError):
        make()
