"""Roughing stops above the floor of a recess; a pass of its own takes the rest, before the walls."""

import math

import numpy as np
import pytest
from by_control import posted, prove
from by_night import examples
from height_map import Simulation, cutters, read
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from planning_parts import bore, job, part, plate, rounded_box
from planning_simulation import check_rules, leftover, motions
from random_pockets import HIGH, LIBRARY, THICK, WIDE, random_pocket

from mechwright.contracts.part import Bore, Pocket, Profile
from mechwright.errors import MechwrightError
from mechwright.geometry import Loop
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.planning import choose_tools, plan
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.settings import CamSettings

OUTSIDE = Profile("outside", rounded_box(60, 40, 6), "outside", 0, 6.0)
RECESS = Pocket("recess", rounded_box(34, 24, 3), (), 0, 2.0)
RECESSED = plate(machined=(RECESS, OUTSIDE))


def lowest(program):
    """Operation name to the lowest z of its moves."""
    found = {}
    for motion in motions(program):
        found[motion.operation] = min(found.get(motion.operation, 0.0), float(motion.points[:, 2].min()))
    return found


def proven(of):
    program = plan(of)
    text = posted(of, program)
    proof = prove(text, of)
    assert proof.ok, [check.message for check in proof.failures]
    return program, text


@pytest.mark.parametrize("leave", [0.1, 0.3])
@pytest.mark.parametrize("tools", [("mill-6",), ("mill-10", "mill-4")])
def test_roughing_stops_above_the_floor(leave, tools):
    program, _ = proven(job(RECESSED, *tools, floor_to_leave=leave))
    low = {name: z for name, z in lowest(program).items() if name.startswith("recess")}
    rough = [z for name, z in low.items() if "rough" in name]
    assert rough == pytest.approx([-2 + leave] * len(rough))
    rest = [z for name, z in low.items() if "rough" not in name]
    assert rest == pytest.approx([-2.0] * len(rest))
    names = list(low)
    assert (
        names.index("recess: rough") < names.index("recess: finish the floor") < names.index("recess: finish")
    )


def test_nothing_to_leave_is_no_pass():
    program, _ = proven(job(RECESSED, "mill-6", floor_to_leave=0.0))
    low = lowest(program)
    assert low["recess: rough"] == pytest.approx(-2.0)
    assert not any("floor" in name for name in low)


def test_a_shallow_recess_keeps_half_of_its_depth_for_roughing():
    shallow = plate(machined=(Pocket("recess", rounded_box(34, 24, 3), (), 0, 0.3), OUTSIDE))
    program, _ = proven(job(shallow, "mill-6", floor_to_leave=0.2))
    assert lowest(program)["recess: rough"] == pytest.approx(-0.15)


def test_cuts_through_the_plate_have_no_floor():
    opening = Profile("opening", rounded_box(30, 20, 4), "inside", 0, 6.0)
    through = plate(rounded_box(30, 20, 4, clockwise=True), machined=(opening, OUTSIDE))
    texts = [LinuxCnc().write(plan(job(through, "mill-6", floor_to_leave=leave))) for leave in (0.0, 0.5)]
    assert texts[0] == texts[1]


def test_a_face_ends_with_one_even_cut():
    face = Pocket("face", Loop.polygon([(-60, -60), (60, -60), (60, 60), (-60, 60)]), (), 0, 0.5)
    of = plate(bore(8), machined=(face, Bore("bore", (0.0, 0.0), 8.0, 0.0, 6.0), OUTSIDE))
    for leave, heights in ((0.0, [-0.5]), (0.1, [-0.4, -0.5]), (0.4, [-0.25, -0.5])):
        program, _ = proven(job(of, "mill-10", "mill-4", floor_to_leave=leave))
        cuts = [m.points[:, 2] for m in motions(program) if m.operation == "face: face" and m.kind == "feed"]
        level = {round(float(z[0]), 6) for z in cuts if z[0] == z[-1] < 0}
        assert sorted(level, reverse=True) == pytest.approx(heights)


@pytest.mark.parametrize("tools", [("mill-6",), ("mill-3",)])
def test_the_floor_of_a_blind_bore(tools):
    seat = plate(machined=(Bore("seat", (0.0, 0.0), 20.0, 0, 2.0), OUTSIDE))
    of = job(seat, *tools, floor_to_leave=0.25)
    program, text = proven(of)
    assert leftover(of, program) == 0
    check_rules(of, program)
    ends = [m.points[-1, 2] for m in motions(program) if m.operation == "seat: bore" and m.kind == "arc"]
    first = next(k for k, z in enumerate(ends) if z < -1.75 - 1e-6)
    # Once all rings are at the allowance, everything that follows goes down to the floor, and stays there.
    assert all(z < -1.75 for z in ends[first:])
    assert ends[first:] == sorted(ends[first:], reverse=True)
    assert ends[-1] == -2.0
    without = LinuxCnc().write(plan(job(seat, *tools, floor_to_leave=0.0)))
    assert without != text


def test_the_floor_pass_meets_what_was_left_and_no_more():
    of = job(
        part(rounded_box(60, 40, 6), machined=(RECESS,)), "mill-6", stock={"margin": 0}, floor_to_leave=0.3
    )
    moves = read(posted(of))
    seen = Simulation(of.stock, of.thickness, pitch=0.2)
    rough = [m for m in moves if m.operation == "recess: rough"]
    seen.run(rough, cutters(of))
    inner = (np.abs(seen.x) < 13)[None, :] & (np.abs(seen.y) < 8)[:, None]
    assert np.allclose(seen.height[inner], -1.7, atol=1e-6)
    seen.met.clear()
    seen.run([m for m in moves if m.operation == "recess: finish the floor"], cutters(of))
    assert np.allclose(seen.height[inner], -2.0, atol=1e-6)
    table = seen.table()
    assert table[:, 8].max() == pytest.approx(0.3, abs=1e-3)  # depth of the cut, wherever it was
    assert not seen.complaints


@settings(
    max_examples=examples(3, 12),
    deadline=None,
    suppress_health_check=list(HealthCheck),
    phases=[Phase.explicit, Phase.reuse, Phase.generate],
)
@given(
    seed=st.integers(0, 10**9),
    leave=st.floats(0, 2),
    clearing=st.sampled_from(["contour", "adaptive"]),
    climb=st.booleans(),
)
def test_any_recess_with_any_allowance_is_cut_or_refused(seed, leave, clearing, climb):
    x, y = WIDE / 2, HIGH / 2
    outer = Loop.polygon([(-x, -y), (x, -y), (x, y), (-x, y)])
    of = part(outer, thickness=THICK, machined=(random_pocket(np.random.default_rng(seed)),))
    wanted = CamSettings.model_validate(
        {"stock": {"margin": 0}, "floor_to_leave": leave, "clearing": clearing, "climb": climb}
    )
    try:
        made = make_job(of, wanted, choose_tools(of, wanted, LIBRARY))
        program = plan(made)
    except MechwrightError as error:
        assert str(error).startswith(("cam.", "part plate: pocket takes nothing"))  # noqa: PT017
        return
    proof = prove(posted(made, program), made)
    assert proof.ok, [check.message for check in proof.failures]
    check_rules(made, program)
    low = lowest(program)
    depth = of.features[0].depth
    rough = [z for name, z in low.items() if "rough" in name or name.endswith(": clear")]
    assert min(rough, default=0.0) >= -depth + min(leave, depth / 2) - 1e-4
    assert math.isclose(min(low.values()), -depth, abs_tol=1e-4)
