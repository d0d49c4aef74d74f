"""How the parts are made: fits of the studs' holes, tabs, and cutters of grooves and slots."""

import math
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest
import shapely

from mechwright.contracts.finding import Severity
from mechwright.contracts.fits import hole_fit
from mechwright.contracts.moments import volume
from mechwright.contracts.part import Bore, Pocket, Profile
from mechwright.designs.design import load
from mechwright.pipeline import Build
from mechwright.plugins.host import host
from mechwright_cad.exporters.dxf import part as drawing
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.machining import Machining, machine
from mechwright_cam.operations.channel import outside_mills
from mechwright_cam.pages.setup_sheet import setup_html
from mechwright_cam.planning import choose_tools, plan
from mechwright_cam.program.moves import FeedArc
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.table import settings_of
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.parts.parts import parts_of
from mechwright_plane.offsets import BIAS

ROOT = Path(__file__).parents[2]
LIBRARY = load_library(None)


def example(name):
    return load(ROOT / "examples" / f"geneva-{name}.toml", host())


def parts(name, **changes):
    params = GenevaParams(**{**example(name).params.model_dump(exclude_none=True), **changes})
    return {part.name: part for part in parts_of(params)}


def job_of(part, *tools, **changes):
    settings = settings_of(example("cycloidal")).cam.model_copy(update={"tools": tools, **changes})
    return make_job(part, settings, choose_tools(part, settings, LIBRARY))


@pytest.mark.parametrize("name", ["F7", "H7", "N7", "P7"])
def test_a_stud_hole_is_made_to_the_middle_of_its_fit(name):
    crank = parts("cycloidal", pin_fit=name)["crank"]
    (pin,) = [f for f in crank.features if isinstance(f, Bore) and f.name == "pin-1"]
    fit = hole_fit(6, name)
    assert pin.diameter == fit.middle != 6
    text = drawing(crank).decode("cp1252")
    assert f"pin-1: %%c{fit.text}" in text
    job = job_of(crank)
    made = machine(job, LinuxCnc())
    assert f"pin-1: Ø{fit.text}, made to {fit.middle:g}" in made.program.notes
    assert f"pin-1 ⌀{fit.text}" in setup_html(
        made.job, made.program, made.proof.as_dict(), host().get(Control, "linuxcnc")
    )
    ((tool, moves),) = [
        (section.tool, operation.moves)
        for section in made.program.sections
        for operation in section.operations
        if operation.name == "pin-1: finish"
    ]
    widest = max(2 * (math.hypot(m.i, m.j) + tool.radius) for m in moves if isinstance(m, FeedArc))
    assert fit.lower < widest - 6 < fit.upper


def test_without_a_fit_the_hole_is_bare():
    crank = parts("cycloidal", pin_fit="none")["crank"]
    (pin,) = [f for f in crank.features if isinstance(f, Bore) and f.name == "pin-1"]
    assert (pin.diameter, pin.fit) == (6, None)


def test_a_stud_pressed_in_does_not_stand_in_the_crank():
    for name, diameter in (("P7", 5.986), ("H7", 6)):
        box = parts("cycloidal", pin_fit=name)["roller"].build().BoundingBox()
        assert box.xmax == pytest.approx(5, abs=1e-6)
        volume = parts("cycloidal", pin_fit=name)["roller"].build().Volume()
        assert volume == pytest.approx(math.pi * (25 * 10 + diameter**2 / 4 * 8.5), rel=1e-6)


DESIGNS = {
    "cycloidal": partial(parts, "cycloidal"),
    "prototype": partial(parts, "prototype"),
    "straight": partial(parts, "straight"),
    "backed": partial(parts, "cycloidal", construction="backed", fixing=3),
    "two rollers": partial(parts, "straight", rollers=2),
}


@pytest.mark.parametrize("design", DESIGNS.values(), ids=DESIGNS)
def test_no_tab_stands_on_a_wall_that_works(design):
    met = 0
    for part in design().values():
        if part.outline is None:
            continue
        (outside,) = [f for f in part.features if isinstance(f, Profile) and f.side == "outside"]
        working = [s for s in outside.loop.segments if s.tag not in ("rim", "relief", "crank", "hub")]
        job = make_job(part, settings_of(example("cycloidal")).cam, LIBRARY.tools)
        assert len(job.tabs) == 4
        plate = shapely.Polygon(outside.loop.flatten())
        for tab in job.tabs:
            assert tab.width >= 0.8
            assert shapely.intersects(tab.shape, plate)
            for segment in working:
                assert not shapely.intersects(tab.shape, shapely.LineString(segment.flatten(0.01)))
                met += 1
    assert met >= 8


def test_tabs_of_the_disc_are_in_the_deep_of_its_relief():
    disc = parts("cycloidal")["locking-disc"]
    sites = disc.features[-1].tab_sites
    assert len(sites) >= 6
    assert max(math.hypot(*place) for place, _ in sites) < 66 < 70


@pytest.mark.parametrize("slots", [4, 6, 8])
def test_a_relief_of_any_depth_takes_tabs_from_a_tenth_of_its_depth_on(slots):
    m = mechanism_of(GenevaParams(slots=slots))
    (disc,) = [part for part in parts_of(m.params) if part.name == "locking-disc"]
    away = [math.hypot(*place) for place, _ in disc.features[-1].tab_sites]
    assert away, "without places of its own any place would do, also one on the arc that locks"
    assert max(away) <= m.lock - 0.1 * (m.lock - m.driver_radius)


