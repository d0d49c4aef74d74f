"""The proof over a whole turn, locking, and the relief of the disc."""

import dataclasses
import math

import geneva_printed as printed
import numpy as np
import pytest
import shapely
from by_night import examples
from geneva_turn import prove
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import newton

from mechwright.contracts.finding import Stage, errors
from mechwright.geometry import Loop, Outline, circle
from mechwright.mechanics.laws import LAWS
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.family import Geneva
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.parts.locking_disc import lock_loop

DESIGNS = {
    "reference": {"lock_radius": 70},
    "straight": {"law": "straight"},
    "two rollers": {"law": "straight", "slots": 6, "rollers": 2},
    "prototype": {"entry_radius": 70, "offset_angle": 12, "crank_half_angle": 45},
    "regime B": {
        "entry_radius": 70,
        "offset_angle": -12,
        "crank_half_angle": 45,
        "law": "modified-trapezoid",
    },
    "backed": {"construction": "backed", "fixing": 2.5},
    "no clearance": {"groove_clearance": 0},
    "three slots": {"slots": 3, "law": "modified-sine"},
}


def play_after(m, after):
    """Play in the dwell, rad, at a crank angle from its nearer end.

    Where the disc does not cover both horns, the end of its arc meets the concave arc, which turns by t about
    the wheel's axis: abs(R_L d - a (exp(it) - 1)) = R_L + c, d the direction of the arc's end.
    """
    eta = min(after, m.pitch - 2 * m.crank_half - after)
    if eta >= m.arc_half:
        return m.lock_play(m.arc, m.lock)

    def miss(turn):
        x = -m.lock * math.cos(eta) - m.axes * (math.cos(turn) - 1)
        return math.hypot(x, -m.lock * math.sin(eta) - m.axes * math.sin(turn)) - m.arc

    return newton(miss, m.params.lock_clearance / (m.axes * math.sin(eta)))


def proof_of(table):
    params = GenevaParams(**table)
    return mechanism_of(params), prove(mechanism_of(params), Geneva().parts(params))


@pytest.mark.parametrize("table", DESIGNS.values(), ids=DESIGNS)
def test_nothing_overlaps_and_the_wheel_is_locked(table):
    m, proof = proof_of(table)
    assert proof.clean, proof
    # The roller's gap is half the clearance, next to the wall it does not push.
    assert -proof.roller_depth == pytest.approx(m.params.groove_clearance / 2, abs=proof.allowance)
    assert proof.lock_depth == 0
    # The disc's closed form is an upper limit, and exact where both horns are covered.
    limit = np.array([play_after(m, after) for after in proof.dwell])
    assert (proof.play <= limit * 1.02 + 1e-5).all()
    inner = np.minimum(proof.dwell, m.pitch - 2 * m.crank_half - proof.dwell) > m.arc_half
    assert proof.play[inner] == pytest.approx(limit[inner], rel=0.03)
    assert proof.play.max() < math.radians(0.5)


def changed(parts, name, outline):
    return [dataclasses.replace(part, outline=outline) if part.name == name else part for part in parts]


def test_the_proof_sees_a_disc_without_relief():
    params = GenevaParams(lock_radius=70)
    parts = Geneva().parts(params)
    round_disc = Outline(Loop((circle((0, 0), 70.0),)))
    proof = prove(mechanism_of(params), changed(parts, "locking-disc", round_disc))
    assert not proof.clean
    assert proof.lock_depth > 20


def test_the_proof_sees_the_simple_relief_circle():
    """A circle of radius l about a point a on the crank line, as is often drawn, is not enough: 100.975 mm."""
    params = GenevaParams(lock_radius=70)
    m, parts = mechanism_of(params), Geneva().parts(params)
    angle = m.crank_half
    for radius, enough in ((m.rim, False), (101.1, True)):
        disc = shapely.Point(0, 0).buffer(m.lock, quad_segs=512)
        sector = shapely.Polygon(
            [(0, 0), *(200 * np.array([math.cos(t), math.sin(t)]) for t in (-angle, angle))]
        )
        cut = disc.difference(shapely.Point(m.axes, 0).buffer(radius, quad_segs=512).intersection(sector))
        outline = Outline(Loop.polygon(shapely.get_coordinates(shapely.orient_polygons(cut).exterior)[:-1]))
        proof = prove(m, changed(parts, "locking-disc", outline))
        assert (proof.lock_depth <= 0.002) == enough, (radius, proof.lock_depth)


def test_the_proof_sees_a_roller_that_is_too_large():
    params = GenevaParams(groove_clearance=0)
    larger = mechanism_of(params.model_copy(update={"roller_radius": 5.01}))
    proof = prove(larger, Geneva().parts(params))
    assert not proof.clean
    assert proof.roller_depth == pytest.approx(0.01, abs=0.002)


