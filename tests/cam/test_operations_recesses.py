"""Recesses that are open at the rim, grooves, levels: from the feature to the proven program."""

import io
import math
import re

import ezdxf
import numpy as np
import pytest
import shapely
from by_control import posted, prove
from by_night import examples, thinned
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from planning_parts import LIBRARY, bore, job, plate, rounded_box
from planning_simulation import check_rules, gouge, leftover
from random_outcomes import run

from mechwright.contracts.moments import volume
from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.contracts.sections import sections
from mechwright.errors import GeometryError, MechwrightError
from mechwright.geometry import Arc, BSpline, Line, Loop, circle
from mechwright.geometry.trim import stretches, trimmed
from mechwright_cad.exporters import dxf
from mechwright_cam.pages.picture import plan_view
from mechwright_cam.planning import choose_tools, lay_out, plan
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.settings import CamSettings

OUTSIDE = Profile("outside", rounded_box(60, 40, 6), "outside", 0, 6.0)


def box(x0, y0, x1, y1):
    return Loop.polygon([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def ring_sector(inner, outer, first, last):
    """A groove along a circle, ends square."""
    one, two = Arc((0, 0), outer, first, last - first), Arc((0, 0), inner, last, first - last)
    return Loop((one, Line(one.end, two.start), two, Line(two.end, one.start)))


GROOVE = Pocket("groove", box(-40, -4.1, 40, 4.1), (), 0, 2)
TO_THE_RIM = Pocket("groove", box(-30, -4.1, 30, 4.1), (), 0, 2)
ONE_END = Pocket("groove", box(0, -4.1, 40, 4.1), (), 0, 2)
STEP = Pocket("step", box(-40, -30, 40, 30), (rounded_box(30, 20, 5),), 0, 2)
OBLIQUE = Pocket("groove", Loop.polygon([(-40, -25), (40, 5), (40, 15), (-40, -15)]), (), 0, 2.5)
CURVED = Pocket("groove", ring_sector(14.0, 22.5, 0.3, 2.8), (), 0, 3)
LEVELS = (
    Pocket("a", box(-10, -30, 10, 30), (), 0, 2),
    Pocket("b", box(-40, -5, 40, 5), (), 0, 4),
    Pocket("c", box(-8, -30, 8, 30), (), 2, 1),
)
BESIDE = (Pocket("a", box(-20, -10, 0, 10), (), 0, 2), Pocket("b", box(0, -6, 20, 6), (), 0, 2))
RECESSES = {
    "groove": (GROOVE,),
    "to the rim": (TO_THE_RIM,),
    "one end": (ONE_END,),
    "step": (STEP,),
    "oblique": (OBLIQUE,),
    "curved": (CURVED,),
    "levels": LEVELS,
    "beside": BESIDE,
}


def recessed(*features, thickness=6.0):
    outside = Profile("outside", rounded_box(60, 40, 6), "outside", 0, thickness)
    return plate(machined=(*features, outside), thickness=thickness)


def proven(of):
    program = plan(of)
    proof = prove(posted(of, program), of)
    assert proof.ok, [check.message for check in proof.failures]
    assert gouge(of, program) <= 0.005
    assert leftover(of, program) == 0
    check_rules(of, program)
    return program, proof


@pytest.mark.parametrize(
    ("name", "tools"), thinned(2, [*RECESSES], [("mill-6", "mill-3"), ("mill-10", "mill-4")])
)
def test_recesses_are_cut_to_the_last_corner(name, tools):
    proven(job(recessed(*RECESSES[name]), *tools))


@pytest.mark.parametrize("settings", [{"climb": False}, {"stock_to_leave": 0.0}, {"stock": {"margin": 60}}])
def test_an_open_groove_under_other_settings(settings):
    proven(job(recessed(GROOVE), "mill-6", "mill-3", **settings))


def test_an_open_groove_has_no_end_walls():
    program, proof = proven(job(recessed(GROOVE), "mill-6"))
    assert not proof.unreachable  # square ends would keep their corners
    xs = [
        m.x
        for s in program.sections
        for o in s.operations
        if o.name == "groove: finish"
        for m in o.moves
        if hasattr(m, "feed") and m.x is not None
    ]
    assert min(xs) < -30
    assert max(xs) > 30


def test_a_closed_groove_keeps_its_end_walls():
    _, proof = proven(job(recessed(Pocket("groove", box(-25, -4.1, 25, 4.1), (), 0, 2)), "mill-6"))
    assert len(proof.unreachable) == 4


FACE = Pocket("face", box(-60, -60, 60, 60), (), 0, 0.5)


@pytest.mark.parametrize(
    ("margin", "below"),
    thinned(2, [None, 0, 20], [(), (Pocket("recess", rounded_box(30, 20, 5), (), 0.5, 2),)]),
)
def test_a_recess_over_the_whole_part_faces_it(margin, below):
    held = {"method": "bore", "clamp_diameter": 5} if margin == 0 else {}
    features = (FACE, *below, Bore("bore", (0.0, 0.0), 8.0, 0.0, 6.0))
    of = plate(bore(8), machined=(*features, OUTSIDE))
    program, _ = proven(job(of, "mill-10", "mill-4", stock={"margin": margin}, hold=held))
    names = [o.name for s in program.sections for o in s.operations]
    assert names.count("face: face") == 1
    if below:
        assert names.index("face: face") < names.index("recess: rough")


def test_the_program_without_the_groove_fails_the_proof_of_the_grooved_part():
    plain = job(recessed(), "mill-6")
    proof = prove(posted(plain), job(recessed(GROOVE), "mill-6"))
    assert {check.name for check in proof.failures} == {"depth", "leftover"}


def test_the_program_with_the_groove_gouges_the_plain_part():
    grooved = job(recessed(GROOVE), "mill-6")
    proof = prove(posted(grooved), job(recessed(), "mill-6"))
    assert "gouge" in {check.name for check in proof.failures}


def test_a_recess_beside_the_plate_is_refused():
    of = recessed(Pocket("lost", box(40, -5, 50, 5), (), 0, 2))
    found = lay_out(of, CamSettings(), LIBRARY)[1]
    assert any("lost takes nothing of the plate" in finding.message for finding in found)


def test_a_narrow_recess_has_a_mill_chosen_for_it():
    chosen = choose_tools(recessed(Pocket("slit", box(-40, -1.3, 40, 1.3), (), 0, 1)), CamSettings(), LIBRARY)
    assert min(tool.diameter for tool in chosen) < 2.6
    of = recessed(Pocket("slit", box(-40, -1.3, 40, 1.3), (), 0, 1))
    proven(make_job(of, CamSettings(), chosen))


def test_a_slot_narrower_than_every_cutter_is_refused():
    of = recessed(Pocket("slit", box(-40, -1.3, 40, 1.3), (), 0, 1))
    found = lay_out(of, CamSettings(tools=("mill-6",)), LIBRARY)[1]
    assert any("no listed end mill enters slit" in finding.message for finding in found)


@pytest.mark.parametrize("name", RECESSES)
def test_solid_drawing_and_picture_show_the_recess(name):
    from mechwright_cad.solids.solid import part_solid

    of = recessed(*RECESSES[name])
    plain = recessed()
    expected = sum(layer.shape.area * (layer.bottom - layer.top) for layer in sections(of))
    assert volume(of) == pytest.approx(expected, rel=1e-4)
    assert part_solid(of).Volume() == pytest.approx(volume(of), rel=1e-5)
    assert volume(of) < volume(plain) - 100
    drawing = ezdxf.read(io.StringIO(dxf.part(of).decode()))
    edges = [entity for entity in drawing.modelspace() if entity.dxf.layer.startswith("POCKET_")]
    edges = [entity for entity in edges if not entity.dxf.layer.endswith("_OPEN")]
    assert edges
    inside = of.outline.polygon().buffer(0.01)
    for edge in edges:
        points = (
            [tuple(p)[:2] for p in edge.flattening(0.01)]
            if hasattr(edge, "flattening")
            else [
                tuple(edge.dxf.start)[:2],
                tuple(edge.dxf.end)[:2],
            ]
        )
        assert inside.contains(shapely.MultiPoint(points))
    texts = [entity.dxf.text for entity in drawing.modelspace().query("TEXT")]
    assert all(any(f.name in text for text in texts) for f in RECESSES[name])
    laid = job(of, "mill-6")
    assert plan_view(laid).count("<path") > plan_view(job(plain, "mill-6")).count("<path")


def test_sections_of_levels_against_areas_by_hand():
    # a: 20 x 40 all across, b: 60 x 10 along, c: 16 x 40 below a; b is below all to 4 mm.
    whole = OUTSIDE.loop.area
    layers = {(layer.top, layer.bottom): layer.shape.area for layer in sections(recessed(*LEVELS))}
    assert layers[0, 2] == pytest.approx(whole - (800 + 600 - 200), abs=0.02)
    assert layers[2, 3] == pytest.approx(whole - (640 + 600 - 160), abs=0.02)
    assert layers[3, 4] == pytest.approx(whole - 600, abs=0.02)
    assert layers[4, 6] == pytest.approx(whole, abs=0.02)


def test_a_blind_bore_and_a_step_outside_are_in_the_solid():
    from mechwright_cad.solids.solid import part_solid

    step = Profile("step", rounded_box(50, 30, 5), "outside", 0, 2)
    of = plate(machined=(Bore("seat", (5.0, 3.0), 8.0, 2, 2), step, OUTSIDE))
    assert part_solid(of).Volume() == pytest.approx(
        2 * rounded_box(50, 30, 5).area + 4 * OUTSIDE.loop.area - 2 * math.pi * 16, rel=1e-9
    )


def test_recesses_that_cut_a_plate_in_two_are_refused():
    from mechwright_cad.solids.solid import part_solid

    of = Part(
        "plate",
        plate().outline,
        6.0,
        "steel",
        machined=(
            Pocket("upper", box(-40, -4, 40, 4), (), 0, 3),
            Pocket("lower", box(-40, -4, 40, 4), (), 3, 3),
            OUTSIDE,
        ),
    )
    with pytest.raises(GeometryError, match="into 2 pieces"):
        part_solid(of)


@given(st.floats(0, 0.9), st.floats(0.05, 1), st.sampled_from(["line", "arc", "bezier", "spline"]))
def test_a_trimmed_segment_is_the_same_curve(first, length, kind):
    last = min(1.0, first + length)
    segment = {
        "line": Line((1.0, 2.0), (5.0, -3.0)),
        "arc": Arc((1.0, 1.0), 3.0, 0.4, -2.5),
        "bezier": BSpline.bezier([(0, 0), (1, 4), (3, -2), (5, 1)]),
        "spline": BSpline(
            3,
            (0, 0, 0, 0, 0.3, 0.3, 0.6, 1, 1, 1, 1),
            ((0, 0), (1, 2), (2, 2), (3, 0), (4, -1), (5, 1), (6, 0)),
        ),
    }[kind]
    t = np.linspace(0, 1, 17)
    found = trimmed(segment, first, last).at(t)
    np.testing.assert_allclose(found, segment.at(first + (last - first) * t), atol=1e-9)


def test_stretches_of_a_circle_in_a_box():
    region = shapely.box(0, -10, 10, 10)
    loop = Loop((circle((0, 0), 5.0),))
    pieces = stretches(loop, region)
    assert sum(abs(p.sweep) for p in pieces) == pytest.approx(math.pi, abs=2e-3)
    assert stretches(loop, region.buffer(10)) == list(loop.segments)


def random_recess(rng):
    """A polygon with arcs or without, anywhere on or over the edge of the plate."""
    kind = rng.integers(4)
    x, y = rng.uniform(-32, 32), rng.uniform(-22, 22)
    size = rng.uniform(3, 18)
    if kind == 0:
        loop = Loop((circle((x, y), size / 2),))
    elif kind == 1:
        width = rng.uniform(2.2, 12)
        loop = rounded_box(size + width, width, rng.uniform(0.1, 0.49) * width).moved(x, y, rng.uniform(0, 3))
    elif kind == 2:
        angles = np.sort(rng.uniform(0, math.tau, rng.integers(3, 8)))
        if np.diff(np.append(angles, angles[0] + math.tau)).max() > 3.0:
            angles = np.linspace(0, math.tau, 6)[:-1]
        radii = rng.uniform(0.5, 1, len(angles)) * size
        loop = Loop.polygon(np.column_stack((x + radii * np.cos(angles), y + radii * np.sin(angles))))
    else:
        first = rng.uniform(0, 6)
        width = rng.uniform(2.2, 8)
        loop = ring_sector(size, size + width, first, first + rng.uniform(0.3, 3)).moved(x, y)
    return loop


@settings(max_examples=examples(2, 30), deadline=None, suppress_health_check=list(HealthCheck))
@given(seed=st.integers(0, 10**9))
def test_any_recesses_are_cut_or_refused(seed):
    rng = np.random.default_rng(seed)
    features = [
        Pocket(f"recess-{n}", random_recess(rng), (), 0.0, float(rng.integers(1, 8)) / 2)
        for n in range(rng.integers(1, 4))
    ]
    if rng.random() < 0.3:
        features.append(Bore("bore", (0.0, 0.0), rng.uniform(4, 14), 0.0, 6.0))
    holes = [bore(f.diameter) for f in features if isinstance(f, Bore)]
    of = plate(*holes, machined=(*features, OUTSIDE))
    tools = (
        []
        if rng.random() < 0.5
        else list(rng.choice(["mill-10", "mill-8", "mill-6", "mill-4", "mill-3", "mill-2"], 2, replace=False))
    )
    wanted = CamSettings.model_validate({"tools": tools, "climb": bool(rng.integers(2))})
    try:
        made = make_job(of, wanted, choose_tools(of, wanted, LIBRARY))
        program = plan(made)
    except MechwrightError as error:
        assert re.match(r"cam\.[a-z_.]+: |part plate: recess-\d takes nothing", str(error)), error  # noqa: PT017
        return
    proof = prove(posted(made, program), made)
    assert proof.ok, [check.message for check in proof.failures]


def test_a_slot_is_cut_whatever_specks_overlays_leave():
    """Overlaying this slot with no island leaves a line of 4e-16 mm, which GEOS then stumbles over."""
    outcome = run("slot", 304)
    assert outcome.made
    assert not outcome.failures