def cutters(part, *tools):
    """Operations of groove 1 and of the outside, with the diameters of their cutters."""
    job = job_of(part, *tools)
    return {
        operation.name: section.tool.diameter
        for section in plan(job).sections
        for operation in section.operations
        if operation.name.startswith(("groove-1", "outside"))
    }


def one_groove():
    wheel = parts("prototype")["wheel"]
    keep = [f for f in wheel.features if not (isinstance(f, Pocket) and f.name != "groove-1")]
    return replace(wheel, machined=tuple(keep))


def test_a_groove_is_roughed_and_both_walls_finished():
    used = {name: d for name, d in cutters(one_groove()).items() if name.startswith("groove")}
    assert {"groove-1: rough", "groove-1: finish"} <= set(used)
    assert max(used.values()) <= 0.7 * 10.05


def test_a_groove_is_cut_at_full_width_only_if_asked():
    used = cutters(one_groove(), "mill-10", "mill-6", "drill-8", "spot-6")
    assert used["groove-1: finish"] == 6
    used = cutters(one_groove(), "mill-10", "drill-10")
    assert used["groove-1: finish"] == 10


def test_a_straight_slot_is_not_cut_at_full_width():
    wheel = parts("straight")["wheel"]
    used = cutters(wheel)
    # A mill that is wider than the slots stays out of them; those that enter are smaller than the roller.
    enter = {name: d for name, d in used.items() if d < 8.08}
    assert {"outside: rough the rest", "outside below the tabs: rough the rest", "outside: finish"} <= set(
        enter
    )
    assert enter["outside: finish"] <= min(enter.values()) <= max(enter.values()) < 8
    shape = shapely.Polygon(wheel.outline.outer.flatten())
    mills = [LIBRARY.get(f"mill-{d}") for d in (16, 8, 6)]
    assert [m.diameter for m in outside_mills(mills, shape, 0.2, BIAS)] == [16, 6]
    assert outside_mills(mills[:2], shape, 0.2, BIAS) == mills[:2]


BORED = {"counterbore_diameter": 24.0, "counterbore_depth": 3.0}


@pytest.mark.parametrize("name", ["straight", "cycloidal"])
def test_a_counterbore_takes_its_ring_and_its_fillet_leaves_a_moulding(name):
    plain, bored = parts(name)["wheel"], parts(name, **BORED)["wheel"]
    bore = example(name).params.bore / 2
    ring = math.pi * (12.0**2 - bore**2) * 3.0
    assert volume(plain) - volume(bored) == pytest.approx(ring, rel=1e-5)
    # The fillet's section is a square less a quarter circle; Pappus takes its centroid once round.
    radius = 1.0
    section = (1 - math.pi / 4) * radius**2
    from_the_wall = radius * (1 - 1 / (6 - 1.5 * math.pi))
    left = math.tau * (12.0 - from_the_wall) * section
    filleted = parts(name, **BORED, counterbore_radius=radius)["wheel"]
    assert volume(filleted) - volume(bored) == pytest.approx(left, rel=1e-4)


@pytest.mark.parametrize(
    ("changes", "sides"),
    [({"counterbore_radius": 1.0}, ["top"]), ({"counterbore_side": "underside"}, ["top", "underside"])],
)
def test_a_counterbore_is_cut_and_proven_with_its_fillet_or_from_the_other_side(changes, sides):
    design = example("straight")
    table = {**design.params.model_dump(exclude_none=True), **BORED, **changes}
    machining = Machining(Build(replace(design, params=GenevaParams(**table)), host()))
    wheel = [made for made in machining.proven_programs if made.job.part.name.startswith("wheel")]
    assert [made.job.side for made in wheel] == sides
    assert all(made.proof.ok for made in wheel)
    (text,) = [made.text for made in wheel if made.job.side == sides[-1]]
    assert "operation: counterbore: " in text


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"counterbore_diameter": 10.5}, "counterbore_diameter"),
        ({"counterbore_diameter": 200.0}, "counterbore_diameter"),
        ({"counterbore_depth": 7.0}, "counterbore_depth"),
        ({"counterbore_depth": 1.0, "counterbore_radius": 2.0}, "counterbore_radius"),
        ({"counterbore_side": "underside", "counterbore_radius": 1.0}, "counterbore_radius"),
        ({"counterbore_side": "underside", "hub_diameter": 24.0, "fixing": 0.0}, "counterbore_side"),
    ],
)
def test_a_counterbore_that_cannot_be_is_refused_and_the_advice_mends_it(changes, key):
    design = example("straight")
    table = {**design.params.model_dump(exclude_none=True), **BORED, **changes}
    found = [f for f in design.family.check(GenevaParams(**table)) if f.code == "geneva.counterbore"]
    assert [finding.parameter for finding in found] == [key]
    assert found[0].severity is Severity.ERROR
    mended = "top" if key == "counterbore_side" else found[0].limit
    again = design.family.check(GenevaParams(**{**table, key: mended}))
    assert [finding for finding in again if finding.code == "geneva.counterbore"] == []