def test_the_proof_sees_the_printed_wall():
    """A groove along the source's printed wall stands in the roller's way by millimetres."""
    from mechwright_geneva.kinematics.geometry import LEFT, RIGHT

    params = GenevaParams(law="3-4-5", groove_clearance=0)
    m = mechanism_of(params)
    u = np.linspace(0, 1, 401)
    walls = [printed.wall(m.frame, m.law, u, m.groove, side) for side in (LEFT, RIGHT)]
    ring = np.concatenate((walls[0], walls[1][::-1]))
    shape = shapely.Polygon(np.column_stack((ring.real, ring.imag)))
    way = m.stroke(np.linspace(0, 1, 201)).track
    outside = shapely.distance(shapely.boundary(shape), shapely.points(way.real, way.imag))
    assert (m.roller - outside).max() > 0.5


@st.composite
def tables(draw):
    slots = draw(st.integers(3, 8))
    law = draw(st.sampled_from([*LAWS, "straight"]))
    table = {
        "slots": slots,
        "law": law,
        "roller_radius": draw(st.floats(2, 7)),
        "entry_radius": draw(st.floats(80, 160)),
        "pin_diameter": 2.0,
        "bore": draw(st.floats(0, 14)),
        "driver_bore": draw(st.floats(0, 8)),
        "groove_clearance": draw(st.floats(0, 0.3)),
        "lock_clearance": draw(st.floats(0.02, 0.4)),
        "rollers": draw(st.sampled_from([1, 1, 2])),
        "fixing": 2.0,
        "least_wall": 1.0,
    }
    if law != "straight":
        table["crank_half_angle"] = draw(st.floats(0.8, 1.25)) * (90 - 180 / slots)
        table["offset_angle"] = draw(st.floats(2, 14)) * draw(st.sampled_from([1, -1]))
    return table


@settings(deadline=None, max_examples=examples(4, 24))
@given(tables())
def test_a_design_that_check_calls_clean_has_no_overlap(table):
    params = GenevaParams(**table)
    assume(not errors(Geneva().check(params), Stage.PARTS))
    m = mechanism_of(params)
    proof = prove(m, Geneva().parts(params))
    assert proof.clean, proof


@pytest.mark.parametrize("table", DESIGNS.values(), ids=DESIGNS)
def test_the_relief_is_the_exact_sweep(table):
    """In every direction the disc ends where the wheel, grown by the clearance, comes nearest: by rays."""
    m = mechanism_of(GenevaParams(**table))
    loop, deviation = lock_loop(m)
    edge = shapely.Polygon(loop.flatten(1e-4))
    run = m.stroke(np.linspace(0, 1, 1501))
    rim = m.rim + m.params.lock_clearance
    chi = np.linspace(-m.crank_half, m.crank_half, 61)[1:-1]
    nearest = np.full(chi.shape, m.lock)
    for k, direction in enumerate(chi):
        ray = -np.exp(1j * (direction + run.phi))  # from the crank's axis, fixed frame
        foot = m.axes * ray.real
        inside = rim**2 - m.axes**2 + foot**2
        # Into the grown wheel at the rim, unless that place lies in a bite: then where the ray leaves the bite.
        enters = np.where(inside > 0, -foot - np.sqrt(np.maximum(inside, 0)), np.inf)
        leaves = np.where(inside > 0, -foot + np.sqrt(np.maximum(inside, 0)), -np.inf)
        hit = np.where(enters > 0, enters, np.inf)
        for turn in (0, -2 * m.wheel_half, 2 * m.wheel_half):
            centre = m.axes * np.exp(1j * (run.theta + turn)) - m.axes
            along = (np.conj(centre) * ray).real
            room = m.lock**2 - np.abs(centre) ** 2 + along**2
            root = np.sqrt(np.maximum(room, 0))
            swallowed = (room > 0) & (along - root < hit) & (hit < along + root)
            hit = np.where(swallowed, np.where(along + root < leaves, along + root, np.inf), hit)
        nearest[k] = min(m.lock, float(hit.min()))
    length = []
    for direction in chi:
        ray = shapely.LineString(
            [(0, 0), (2 * m.lock * math.cos(direction), 2 * m.lock * math.sin(direction))]
        )
        # Where the ray first leaves the disc: behind it the disc may hook round the horn's path.
        length.append(
            shapely.distance(shapely.Point(0, 0), shapely.intersection(ray, shapely.boundary(edge)))
        )
    # Never beyond what the sweep leaves; and not more taken away than the sweep takes, give or take a sample.
    assert (np.array(length) <= nearest + deviation + 0.02).all()
    assert (np.array(length) >= nearest - deviation - 0.25).all()
