"""Planetary sets: speeds by the pitch points, sets that are put together, and what is refused."""

import math

import numpy as np
import pytest
import shapely
from by_night import examples
from hypothesis import given
from hypothesis import strategies as st

from mechwright import Severity, Stage
from mechwright.contracts.evaluation import Batch
from mechwright_spur_gears.family import SpurGears
from mechwright_spur_gears.gear_table import MEMBERS, UNEVEN, table_of
from mechwright_spur_gears.parameters import SpurGearParams

GEARS = SpurGears()
ROLES = [(fixed, driving) for fixed in MEMBERS for driving in MEMBERS if fixed != driving]


def planetary(**given):
    return SpurGearParams(arrangement="planetary", **given)


def codes(**given):
    return {one.code for one in GEARS.check(planetary(**given)) if one.severity is Severity.ERROR}


@pytest.mark.parametrize(("fixed", "driving"), ROLES)
@pytest.mark.parametrize("teeth", [(24, 18, 60), (20, 19, 58), (24, 18, 61)])
def test_pitch_points_of_two_gears_have_one_velocity(fixed, driving, teeth):
    """Found from the velocities of both bodies on the operating pitch circles, without Willis."""
    sun, planet, ring = teeth
    given = {"teeth": sun, "mate_teeth": planet, "ring_teeth": ring, "planet_spacing": "nearest"}
    m = table_of(planetary(fixed_member=fixed, driving_member=driving, **given))
    rates = {name: float(m.rate(name)) for name in (*MEMBERS, "planet")}
    assert rates[fixed] == 0
    assert rates[driving] == 1
    assert rates[m.driven] == pytest.approx(float(m.ratio))
    away, centre = float(m.distance), rates["carrier"] * float(m.distance)
    for pair, name, sign in ((m.meshes[0], "sun", -1), (m.meshes[1], "ring", 1)):
        own = float(pair.operating(1 if name == "sun" else 0))
        assert (away + sign * own) * rates[name] == pytest.approx(centre + sign * own * rates["planet"])


def test_known_ratios():
    """Sun 24, ring 60: 1 + z_r/z_s = 3.5 with the ring at rest, -z_r/z_s = -2.5 with the carrier at rest."""
    base = {"teeth": 24, "mate_teeth": 18}
    assert 1 / float(table_of(planetary(**base)).ratio) == pytest.approx(3.5)
    assert 1 / float(table_of(planetary(**base, fixed_member="carrier")).ratio) == pytest.approx(-2.5)
    at_rest = planetary(**base, fixed_member="sun")
    assert at_rest.driving_member == "carrier"
    assert float(table_of(at_rest).ratio) == pytest.approx(1 + 24 / 60)


def random_set(rng):
    """A set that passes all rules but the mesh proof."""
    while True:
        sun, planet = int(rng.integers(14, 40)), int(rng.integers(14, 40))
        params = planetary(
            teeth=sun,
            mate_teeth=planet,
            ring_teeth=sun + 2 * planet + int(rng.integers(-1, 2)),
            planets=int(rng.integers(2, 6)),
            planet_spacing=str(rng.choice(["equal", "nearest"])),
            fixed_member=str(rng.choice(["ring", "carrier"])),
            module=float(rng.uniform(0.8, 3)),
            backlash=0.03,
            bore=0,
        )
        found = {one.code for one in GEARS.judge(params) if one.severity is Severity.ERROR}
        if found <= {"gear.backlash"}:
            return params


@pytest.mark.parametrize("seed", range(examples(10, 100)))
def test_sets_are_put_together_without_collision(seed):
    """All meshes at once, at places of a period, with parts and poses as they are given out."""
    params = random_set(np.random.default_rng([31, seed]))
    m = table_of(params)
    from mechwright_spur_gears.kinematics.motion import motion_of
    from mechwright_spur_gears.parts.parts import parts_of

    motion = motion_of(m, 23 * 31 + 1)
    shapes = {part.name: part.outline.polygon() for part in parts_of(m) if part.outline is not None}
    allowed = 2e-3 * float(m.pair.module)
    for place in range(0, 23 * 31, 101):
        put = {}
        for body, poses in motion.poses.items():
            shape = shapes.get(body.split("-")[0])
            if shape is None or body == "carrier":
                continue
            (x, y, _), turned = poses.position[place], poses.rotation[place]
            matrix = [turned[0, 0], turned[0, 1], turned[1, 0], turned[1, 1], x, y]
            put[body] = shapely.affinity.affine_transform(shape, matrix)
        assert len(put) == params.planets + 2
        names = sorted(put)
        for one, two in ((a, b) for k, a in enumerate(names) for b in names[k + 1 :]):
            assert shapely.area(shapely.intersection(put[one], put[two])) < allowed, (params, one, two)


def test_planets_that_stand_a_hair_aside_collide():
    """The test above bites: half a pitch of the sun is seen."""
    m = table_of(planetary(teeth=24, mate_teeth=18, bore=0))
    from mechwright_spur_gears.kinematics.motion import starts
    from mechwright_spur_gears.parts.parts import parts_of

    shapes = {part.name: part.outline.polygon() for part in parts_of(m) if part.outline is not None}
    found = []
    for off in (0.0, 0.5 * math.tau / 18):
        planet = shapely.affinity.rotate(
            shapes["planet"], starts(m)["planet-1"] + off, origin=(0, 0), use_radians=True
        )
        planet = shapely.affinity.translate(planet, float(m.distance), 0)
        found.append(shapely.area(shapely.intersection(planet, shapes["sun"])))
    assert found[0] < 1e-3 < found[1]


