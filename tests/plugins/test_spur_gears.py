"""Spur gears: closed forms of the involute, shifts that are chosen, rules, and the pair as it runs."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from mechwright import Severity, Stage
from mechwright.contracts.evaluation import Batch
from mechwright.mechanics.gearing.cut import larger_teeth
from mechwright.mechanics.gearing.involute import (
    InvolutePair,
    angle_of_involute,
    involute,
    least_shift,
    sum_of_shifts,
)
from mechwright.mechanics.gearing.over_pins import pins_in
from mechwright.mechanics.strength.tooth_bending import form_factors
from mechwright_spur_gears.family import SpurGears
from mechwright_spur_gears.gear_table import table_of
from mechwright_spur_gears.parameters import SpurGearParams
from mechwright_spur_gears.parts.teeth import operating_teeth, prove, teeth_of

DATA = json.loads((Path(__file__).parents[1] / "data" / "gear-sizes.json").read_text())
GEARS = SpurGears()

PAIRS = {
    "z1": st.integers(8, 150),
    "z2": st.integers(8, 300),
    "module": st.floats(0.3, 10),
    "degrees": st.floats(14.5, 30),
    "x1": st.floats(-0.3, 0.8),
    "x2": st.floats(-0.3, 0.8),
    "backlash": st.floats(0, 0.05),
}


def pair(z1, z2, module, degrees, x1, x2, backlash):
    return InvolutePair(module, math.radians(degrees), (z1, z2), (x1, x2), backlash=backlash * module)


def codes(severity=Severity.ERROR, **given):
    return {one.code for one in GEARS.check(SpurGearParams(**given)) if one.severity is severity}


@given(**PAIRS)
def test_teeth_fill_the_operating_pitch_circles_but_for_the_backlash(**given):
    one = pair(**given)
    assume(np.isfinite(one.operating_angle))
    pitch = math.tau * one.operating(0) / one.teeth[0]
    filled = sum(one.thickness_at(gear, one.operating(gear)) for gear in (0, 1))
    assert filled == pytest.approx(pitch - one.backlash, rel=1e-9)
    assert one.operating(0) + one.operating(1) == pytest.approx(one.distance, rel=1e-12)
    assert one.operating(0) * np.cos(one.operating_angle) == pytest.approx(one.base(0), rel=1e-9)


@given(**PAIRS)
def test_the_sum_of_shifts_is_that_of_the_centre_distance(**given):
    one = pair(**given)
    assume(np.isfinite(one.operating_angle))
    found = sum_of_shifts(one.teeth, one.module, one.angle, float(one.distance))
    assert found == pytest.approx(given["x1"] + given["x2"], abs=1e-6 * (given["z1"] + given["z2"]))


@given(**PAIRS)
def test_clearance_stays_that_of_the_rack(**given):
    one = pair(**given)
    assume(np.isfinite(one.operating_angle))
    for gear in (0, 1):
        left = one.distance - one.tip(gear) - one.root(1 - gear)
        assert left == pytest.approx(0.25 * one.module, abs=1e-8 * one.distance)


@given(value=st.floats(1e-9, 2.0))
def test_the_angle_of_an_involute_is_its_inverse(value):
    assert involute(angle_of_involute(value)) == pytest.approx(value, rel=1e-9)


@pytest.mark.parametrize("case", DATA["involute"], ids=lambda case: f"z{case['z']}")
def test_gears_have_the_sizes_of_the_reference(case):
    params = SpurGearParams(
        teeth=case["z"],
        mate_teeth=60,
        module=case["module"],
        pressure_angle=case["alpha"],
        shift=case["x"],
        mate_shift=-case["x"],
        backlash=case["pair_backlash"],
        tip_radius=0.2,
    )
    m = table_of(params)
    assert 2 * m.pair.tip(0) == pytest.approx(case["tip_diameter"], abs=1e-9)
    assert 2 * m.pair.root(0) == pytest.approx(case["root_diameter"], abs=1e-9)
    assert m.pair.thickness(0) == pytest.approx(case["tooth_thickness"], abs=1e-8)
    pins = pins_in(teeth_of(m)[0], case["pin"])
    assert pins.over(0, int(pins.opposite()[0])) == pytest.approx(case["over_pins"], abs=2e-9)


@pytest.mark.parametrize(
    "given",
    [
        {},
        {"teeth": 11, "mate_teeth": 37},
        {"teeth": 24, "mate_teeth": 24, "centre_distance": 49.0},
        {"teeth": 13, "mate_teeth": 50, "shift_rule": "equal-sliding", "centre_distance": 64.0},
        {"teeth": 30, "mate_teeth": 31, "pressure_angle": 14.5, "module": 1.0},
        {"teeth": 18, "mate_teeth": 90, "pressure_angle": 25.0, "module": 0.8},
    ],
)
def test_outlines_are_involutes_that_mesh(given):
    m = table_of(SpurGearParams(**given))
    assert codes(**given) == set()
    proof = prove(m)
    assert not proof.collides
    assert proof.error < 5e-6
    for gear, teeth in enumerate(teeth_of(m)):
        start = teeth.flank_arcs[0, 1]
        arcs = start + np.linspace(0.0, 1.2 * m.pair.module, 40)
        points = teeth.rack.flank(teeth.curve.frame_at(arcs), np.full(40, start), np.full(40, 1.0))
        radius, angle = np.hypot(*points.T), np.arctan2(points[:, 1], points[:, 0])
        along = angle - involute(np.arccos(m.pair.base(gear) / radius))  # the same from root to tip
        assert np.ptp(radius * (along - along[0])) < 1e-4


def test_the_operating_teeth_have_the_same_flanks():
    m = table_of(SpurGearParams(teeth=13, mate_teeth=50, shift=0.4, mate_shift=0.1))
    for gear in (0, 1):
        cut, runs = teeth_of(m)[gear], operating_teeth(m.pair, gear)
        radius = float(m.pair.operating(gear))
        half = runs.flank_arcs[0, 1] / radius
        start = cut.flank_arcs[0, 1]
        arcs = start + np.linspace(-0.5, 4.0, 2000) * m.pair.module
        points = cut.rack.flank(cut.curve.frame_at(arcs), np.full(2000, start), np.full(2000, 1.0))
        angles = np.arctan2(points[:, 1], points[:, 0])
        order = np.argsort(np.hypot(*points.T))
        found = np.interp(radius, np.hypot(*points.T)[order], angles[order])
        assert found == pytest.approx(half, abs=1e-6)


def test_shifts_that_are_left_out_are_the_least_without_undercut():
    m = table_of(SpurGearParams(teeth=11, mate_teeth=37))
    exact = least_shift(11, math.radians(20), 1.25, 0.38)
    assert exact <= m.pair.shifts[0] <= exact + 1e-3
    assert m.pair.shifts[1] == 0
    assert "gear.undercut" in codes(teeth=11, mate_teeth=37, shift=float(exact) - 0.01)
    assert "gear.undercut" not in codes(teeth=11, mate_teeth=37, shift=float(exact) + 0.01)


def test_a_centre_distance_is_kept_and_feet_can_slide_alike():
    for rule in ("no-undercut", "equal-sliding"):
        m = table_of(SpurGearParams(teeth=18, mate_teeth=45, centre_distance=64.0, shift_rule=rule))
        assert float(m.pair.distance) == pytest.approx(64.0, abs=1e-9)
    assert float(m.pair.sliding(0)) == pytest.approx(float(m.pair.sliding(1)), abs=1e-6)
    given = table_of(SpurGearParams(teeth=18, mate_teeth=45, centre_distance=64.0, mate_shift=0.1))
    assert given.pair.shifts[1] == 0.1
    assert float(given.pair.distance) == pytest.approx(64.0, abs=1e-9)


def test_diametral_pitch_is_a_module_in_inches():
    m = table_of(SpurGearParams(diametral_pitch=12.7))
    assert m.pair.module == pytest.approx(2.0)
    with pytest.raises(ValueError, match="exactly one of module and diametral_pitch"):
        SpurGearParams(diametral_pitch=12.7, module=2.0)
    with pytest.raises(ValueError, match="leave one of the three out"):
        SpurGearParams(centre_distance=60.0, shift=0.1, mate_shift=0.0)


def test_what_makes_teeth_larger_is_the_key_that_sizes_them():
    loaded = {"diametral_pitch": 16.0, "teeth": 15, "mate_teeth": 48, "load_torque": 6.0}
    found = next(one for one in GEARS.check(SpurGearParams(**loaded)) if one.code == "gear.root")
    (less,) = [one for one in found.proposed if "parameters.diametral_pitch" in one]
    better = SpurGearParams(**{**loaded, "diametral_pitch": less["parameters.diametral_pitch"]})
    assert "gear.root" not in {one.code for one in GEARS.check(better) if one.severity is not Severity.NOTE}
    assert next(larger_teeth(None, 15, diametral_pitch=16.0)) == {"parameters.diametral_pitch": 12.8}


@pytest.mark.parametrize(
    ("code", "given"),
    [
        ("gear.distance", {"centre_distance": 50.0}),
        ("gear.shift", {"centre_distance": 64.0}),
        ("gear.undercut", {"teeth": 9, "shift": 0.0}),
        ("gear.tip", {"teeth": 9, "shift": 0.84}),
        ("gear.root-land", {"tip_radius": 0.5, "pressure_angle": 25.0}),
        ("gear.rack", {"mate_teeth": 72, "mate_shift": 0.9}),
        ("gear.clearance", {"addendum": 1.2, "dedendum": 1.2}),
        ("gear.contact-ratio", {"addendum": 0.5}),
        (
            "gear.interference",
            {
                "teeth": 17,
                "mate_teeth": 200,
                "addendum": 1.1,
                "dedendum": 1.25,
                "shift": 0.3,
                "mate_shift": 0.0,
            },
        ),
        ("bore.rim", {"bore": 34.0}),
        ("bore.keyway-depth", {"bore": 12, "keyway_width": 4, "keyway_depth": 1.2}),
        ("gear.backlash", {"backlash": 0.0}),
        ("gear.root", {"load_torque": 300.0}),
    ],
)
def test_what_cannot_be_built_is_named(code, given):
    found = [one for one in GEARS.check(SpurGearParams(**given)) if one.code == code]
    assert found
    assert found[0].severity is Severity.ERROR
    assert found[0].remedy


def test_remedies_of_shifts_help():
    (found,) = [
        one
        for one in GEARS.check(SpurGearParams(teeth=9, shift=0.0))
        if one.code == "gear.undercut" and one.severity is Severity.ERROR
    ]
    value = next(change["parameters.shift"] for change in found.proposed)
    assert "gear.undercut" not in codes(teeth=9, shift=value)


@pytest.mark.parametrize("arrangement", ["external", "internal"])
def test_many_pairs_are_judged_as_each_alone(arrangement):
    rng, size = np.random.default_rng(7), 400
    varied = {
        "teeth": rng.integers(8, 60, size),
        "mate_teeth": rng.integers(12, 140, size),
        "module": rng.uniform(0.6, 4.0, size),
        "shift": rng.uniform(-0.4, 0.9, size),
        "load_torque": rng.uniform(0, 60, size),
    }
    found = GEARS.evaluate(
        Batch(SpurGearParams, {"arrangement": arrangement}, varied),
        ("contact_ratio", "centre_distance", "sliding1"),
        Stage.PARTS,
    )
    for place in range(0, size, 8):
        one = SpurGearParams(
            arrangement=arrangement,
            **{
                name: int(values[place]) if name.endswith("teeth") else float(values[place])
                for name, values in varied.items()
            },
        )
        wrong = [
            f for f in GEARS.judge(one) if f.severity is Severity.ERROR and not f.stage.is_after(Stage.PARTS)
        ]
        assert found.codes[found.forbidden[place]] == (wrong[0].code if wrong else "")
        if not wrong:
            assert found.values["contact_ratio"][place] == pytest.approx(
                float(table_of(one).pair.contact_ratio), rel=1e-12
            )


def test_forces_are_those_of_the_torque_on_the_reference_circle():
    m = table_of(SpurGearParams(teeth=13, mate_teeth=36, centre_distance=50.0, load_torque=3.0))
    force = m.normal_force * np.cos(m.pair.angle)
    assert float(force * m.pair.reference(1)) == pytest.approx(3000.0)
    assert float(force * m.pair.reference(0)) == pytest.approx(3000.0 * 13 / 36)


def test_a_shifted_tooth_has_the_form_factor_of_the_charts():
    """Y_Fa of ISO 6336-3 for the rack 1, 1.25, 0.38: about 2.8 at z = 20, 2.2 with x = 0.5."""
    plain, _ = form_factors(20)
    shifted, _ = form_factors(20, shift=0.5)
    assert float(plain) == pytest.approx(2.80, abs=0.02)
    assert float(shifted) == pytest.approx(2.18, abs=0.03)


@pytest.mark.parametrize(
    ("keys", "remedy"),
    [
        ("teeth = 8\nshift = 0.6\ntip_radius = 0.2", "set shift = 0.651 (now 0.6)"),
        (
            "teeth = 40\npressure_angle = 28\naddendum = 0.5\ndedendum = 0.8",
            "leave out addendum (now 0.5), leave out dedendum (now 0.8)",
        ),
    ],
)
def test_a_remedy_says_what_is_to_be_typed_and_no_more(keys, remedy, tmp_path, command_line):
    path = tmp_path / "pair.toml"
    path.write_text(f'family = "spur-gears"\n[parameters]\n{keys}\n')
    status, out, _ = command_line("check", str(path))
    assert status == 1
    assert f"; {remedy}\n" in out
