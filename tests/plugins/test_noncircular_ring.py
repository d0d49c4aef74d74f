"""A gear in a ring: pitch curves, the phase, the solid's teeth, and what is refused."""

import math

import numpy as np
import pytest
from noncircular import design

from mechwright import DesignError, MountingError, Stage
from mechwright.contracts.finding import errors
from mechwright.mechanics.gearing import Primitive, mesh, prove_mesh
from mechwright_noncircular_gears.family import NoncircularGears
from mechwright_noncircular_gears.kinematics.law import law_of
from mechwright_noncircular_gears.kinematics.motion import motion_of
from mechwright_noncircular_gears.parts.parts import parts_of
from mechwright_noncircular_gears.sized import SizedParams
from mechwright_noncircular_gears.table import table_of

FAMILY = NoncircularGears()
SMALL = {"teeth": 16, "mate_lobes": 2, "addendum": 0.5, "tip_radius": 0.05, "shaper_radius": 6, "bore": 4}


def ring(**changes):
    return design("D5", **{"backlash": None, **changes})


def test_the_pair_meshes_and_off_its_phase_it_does_not():
    params = ring()
    one, two = table_of(params).outlines
    outlines = one.outer.flatten(2e-5), two.inner[0].flatten(2e-5)
    found = prove_mesh(table_of(params).pair, table_of(params).rack, params.teeth, outlines, 1e-3)
    assert not found.collides
    assert found.error < 5e-6
    # The gap is that of the backlash all the way: no tip stands free, and none jams.
    normal = table_of(params).rack.backlash / 2 * math.cos(table_of(params).rack.pressure_angle)
    assert found.mesh.gap.min() == pytest.approx(normal, abs=2e-4)
    # Turned by a little more than the play, flanks of one side stand in each other in every position.
    turned = two.inner[0].moved(0.0, 0.0, 1.1 * found.mesh.ahead.max()).flatten(1e-3)
    off = mesh(
        one.outer.flatten(1e-3), turned, table_of(params).pair, params.teeth, positions=12, allowance=1e-3
    )
    assert off.ahead.max() < 0
    assert (off.depth > 1e-3).all()
    assert off.overlap > 0.001


@pytest.mark.parametrize("law", ["ellipse", "limacon", "eccentric-circle"])
@pytest.mark.parametrize("mates", [2, 5])
def test_pitch_curves_close_in_a_ring(law, mates):
    params = ring(law=law, mate_lobes=mates)
    found = law_of(params)
    turned = Primitive.of(lambda phi: found.rates(phi)[0], found.period).total
    assert turned == pytest.approx(math.tau / mates, rel=1e-13)
    phi = np.linspace(0.0, math.tau, 33)
    r1, r2 = table_of(params).pair.pitch_radii(phi)
    shape = found.radius(phi)[0]
    assert r1 / r1[0] == pytest.approx(shape / shape[0], rel=1e-12)
    assert r2 - r1 == pytest.approx(table_of(params).pair.distance, rel=1e-13)


def test_both_turn_the_same_way_round():
    motion = motion_of(table_of(ring()), 361)
    theta1, theta2 = (motion.channels[name].values for name in ("theta1", "theta2"))
    assert theta1[-1] == pytest.approx(3 * math.tau)
    assert theta2[-1] == pytest.approx(math.tau)
    assert motion.channels["omega2"].values.min() > 0


def test_the_ring_has_its_teeth_holes_and_rim():
    params = ring(ring_holes=4, ring_hole=6.6, ring_outside=190)
    driver, outer = parts_of(table_of(params))
    assert [one.name for one in outer.machined] == [
        "hole-1",
        "hole-2",
        "hole-3",
        "hole-4",
        "teeth",
        "outside",
    ]
    rim = table_of(params).ring_plate
    assert outer.outline.area == pytest.approx(
        math.pi * (95**2 - 4 * 3.3**2) - -outer.outline.inner[0].area, rel=1e-9
    )
    assert all(math.hypot(*one.centre) == pytest.approx(rim.circle) for one in outer.machined[:4])
    assert rim.root + rim.wall / 2 + 3.3 == pytest.approx(rim.circle)
    assert driver.machined[0].name == "bore"
    # Each mark of the ring stands under a tooth, outside of its root, and the mark of the gear between them.
    one, two = (np.array(part.marks[0].dots) for part in (driver, outer))
    at = -math.atan2(one[0, 1], one[0, 0])
    theta2 = table_of(params).pair.law(np.array(at))[0]
    space = np.exp(1j * theta2) * (two[:, 0] + 1j * two[:, 1])
    assert np.abs(np.angle(space)) == pytest.approx(math.pi / params.mate_teeth, rel=0.2)
    assert np.prod(np.angle(space)) < 0


@pytest.mark.parametrize("offset", [0.0, 0.2, 0.7])
@pytest.mark.parametrize("name", ["D3", "D5"])
def test_marks_meet_wherever_the_teeth_stand(name, offset):
    params = design(name, tooth_offset=offset, backlash=None)
    driver, driven = parts_of(table_of(params))
    x, y = driver.marks[0].dots[0]
    at = -math.atan2(y, x)
    theta2 = float(table_of(params).pair.law(np.array(at))[0])
    dots = np.array([complex(*dot) for dot in driven.marks[0].dots]) * np.exp(1j * theta2)
    towards = np.angle(dots * (-params.side))
    assert np.abs(towards).max() < 1.6 * math.pi / params.mate_teeth
    assert towards.prod() < 0


