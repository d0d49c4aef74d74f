"""The geared five-bar: reach, gears that mesh in the motion, and a balance of power."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright import Severity
from mechwright.mechanics.gearing import prove_mesh
from mechwright.mechanics.linkage.kinematics.period import period_of
from mechwright_five_bar.defaults.complete_parameters import CompleteParams
from mechwright_five_bar.family import FiveBars
from mechwright_five_bar.kinematics.dimensions import FiveBar
from mechwright_five_bar.kinematics.loads import forces_of, loads_of
from mechwright_five_bar.kinematics.reach import reach, transmission_range, turns_fully
from mechwright_five_bar.kinematics.train import gear_outlines, rack_of, train_of
from mechwright_five_bar.parts.bodies import masses_of
from mechwright_five_bar.table import FiveBarTable

FAMILY = FiveBars()
LENGTH = st.floats(10, 100)


@given(
    lengths=st.tuples(LENGTH, LENGTH, LENGTH, LENGTH, LENGTH),
    offset=st.floats(-3, 3),
    teeth=st.sampled_from([(20, 40), (20, 20), (40, 20), (20, 30)]),
    sense=st.sampled_from([1, -1]),
    least=st.floats(0.0, 0.5),
)
@settings(deadline=None, max_examples=60)
def test_reach_is_where_the_links_close(lengths, offset, teeth, sense, least):
    bar = FiveBar(*lengths, 0.3, offset, teeth, sense)
    theta = np.linspace(0, math.tau * bar.turns, 2000, endpoint=False)
    c, l = bar.coupler, bar.rocker
    cosine = (c * c + l * l - bar.squared_distance(theta)) / (2 * c * l)
    good = np.abs(cosine) <= math.cos(least)
    inside = np.zeros_like(good)
    for low, high in reach(bar, least):
        for turn in (0.0, math.tau * bar.turns):
            inside |= (theta + turn >= low - 1e-9) & (theta + turn <= high + 1e-9)
    near = np.abs(np.abs(cosine) - math.cos(least)) < 1e-6
    assert (inside == good)[~near].all()
    if turns_fully(bar, least):
        angles = np.arccos(np.minimum(1, np.abs(cosine)))
        low, high = transmission_range(bar, 0.0, math.tau * bar.turns)
        assert low <= angles.min() + 1e-12
        assert low == pytest.approx(angles.min(), abs=2e-2)
        assert high >= angles.max() - 1e-12


TRAINS = (
    CompleteParams(),
    CompleteParams(module=2.3, ground_angle=25),
    CompleteParams(idler_teeth=0, arm_teeth=20, crank=12, arm=12, ground_angle=-40),
)


@pytest.mark.parametrize("params", TRAINS, ids=["in line", "aside", "against"])
def test_the_gears_mesh_wherever_the_crank_stands(params):
    """As they stand in the motion they touch nowhere, and turned by a little more than the play they do."""
    motion, train = FAMILY.solve(params, 37), train_of(params)
    shapes = {name: np.asarray(loop.flatten(0.002)) for name, loop in gear_outlines(params).items()}
    bodies = {name: motion.poses["crank" if name == "pinion" else name] for name in shapes}
    for one, two in train.meshes():
        for k in range(0, 37, 5):
            areas = [
                shapely.Polygon(
                    shapes[name] @ bodies[name].rotation[k, :2, :2].T + bodies[name].position[k, :2]
                )
                for name in (one, two)
            ]
            assert shapely.intersection(*areas).area < 1e-6
            axis = bodies[two].position[k, :2]
            play = params.backlash / train.radius(two)
            for turn in (1.5 * play, -1.5 * play):
                turned = shapely.affinity.rotate(areas[1], turn, tuple(axis), use_radians=True)
                assert shapely.intersection(areas[0], turned).area > 1e-4


def test_the_teeth_run_without_an_error():
    params = CompleteParams()
    train, loops = train_of(params), gear_outlines(params)
    outlines = tuple(np.asarray(loops[name].flatten(0.0002)) for name in ("pinion", "idler"))
    pair = train.pair("pinion", "idler")
    proof = prove_mesh(pair, rack_of(params), train.teeth["pinion"], outlines, 0.001)
    assert not proof.collides
    assert proof.flank_error < 0.001
    play = proof.mesh.free_play * train.radius("idler")
    assert play.min() == pytest.approx(params.backlash, abs=0.002)


@pytest.mark.parametrize("changes", [{}, {"load_x": 5.0, "load_y": -3.0}], ids=["free", "loaded"])
def test_the_drive_gives_what_the_masses_and_the_load_take(changes):
    """Torque times speed is the rate of the kinetic energy less the power of the load."""
    params = CompleteParams(**changes)
    m = FiveBarTable.of(params)
    masses = masses_of(m)
    period = period_of(m, 721)
    bodies = {name: period.solution.bodies[name] for name in m.machine.links}
    energy = np.zeros_like(period.time)
    for name, body in bodies.items():
        mass = masses[name]
        energy += mass.mass / 2 * np.abs(body.point(mass.centre).velocity) ** 2
        energy += mass.inertia / 2 * body.turning.omega**2
    energy += (
        masses["idler"].inertia / 2 * (train_of(params).ratio("idler") * bodies["crank"].turning.omega) ** 2
    )
    force = complex(params.load_x, params.load_y) * 1e3  # mN
    taken = (np.conj(force) * bodies["coupler"].point(params.coupler_point).velocity).real
    power = forces_of(m, period.solution, masses)["drive_torque"] * bodies["crank"].turning.omega * 1e6  # µW
    rate = np.gradient(energy, period.time, edge_order=2)
    scale = np.abs(power).max()
    np.testing.assert_allclose(power[2:-2], (rate - taken)[2:-2], rtol=0, atol=2e-3 * scale)


def test_the_arm_turns_by_the_ratio_of_the_teeth():
    motion = FAMILY.solve(CompleteParams(crank_teeth=20, arm_teeth=50, crank=10, arm=10), 101)
    turned = motion.channels["phi"].values - motion.channels["phi"].values[0]
    np.testing.assert_allclose(turned, 0.4 * motion.channels["theta"].values, atol=1e-12)
    assert motion.channels["theta"].values[-1] == pytest.approx(5 * math.tau)


@pytest.mark.parametrize(
    "changes", [{}, {"speed": 900.0}, {"load_x": 100.0}, {"load_y": -40.0, "gear_thickness": 3.0}]
)
def test_a_judge_finds_what_a_check_finds_without_what_would_bear_more(changes):
    params = CompleteParams(**changes)
    told, judged = ([one for one in found if one.code == "five-bar.root"] for found in (
        FAMILY.check(params), FAMILY.judge(params)))  # fmt: skip
    assert told
    graver = [one for one in told if one.severity is not Severity.NOTE]
    assert [(one.severity, one.message, one.value) for one in judged] == [
        (one.severity, one.message, one.value) for one in graver
    ]
    assert not any(one.proposed for one in judged)
    assert any(one.proposed for one in told) == (told[0].severity is not Severity.NOTE)


def test_shapes_and_masses_follow_from_no_load():
    tables = {}, {"speed": 300.0, "load_x": 50.0, "load_y": -20.0}, {"material": "steel"}
    quiet, loud, heavy = (FiveBarTable.of(CompleteParams(**table)) for table in tables)
    assert masses_of(quiet) is masses_of(loud)
    assert loads_of(loud).peaks["force_A"].value > loads_of(quiet).peaks["force_A"].value
    assert masses_of(heavy)["crank"].mass > 2 * masses_of(quiet)["crank"].mass
