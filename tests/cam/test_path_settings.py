"""The table [cam.path]: how exact walls are, and what their paths are made of."""

import math
from pathlib import Path

import numpy as np
import pytest
import shapely
from by_control import posted, prove
from by_night import NIGHT, by_night, examples
from hypothesis import given, settings
from hypothesis import strategies as st
from planning_parts import LIBRARY, bore, lobes, part, plate, rounded_box
from planning_simulation import motions
from pydantic import ValidationError
from random_pockets import case

from mechwright.contracts.part import Pocket, Profile
from mechwright.designs.design import load
from mechwright.errors import DesignError
from mechwright.geometry import Loop
from mechwright.plugins.host import host
from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.contract import Control
from mechwright_cam.planning import Assignments, choose_tools, plan
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.settings import CamSettings, PathSettings
from mechwright_cam.shop.table import settings_of
from mechwright_plane.arcfit import fit
from mechwright_plane.reach import closing

EXAMPLES = Path(__file__).parents[2] / "examples"
ZONES = [(0.0, 0.003), (0.001, 0.004), (0.002, 0.002), (0.0045, 0.0045), (0.0, 0.008), (0.0045, 0.008)]
"""The corners of what is allowed, and what goes without saying."""
DIGITS = 2e-4
"""What the decimals of a program, chords and samples are off, mm."""


def tasks_of(job, name):
    """The tasks of one operation."""
    return [task for task in Assignments().of(job).every() if task.operation.name == name]


def path(inner: float, outer: float, lines: int = 1) -> dict[str, float]:
    return {"inner_tolerance": inner, "outer_tolerance": outer, "lines_per_arc": lines}


def gear_job(**changes):
    """A toothed plate with a recess."""
    loop = lobes(9, 18.0, 4.0, 2500)
    recess = Pocket("recess", rounded_box(14, 12, 4), (), 0.0, 2.0)
    whole = part(loop, thickness=4.0, machined=(recess, Profile("outside", loop, "outside", 0.0, 4.0)))
    wanted = {"stock_to_leave": 0.1, "spring_passes": 0, **changes}
    return make_job(whole, CamSettings.model_validate(wanted), [LIBRARY.get("mill-3")])


def checked(of):
    """The program of a job, its text, and its proof, which has nothing to complain of."""
    program = plan(of)
    text = posted(of, program)
    proof = prove(text, of)
    assert proof.ok, [check.message for check in proof.failures]
    return program, text, proof


def finishing(program, of):
    """The moves at depth of the cuts that finish the outside: their ways, and how many arcs are among them."""
    found = [m for m in motions(program, 0.01) if m.operation.endswith("finish")]
    found = [m for m in found if "outside" in m.operation and m.points[:, 2].max() < -of.thickness + 1.5]
    return [m for m in found if m.kind in {"feed", "arc"}], sum(m.kind == "arc" for m in found)


@pytest.mark.parametrize(("inner", "outer"), ZONES if NIGHT else ZONES[4:5])
def test_walls_lie_between_their_tolerances(inner, outer):
    of = gear_job(path=path(inner, outer))
    program, _, proof = checked(of)
    keep, radius = of.target, 1.5
    shapely.prepare(keep)
    cuts = [m for m in motions(program, 0.02) if m.kind != "rapid" and "outside" in m.operation]
    ways = shapely.linestrings([p for m in cuts for p in np.stack((m.points[:-1, :2], m.points[1:, :2]), 1)])
    near = ways[shapely.dwithin(keep, ways, radius + 0.1)]
    assert not shapely.intersects(keep, near).any()
    edges = shapely.get_coordinates(shapely.boundary(keep))
    edges = shapely.STRtree(shapely.linestrings(np.stack((edges[:-1], edges[1:]), 1)))
    _, away = edges.query_nearest(near, return_distance=True, all_matches=False)
    assert radius - away.min() <= inner + DIGITS
    wall = shapely.boundary(closing(keep, radius + of.settings.path.bias))
    points = shapely.points(shapely.get_coordinates(shapely.segmentize(wall, 0.05)))
    _, away = shapely.STRtree(ways).query_nearest(points, return_distance=True, all_matches=False)
    assert away.max() - radius <= outer + DIGITS
    assert proof.gouge_max_mm <= inner + TOLERANCES.flatten + DIGITS
    assert proof.leftover_reachable_max_mm <= outer + TOLERANCES.flatten + DIGITS