def test_the_fillets_of_the_ring_are_its_tightest():
    """By hand: the path of the cutter's tip arc, measured where the ring is hollow the most."""
    params = ring()
    radii = []
    for teeth in table_of(params).teeth:
        x = teeth.arc_centres
        step = np.array([-1e-3, 0.0, 1e-3]) * teeth.rack.module
        points = teeth.rack.fillet(teeth.curve.frame_at(x[..., None] + step), x[..., None])
        first = (points[..., 2, :] - points[..., 0, :]) / 2
        second = points[..., 2, :] - 2 * points[..., 1, :] + points[..., 0, :]
        bend = np.abs(first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0])
        radii.append(((first**2).sum(axis=-1) ** 1.5 / bend).min())
    assert table_of(params).fillet_mill == pytest.approx(2 * min(radii), rel=1e-3)


@pytest.mark.parametrize(
    ("table", "code", "key"),
    [
        ({"law": "fourier", "mate_lobes": 2, "sines": [40.0]}, "law.ring", "sines"),
        ({"ring_addendum": 0.85}, "gear.tip-fillet", "ring_addendum"),
        ({"addendum": 1.15}, "gear.tip-fillet", "addendum"),
        ({**SMALL, "ring_addendum": 1.2}, "gear.tip-cusp", "ring_addendum"),
        ({"shaper_radius": 30}, "gear.convexity", ""),
        ({"ring_outside": 158, "ring_holes": 0}, "ring.rim", "ring_outside"),
        ({"ring_hole": 20, "ring_outside": 200}, "ring.rim", "ring_outside"),
        ({"ring_holes": 24, "ring_hole": 23}, "ring.holes", "ring_holes"),
    ],
)
def test_what_no_ring_can_be_is_named_and_mended(table, code, key):
    params = ring(**{"eccentricity": None if "law" in table else 0.15, **table})
    found = errors(FAMILY.check(params), Stage.MACHINING)
    assert [one.code for one in found] == [code]
    assert [one.code for one in errors(FAMILY.judge(params), Stage.MACHINING)] == [code]
    if key:
        changes = {name.removeprefix("parameters."): value for name, value in found[0].proposed[0].items()}
        assert key in changes
        mended = SizedParams.model_validate({**params.model_dump(), **changes})
        assert code not in [one.code for one in errors(FAMILY.judge(mended), Stage.MACHINING)]


def test_heights_are_those_of_each_gear():
    one, two = (teeth.rack for teeth in table_of(ring(ring_addendum=0.5)).teeth)
    assert (one.addendum, two.addendum) == pytest.approx((1.6, 1.0))
    assert two.dedendum == one.dedendum


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"mate_lobes": 1}, "set mate_lobes to 2 or more"),
        ({"law": "geneva", "eccentricity": None}, "set internal = false and mate_lobes = 1"),
        ({"cutter": "rack"}, "no rack goes into a ring"),
        ({"ring_holes": 0, "ring_hole": 5.0}, "leave it out, or set ring_holes"),
        ({"internal": False, "ring_outside": 200.0}, "set internal = true"),
    ],
)
def test_tables_that_contradict_themselves(changes, words):
    with pytest.raises(ValueError, match=words):
        ring(**changes)


def test_a_ring_has_no_shaft():
    with pytest.raises((MountingError, DesignError), match="screwed to what turns with it"):
        FAMILY.mounting(ring())


def test_a_ring_is_in_balance_and_the_gear_in_it_is_not():
    gear, outer = (one for one in FAMILY.check(ring()) if one.code == "gear.balance")
    assert "mm of unbalance" in gear.message
    assert outer.message.endswith("about its axis, its middle on it")


def test_a_driver_without_room_in_its_ring_is_told_by_the_pitch_curves_with_the_nearest_law():
    """Its teeth were run against the ring's for minutes until a remedy was found."""
    wide = SizedParams(
        law="ratio",
        ratio="exp(-0.37*cos(phi) + 0.11*sin(2*phi))",
        teeth=36,
        mate_lobes=2,
        internal=True,
        bore=4,
    )
    assert table_of(wide).collides
    (found,) = errors(FAMILY.check(wide), Stage.PARTS)
    assert found.code == "gear.ring-room"
    assert found.value > 10 * found.limit
    (change,) = found.proposed
    mended = wide.model_copy(update={"ratio": change["parameters.ratio"]})
    assert mended.ratio in found.remedy
    assert not table_of(mended).collides
    assert not errors(FAMILY.judge(mended), Stage.PARTS)


def test_a_collision_ends_the_proof_where_it_is_seen():
    params = ring()
    one, two = table_of(params).outlines
    outlines = one.outer.flatten(1e-3), two.inner[0].moved(0.0, 0.0, 0.05).flatten(1e-3)
    whole, first = (
        mesh(*outlines, table_of(params).pair, params.teeth, allowance=1e-3, stop=stop)
        for stop in (False, True)
    )
    assert 10 < first.arc.size < whole.arc.size / 5
    assert 1e-3 < first.depth.max() <= whole.depth.max()
    seen = np.searchsorted(whole.arc, first.arc)
    for name in ("arc", "ahead", "behind", "depth"):
        assert getattr(whole, name)[seen] == pytest.approx(getattr(first, name), abs=1e-12)


def test_a_pair_that_meshes_is_told_no_other_law():
    assert [one.remedy for one in FAMILY.check(ring()) if one.code == "gear.mesh"] == [""]
