"""Strength and drives: against integrals worked out otherwise, identities, limits, and what is refused."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright.contracts.materials import MATERIALS
from mechwright.errors import DesignError, GeometryError
from mechwright.mechanics.strength import beam, bearings_life, bolts, critical, drive, fastening
from mechwright.mechanics.strength import shaft as shafts
from mechwright.mechanics.strength import tooth_bending as teeth
from mechwright.mechanics.strength.allowed import ALLOWED, PIN_SHEAR, allowed
from mechwright.mechanics.strength.motor import (
    MARGIN,
    Demand,
    corner_speed,
    dc_power,
    dc_speed,
    dc_torque,
    gear_motor_margin,
    stepper_margin,
    stepper_torque,
)
from mechwright.standards.bearings import bearing
from mechwright.standards.circlips import bore_circlip, shaft_circlip
from mechwright.standards.motors import gear_motors, steppers


@given(st.floats(5, 40), st.floats(30, 200), st.floats(0.1, 0.9), st.floats(1, 900))
def test_castiglianos_theorem_gives_the_closed_forms_of_plain_shafts(d, span, share, force):
    at = share * span
    plain = beam.straddled(d, span, at, force)
    shaft = beam.SteppedShaft(((d, 0.3 * span), (d, 0.7 * span)), 0.0, span)
    loads = [(at, force)]
    assert shaft.deflection(loads, at) == pytest.approx(plain.deflection, rel=1e-9)
    assert abs(shaft.slope(loads, at)) == pytest.approx(plain.slope, rel=1e-7, abs=1e-12)
    assert abs(shaft.slope(loads, 0.0)) == pytest.approx(plain.near_slope, rel=1e-9)
    assert abs(shaft.slope(loads, span)) == pytest.approx(plain.far_slope, rel=1e-9)
    assert shaft.reactions(loads) == pytest.approx((plain.near, plain.far))


@given(st.floats(5, 40), st.floats(30, 200), st.floats(5, 100), st.floats(1, 900))
def test_and_of_overhung_ones(d, span, beyond, force):
    plain = beam.overhung(d, span, beyond, force)
    shaft = beam.SteppedShaft(((d, span + beyond),), 0.0, span)
    loads = [(span + beyond, force)]
    assert shaft.deflection(loads, span + beyond) == pytest.approx(plain.deflection, rel=1e-9)
    assert abs(shaft.slope(loads, span + beyond)) == pytest.approx(plain.slope, rel=1e-9)
    assert abs(shaft.slope(loads, span)) == pytest.approx(plain.near_slope, rel=1e-9)
    assert abs(shaft.slope(loads, 0.0)) == pytest.approx(plain.far_slope, rel=1e-9)
    assert shaft.reactions(loads) == pytest.approx((plain.far, plain.near))


def test_a_stepped_shaft_bends_as_its_curve_integrated_twice():
    shaft = beam.SteppedShaft(((10, 25), (16, 30), (12, 45)), 5.0, 90.0)
    loads = [(40.0, 300.0), (70.0, -120.0)]
    x = np.linspace(0, 100, 20_001)
    sizes = np.where(x < 25, 10, np.where(x < 55, 16, 12))
    moment = np.array([shaft.moment(loads, float(one)) for one in x[::20]])
    bend = np.interp(x, x[::20], moment) / (beam.STEEL * math.pi * sizes**4 / 64)
    step = x[1] - x[0]
    slope = np.concatenate([[0], np.cumsum((bend[1:] + bend[:-1]) / 2)]) * step
    line = np.concatenate([[0], np.cumsum((slope[1:] + slope[:-1]) / 2)]) * step
    ends = np.interp([5.0, 90.0], x, line)
    line -= ends[0] + (x - 5.0) * (ends[1] - ends[0]) / 85.0
    for at in (20.0, 40.0, 62.0, 98.0):
        assert shaft.deflection(loads, at) == pytest.approx(-np.interp(at, x, line), rel=2e-3)


def test_the_deflection_at_one_place_by_a_force_at_another_is_that_the_other_way_round():
    shaft = beam.SteppedShaft(((8, 20), (14, 40), (10, 40)), 0.0, 80.0)  # Maxwell and Betti
    assert shaft.deflection([(30, 1)], 95) == pytest.approx(shaft.deflection([(95, 1)], 30), rel=1e-12)


def test_fatigue_without_a_load_is_safe_and_a_notch_takes_safety():
    assert shafts.goodman_safety(12, shafts.Load(), 236, 600) == math.inf
    load = shafts.Load(8.0, mean_torque=5.0)
    plain = shafts.goodman_safety(12, load, 236, 600, shafts.Notch())
    assert plain > shafts.goodman_safety(12, load, 236, 600) > shafts.SAFE
    # Bending alone: σ_a = Se at safety 1.
    d = shafts.least_diameter(8, 0, 236)
    assert shafts.goodman_safety(d, shafts.Load(8), 236, 600, shafts.Notch()) == pytest.approx(1)


def test_torsion_alone_yields_at_the_strength_over_root_three():
    assert shafts.von_mises(12, 0, 5) == pytest.approx(math.sqrt(3) * shafts.torsion_stress(12, 5))
    assert shafts.von_mises(12, 8, 0) == pytest.approx(shafts.bending_stress(12, 8))
    d = shafts.least_diameter(8, 5, 60)
    assert shafts.von_mises(d, 8, 5) == pytest.approx(60)


def test_dunkerleys_speed_is_below_each():
    speeds = [critical.of_mass(12, 80, at, 0.4) for at in (20, 40, 60)] + [critical.of_shaft(12, 80)]
    assert critical.dunkerley(speeds) < min(speeds)
    assert critical.of_mass(12, 80, 40, 0.4) < critical.of_mass(12, 80, 20, 0.4)


@pytest.mark.parametrize(
    ("z", "form", "stress"),
    [
        (12, 3.458, 1.450),
        (14, 3.202, 1.483),
        (17, 2.957, 1.522),
        (20, 2.800, 1.553),
        (25, 2.634, 1.592),
        (30, 2.529, 1.623),
        (40, 2.405, 1.669),
        (50, 2.333, 1.702),
        (100, 2.195, 1.795),
        (1000, 2.076, 1.942),
    ],
)
def test_form_factors_are_those_of_the_standard(z, form, stress):
    assert [float(one) for one in teeth.form_factors(z)] == pytest.approx([form, stress], abs=6e-4)


def test_form_factors_fall_with_teeth_and_a_column_is_as_each_alone():
    z = np.array([12.0, 20.0, 60.0, 1000.0])
    form, stress = teeth.form_factors(z)
    assert np.all(np.diff(form) < 0)
    assert np.all(np.diff(stress) > 0)
    assert [float(teeth.form_factors(one)[0]) for one in z] == pytest.approx(form.tolist(), rel=1e-14)


def test_equal_circles_are_ellipses_without_eccentricity():
    mesh = teeth.EllipticMesh.at(np.linspace(0, 6, 7), 30.0, 0.0)
    assert mesh.radius == pytest.approx(30)
    assert mesh.curvature == pytest.approx(30)
    assert teeth.tangential_force(3, mesh.radius, mesh.slant, math.radians(20)) == pytest.approx(100)


def test_the_slant_is_that_of_the_pitch_curve():
    at, h = np.linspace(0.1, 6, 9), 1e-6
    own = [60 - teeth.EllipticMesh.at(at + k * h, 30.0, 0.5).radius for k in (-1, 1)]
    slope = np.arctan(np.abs((own[1] - own[0]) / (2 * h) / ((own[0] + own[1]) / 2)))
    assert np.abs(teeth.EllipticMesh.at(at, 30.0, 0.5).slant) == pytest.approx(slope, abs=1e-8)


def test_the_torque_of_a_drive_is_the_power_that_the_inertia_takes():
    def angle(t):
        return 2 * t + 0.3 * np.sin(3 * t)  # of the input

    def output(x):
        return x - 0.4 * np.cos(x)  # of the output over the input

    t, h = np.linspace(0, 3, 11), 1e-4
    x = angle(t)
    own, slope = 1 + 0.4 * np.sin(x), 0.4 * np.cos(x)
    speed, acceleration = 2 + 0.9 * np.cos(3 * t), -2.7 * np.sin(3 * t)

    def energy(at):
        rate = (output(angle(at + h)) - output(angle(at - h))) / (2 * h)
        return 0.5 * 0.02 * rate**2

    power = (energy(t + h) - energy(t - h)) / (2 * h) + 0.7 * own * speed
    found = drive.drive_torque(own, slope, speed, inertia=0.02, load=0.7, acceleration=acceleration)
    assert found * speed == pytest.approx(power, rel=1e-5, abs=1e-6)


def test_the_swing_of_energy_is_the_integral_of_the_torque():
    turn = np.arange(20_000) * math.tau / 20_000
    step = math.tau / 20_000
    for count in (1, 2, 5):
        assert drive.energy_swing(0.4 + 3 * np.sin(count * turn), step) == pytest.approx(
            drive.sine_swing(3, count), rel=1e-5
        )
    e = 0.4
    own = (1 - e * e) / (1 + e * e - 2 * e * np.cos(turn))
    slope = -own * 2 * e * np.sin(turn) / (1 + e * e - 2 * e * np.cos(turn))
    torque = drive.drive_torque(own, slope, 62.8, inertia=2e-4)
    expected = drive.inertia_swing(2e-4, 62.8, own.max(), own.min())
    assert drive.energy_swing(torque, step) == pytest.approx(expected, rel=1e-5)
    assert drive.rms(0.3 + 2 * np.sin(turn)) == pytest.approx(math.sqrt(0.09 + 2))


def test_a_bearing_without_load_lives_for_ever_and_an_axial_load_counts_from_e_on():
    assert bearings_life.life(3450, 0, 100) == math.inf
    assert bearings_life.life(3450, 100, 0) == math.inf
    e, y = bearings_life.axial_factors(0.689)
    assert bearings_life.equivalent_load(100, e * 100, 0.689) == 100
    assert bearings_life.equivalent_load(100, 80, 0.689) == pytest.approx(0.56 * 100 + y * 80)
    halves = bearings_life.mean_load([100, 300], [0.5, 0.5])
    assert 200 < halves < 300
    assert bearings_life.mean_load([250], [1.0]) == pytest.approx(250)
    assert bearings_life.static_load(100, 50) == 100
    assert bearings_life.static_load(100, 150) == 135
    assert bearing("608").static / bearings_life.static_load(150) > bearings_life.STATIC_SAFETY
    with pytest.raises(GeometryError, match=r"shares of turns add up to 0\.9"):
        bearings_life.mean_load([1, 2], [0.5, 0.4])


def test_factors_of_axial_loads_go_one_way():
    relative = np.linspace(0.1, 8, 50)
    e, y = np.array([bearings_life.axial_factors(one) for one in relative]).T
    assert np.all(np.diff(e) >= 0)
    assert np.all(np.diff(y) <= 0)


def test_a_key_carries_the_torque_at_its_pressure():
    torque = fastening.key_torque(80, 12, 1.5, 10)
    assert fastening.key_pressure(torque, 12, 1.5, 10) == pytest.approx(80)
    with pytest.raises(GeometryError, match="bears on 0 mm"):
        fastening.key_pressure(5, 12, 0, 10)
    with pytest.raises(GeometryError, match="needs one at least"):
        fastening.ring_force(5, 0, 28)
    with pytest.raises(GeometryError, match="is not between bearings"):
        beam.straddled(12, 80, 80, 100)


def test_the_weaker_of_ring_and_groove_holds():
    ring = shaft_circlip(10)
    assert fastening.circlip_load(ring.groove_load(), ring.ring_load) == ring.groove_load() / 1.5
    assert fastening.circlip_load(9000, 4000) == 4000 / 1.5
    assert fastening.circlip_load(bore_circlip(22).groove_load(250), None) == pytest.approx(
        250 / 200 * bore_circlip(22).groove_load() / 1.5
    )


def test_a_clamp_of_a_thin_ring_holds_at_its_radius():
    assert bolts.face_radius(20.001, 20.0) == pytest.approx(20.0005)
    assert bolts.face_radius(20, 0) == pytest.approx(2 / 3 * 20)
    assert bolts.least_preload(300, 4) == pytest.approx(937.5)
    assert bolts.head_pressure(3932.9, 7, 4.5) > 170


def test_every_material_has_what_it_bears():
    assert ALLOWED.keys() == MATERIALS.keys()
    for name in MATERIALS:
        assert 0 < allowed(name).root < MATERIALS[name].strength
        assert allowed(name).endurance < MATERIALS[name].strength
    assert allowed("steel").contact > allowed("aluminium").contact > allowed("pom").contact
    assert PIN_SHEAR["hardened"] > PIN_SHEAR["steady"] > PIN_SHEAR["swelling"] > PIN_SHEAR["alternating"]
    with pytest.raises(DesignError, match="material 'wood' is not known"):
        allowed("wood")


def test_a_motors_line_goes_from_no_load_to_stall():
    assert dc_torque(150, 2.6, 150) == 0
    assert dc_speed(150, 2.6, 2.6) == 0
    assert dc_speed(150, 2.6, dc_torque(150, 2.6, 90)) == pytest.approx(90)
    speeds = np.linspace(0, 150, 301)
    powers = [dc_torque(150, 2.6, speed) * speed * math.tau / 60 for speed in speeds]
    assert max(powers) == pytest.approx(dc_power(150, 2.6), rel=1e-4)
    corner = corner_speed(24, 2.8e-3, 1.7)
    assert stepper_torque(0.4, 2 * corner, corner) == pytest.approx(0.14)
    assert stepper_torque(0.4, corner / 2, corner) == stepper_torque(0.4, 0, corner) == pytest.approx(0.28)


def test_a_steppers_margin_is_its_torque_at_the_speed_over_twice_the_peak():
    stepper = steppers()[1]
    assert stepper_margin(stepper, Demand(100, 0.12, 0.05)) == pytest.approx(0.7 * 0.36 / MARGIN / 0.12)
    assert stepper_margin(stepper, Demand(100, 0.0, 0.0)) == math.inf


def test_gear_motors_are_judged_by_line_peak_and_heat():
    gear = gear_motors()[2]
    assert gear_motor_margin(gear, Demand(100, 0.5, 0.3)) >= 1
    assert gear_motor_margin(gear, Demand(gear.no_load, 0.1, 0.1)) == 0
    assert gear_motor_margin(gear, Demand(0, 0.1, gear.stall_torque)) == pytest.approx(0.25)
    assert gear_motor_margin(gear, Demand(0, gear.stall_torque, 0.1)) == pytest.approx(0.5)
    assert gear_motor_margin(gear, Demand(190, 0.3, 0.0)) == pytest.approx(0.05 * gear.stall_torque / 0.3)