def test_a_wider_zone_makes_shorter_programs():
    moves = [len(finishing(plan(of), of)[0]) for of in (gear_job(path=path(*zone)) for zone in ZONES)]
    exact, usual, even, wide, _, widest = moves
    assert exact > usual
    assert even > wide > widest
    assert widest < 0.8 * exact


@by_night
def test_arcs_are_written_where_they_stand_for_enough_lines():
    counts = []
    for lines in (1, 2, 3, 4, 10, 100):
        of = gear_job(path=path(0.001, 0.004, lines))
        moves, arcs = finishing(checked(of)[0], of)
        counts.append((arcs, len(moves)))
    arcs, moves = zip(*counts, strict=True)
    assert list(arcs) == sorted(arcs, reverse=True)
    assert max(moves[:2]) < moves[3] < moves[4] < moves[5]
    assert len(set(arcs)) >= 4
    leads = 2
    assert arcs[0] > 10 * leads
    assert arcs[-1] <= leads


@pytest.mark.parametrize("radius", [0.5, 3.0, 12.0])
def test_a_third_of_a_circle_stands_for_as_many_lines_as_its_chords(radius):
    tolerance = 0.002
    turn = np.linspace(0, 2.1, 500)
    bend = radius * np.column_stack((np.cos(turn), np.sin(turn)))
    # A chord stands off an arc by r (1 - cos(angle / 2)).
    chords = math.ceil(2.1 / (2 * math.acos(1 - tolerance / radius)))
    assert [cut.turn for cut in fit(bend, tolerance, chords - 1).cuts] == [1]
    # Chords end at vertices, of which there are at least eight to a chord.
    straight = fit(bend, tolerance, math.ceil(1.2 * chords)).cuts
    assert not any(cut.turn for cut in straight)
    assert chords <= len(straight) < 1.2 * chords


def slotted(width: float):
    """A plate with a channel of this width into its edge."""
    x, y, w = 20.0, 15.0, width / 2
    loop = Loop.polygon([(-x, -y), (x, -y), (x, y), (w, y), (w, 0), (-w, 0), (-w, y), (-x, y)])
    return part(loop, thickness=4.0)


@pytest.mark.parametrize(("outer", "enters"), [(0.004, True), (0.008, False)])
def test_slots_are_entered_where_the_path_has_room(outer, enters):
    """At 6.005 mm a mill of 6 mm has 2.5 um on either side; its path keeps 1.5 um off walls, or 3.5."""
    wanted = CamSettings.model_validate({"path": path(0.001, outer)})
    of = make_job(slotted(6.005), wanted, [LIBRARY.get("mill-6")])
    program, _, _ = checked(of)
    deep = any(abs(p[0]) < 0.1 and 4 < p[1] < 10 for m in motions(program) for p in m.points if p[2] < 0)
    assert deep is enters


def test_tighter_walls_take_no_coarser_mill():
    """Fillets of 2.985 mm keep 6 um from a mill of 6 mm: too much as it comes, and more so if less may stay."""
    recess = Pocket("recess", rounded_box(30, 20, 2.985), (), 0.0, 2.0)
    for zone in ((0.001, 0.004), (0.0, 0.003)):
        wanted = CamSettings.model_validate({"path": path(*zone)})
        of = make_job(plate(machined=(recess,)), wanted, [LIBRARY.get("mill-6"), LIBRARY.get("mill-4")])
        (found,) = tasks_of(of, "clear")
        assert found.tools[-1].name == "mill-4"