@pytest.mark.parametrize(
    ("code", "given"),
    [
        ("gear.coaxial", {"teeth": 24, "mate_teeth": 18, "ring_teeth": 66}),
        ("gear.assembly", {"teeth": 20, "mate_teeth": 20}),
        ("gear.planets", {"teeth": 18, "mate_teeth": 36, "planets": 4}),
        ("gear.undercut", {"teeth": 12, "mate_teeth": 18, "shift": 0.0}),
        ("bore.rim", {"teeth": 24, "mate_teeth": 18, "pin_diameter": 28.0}),
        ("carrier.wall", {"teeth": 24, "mate_teeth": 18, "module": 0.5, "bore": 9.5, "pin_diameter": 6.5}),
        ("gear.pin", {"teeth": 24, "mate_teeth": 18, "pin_diameter": 2.0, "load_torque": 20.0}),
    ],
)
def test_what_is_wrong_with_a_set_is_named_and_mended(code, given):
    found = [one for one in GEARS.check(planetary(**given)) if one.severity is Severity.ERROR]
    assert code in {one.code for one in found}
    first = next(one for one in found if one.code == code)
    assert first.remedy
    for change in first.proposed:
        changed = {**given, **{key.removeprefix("parameters."): value for key, value in change.items()}}
        assert code not in codes(**{key: value for key, value in changed.items() if value is not None})


@given(
    sun=st.integers(12, 60), planet=st.integers(12, 60), planets=st.integers(2, 8), more=st.integers(-2, 2)
)
def test_planets_stand_where_all_their_teeth_mesh(sun, planet, planets, more):
    """Their angles are multiples of the pitch of sun and ring together, and equal where that goes."""
    given = {"teeth": sun, "mate_teeth": planet, "ring_teeth": sun + 2 * planet + more}
    m = table_of(planetary(**given, planets=planets, planet_spacing="nearest"))
    whole = 2 * sun + 2 * planet + more
    steps = m.places[0] * whole / math.tau
    np.testing.assert_allclose(steps, np.round(steps), atol=1e-9)
    np.testing.assert_allclose(
        m.places[0], math.tau * np.arange(planets) / planets, atol=math.pi / whole + 1e-9
    )
    if whole % planets == 0:
        np.testing.assert_allclose(m.places[0], math.tau * np.arange(planets) / planets, atol=1e-12)


def test_torques_of_all_members_add_up_and_carry_the_power():
    given = {"ring_teeth": 61, "planet_spacing": "nearest", "planets": 4, "load_torque": 5.0}
    m = table_of(planetary(teeth=24, mate_teeth=18, **given))
    sun, ring, carrier = (float(m.lever(name)) for name in MEMBERS)
    assert carrier == pytest.approx(sun + ring)
    # Base radii are as numbers of teeth, so that the power of all torques is none.
    assert sun * float(m.rate("sun")) + ring * float(m.rate("ring")) == pytest.approx(
        carrier * float(m.rate("carrier"))
    )
    assert 4 * float(m.normal_force) / UNEVEN * carrier == pytest.approx(5000.0)


def test_tables_of_sets_are_judged_as_each_alone():
    rng, size = np.random.default_rng(5), 240
    varied = {
        "teeth": rng.integers(12, 40, size),
        "mate_teeth": rng.integers(12, 40, size),
        "module": rng.uniform(0.6, 4.0, size),
        "shift": rng.uniform(-0.2, 0.5, size),
        "load_torque": rng.uniform(0, 100, size),
    }
    batch = Batch(SpurGearParams, {"arrangement": "planetary"}, varied)
    found = GEARS.evaluate(batch, ("contact_ratio_ring", "ratio", "planet_gap"), Stage.PARTS)
    for place in range(0, size, 6):
        one = planetary(
            **{
                name: int(values[place]) if name.endswith("teeth") else float(values[place])
                for name, values in varied.items()
            }
        )
        wrong = [
            f for f in GEARS.judge(one) if f.severity is Severity.ERROR and not f.stage.is_after(Stage.PARTS)
        ]
        assert found.codes[found.forbidden[place]] == (wrong[0].code if wrong else "")
        if not wrong:
            m = table_of(one)
            assert found.values["contact_ratio_ring"][place] == pytest.approx(
                float(m.meshes[1].contact_ratio)
            )
            assert found.values["ratio"][place] == pytest.approx(float(m.ratio))


def test_a_planet_is_one_gear_in_both_meshes():
    m = table_of(planetary(teeth=16, mate_teeth=18, shift=0.5, mate_shift=0.4, ring_teeth=53))
    outer, inner = m.meshes
    assert outer.shortening > 0.05
    for size in ("tip", "root", "thickness", "base"):
        assert float(getattr(outer, size)(1)) == pytest.approx(float(getattr(inner, size)(0)), rel=1e-9)
    assert float(outer.distance) == pytest.approx(float(-inner.distance), rel=1e-9)


def test_members_are_not_both_fixed_and_driving():
    with pytest.raises(ValueError, match='fixed_member and driving_member are both "sun"'):
        planetary(fixed_member="sun", driving_member="sun")
    with pytest.raises(ValueError, match='planets is for arrangement = "planetary"'):
        SpurGearParams(planets=4)