def test_round_ends_are_for_neither_ramped_tabs_nor_compensated_bores():
    bull = LIBRARY.get("bull-6-r1")
    ramped = CamSettings.model_validate({"hold": {"tab_shape": "ramped", "tabs": 2, "tab_height": 0.5}})
    with pytest.raises(DesignError, match="ramped tabs of part plate are for flat end mills, and bull-6-r1"):
        plan(make_job(plate(), ramped, [bull]))
    bored = CamSettings.model_validate({"compensation": "wear"})
    hole = make_job(plate(bore(14)), bored, [bull, LIBRARY.get("mill-5"), LIBRARY.get("spot-6")])
    (found,) = tasks_of(hole, "bore")
    assert [mill.name for mill in found.tools] == ["mill-5"]


@settings(max_examples=examples(2, 12))
@given(seed=st.integers(0, 10**9), zone=st.sampled_from(ZONES), lines=st.sampled_from([1, 3, 100]))
def test_any_pocket_is_proven_within_its_tolerances(seed, zone, lines):
    proof = case(seed, path=path(*zone, lines))
    if isinstance(proof, str):
        assert proof.startswith("cam.")
        return
    inner, outer = zone
    assert proof.ok, [check.message for check in proof.failures]
    assert proof.gouge_max_mm <= inner + TOLERANCES.flatten + DIGITS
    assert proof.leftover_reachable_max_mm <= outer + TOLERANCES.flatten + DIGITS


@pytest.mark.parametrize("compensation", [pytest.param("control", marks=by_night), "wear"])
def test_contours_of_compensation_keep_to_the_tolerances(compensation):
    texts = set()
    for zone in ((0.0, 0.003), (0.0045, 0.0045)):
        of = gear_job(path=path(*zone), compensation=compensation, wear_limit=0.02, stock_to_leave=0.5)
        _, text, proof = checked(of)
        assert proof.leftover_reachable_max_mm <= zone[1] + TOLERANCES.flatten + DIGITS
        texts.add(text)
    assert len(texts) == 2


def proof_of_teeth(compensation, walls, backlash):
    """The proof of the Haas pair's program with these walls; no backlash given: that of gears as made."""
    design = load(EXAMPLES / "elliptic-pair-haas.toml", host())
    wanted = settings_of(design).cam.model_copy(
        update={"compensation": compensation, "path": PathSettings(**walls)}
    )
    (gear,) = design.family.parts(design.params.model_copy(update={"backlash": backlash}))
    post = host().get(Control, "haas")
    of = make_job(gear, wanted, choose_tools(gear, wanted, LIBRARY))
    return prove(posted(of, control=post), of, post)


@pytest.mark.parametrize(
    "compensation", ["computer", *(pytest.param(one, marks=by_night) for one in ("control", "wear"))]
)
@pytest.mark.parametrize(("inner", "outer"), [(0.0, 0.003), pytest.param(0.001, 0.004, marks=by_night)])
def test_teeth_lie_between_their_tolerances(compensation, inner, outer):
    """Teeth have what is hard on contours: tips of 0.03 mm, flanks that meet their fillets at slight angles."""
    proof = proof_of_teeth(compensation, path(inner, outer), 0.0)
    assert proof.ok, [check.message for check in proof.failures]
    three_decimals = 5e-4
    assert proof.gouge_max_mm <= inner + three_decimals
    assert proof.leftover_reachable_max_mm <= outer + TOLERANCES.flatten + three_decimals


def test_teeth_with_play_under_compensation_at_the_control():
    proof = proof_of_teeth("control", path(0.0, 0.004), None)
    assert proof.ok, [check.message for check in proof.failures]


def test_tolerances_that_contradict_are_refused():
    with pytest.raises(ValidationError, match=r"outer_tolerance 0.003 is below inner_tolerance 0.004"):
        PathSettings(inner_tolerance=0.004, outer_tolerance=0.003)
    with pytest.raises(ValidationError, match=r"together below 0.003, .* give outer_tolerance 0.0025"):
        PathSettings(inner_tolerance=0.0005, outer_tolerance=0.002)
    assert PathSettings(inner_tolerance=0.0005, outer_tolerance=0.0025).tolerance == pytest.approx(0.001)
    for wrong in ({"inner_tolerance": 0.005}, {"outer_tolerance": 0.0014}, {"lines_per_arc": 0}):
        with pytest.raises(ValidationError):
            PathSettings.model_validate(wrong)
