"""Cams against closed forms and against another way to envelope a roller."""

import math

import numpy as np
import pytest
import shapely
from by_night import examples as tried
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from mechwright.contracts.finding import Severity, errors
from mechwright_cam_follower.as_made.lift_error import error_of
from mechwright_cam_follower.family import CamFollower
from mechwright_cam_follower.kinematics.contact import contact_of
from mechwright_cam_follower.kinematics.cycle import cycle_of
from mechwright_cam_follower.kinematics.extremes import face_ends, load_peak, pressure_peak, weakest
from mechwright_cam_follower.kinematics.mechanism import mechanism_of
from mechwright_cam_follower.kinematics.motion import contacts_at, motion_of
from mechwright_cam_follower.kinematics.turn import greatest
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.parts.cam_outline import FIT, outline_of
from mechwright_cam_follower.rules.validity import is_valid

findings = CamFollower().check

TURN = np.linspace(0.0, math.tau, 721)
LAWS = ["cycloidal", "modified-sine", "modified-trapezoid", "3-4-5", "4-5-6-7", "simple-harmonic"]

SLIDES = st.fixed_dictionaries(
    {
        "base_radius": st.floats(40, 90),
        "lifts": st.floats(3, 20).map(lambda lift: (lift, lift / 3, 0.0, 0.0)),
        "laws": st.sampled_from(LAWS).map(lambda law: (law,)),
        "offset": st.floats(-15, 15),
        "roller_radius": st.floats(4, 12),
        "turning": st.sampled_from(["ccw", "cw"]),
        "conjugate": st.booleans(),
    }
)
LEVERS = st.fixed_dictionaries(
    {
        "follower": st.just("oscillating"),
        "base_radius": st.floats(40, 60),
        "swings": st.floats(3, 15).map(lambda swing: (swing, swing, 0.0, 0.0)),
        "laws": st.sampled_from(LAWS).map(lambda law: (law,)),
        "turning": st.sampled_from(["ccw", "cw"]),
        "conjugate": st.booleans(),
    }
)


def cam(**table) -> CamParams:
    return CamParams.model_validate(table)


def rates_at(params, theta=TURN):
    return cycle_of(params).at(theta)


@settings(max_examples=tried(20, 300), deadline=None)
@given(st.one_of(SLIDES, LEVERS))
def test_both_rollers_touch_their_cams(table):
    """Exact profile and roller centre are one radius apart, and the profile's tangent is square to the normal."""
    params = cam(**table)
    radius = params.value("roller_radius")
    step = 1e-6
    for second in mechanism_of(params).cams:
        m = mechanism_of(params)
        contact, before, after = (
            contact_of(m, rates_at(params, at), second)
            for at in (TURN[5:-5], TURN[5:-5] - step, TURN[5:-5] + step)
        )
        assert_allclose(np.abs(contact.centre - contact.point), radius, rtol=0, atol=1e-9)
        ends = [
            one.point * np.exp(-1j * params.sense * (TURN[5:-5] + at))
            for one, at in ((before, -step), (after, step))
        ]
        way = (ends[1] - ends[0]) / (2 * step)
        normal = contact.outward * np.exp(-1j * params.sense * TURN[5:-5])
        assert np.abs((way * np.conj(normal)).real).max() < 1e-3 * np.abs(way).max()


@settings(max_examples=tried(6, 60), deadline=None)
@given(st.one_of(SLIDES, LEVERS))
def test_outline_is_the_envelope_that_shapely_cuts(table):
    """The fitted outline against a disc from which the roller is cut at two thousand places of the turn."""
    params = cam(**table)
    if errors(findings(params)):
        return
    theta = np.linspace(0.0, math.tau, 2001)
    for second in mechanism_of(params).cams:
        centre = contact_of(mechanism_of(params), rates_at(params, theta), second).centre
        centre = centre * np.exp(-1j * params.sense * theta)
        swept = shapely.LinearRing(np.column_stack((centre.real, centre.imag))).buffer(
            params.value("roller_radius"), 64
        )
        inside = shapely.Polygon(swept.interiors[0])
        ours = shapely.Polygon(outline_of(mechanism_of(params), second)[0].flatten(1e-4))
        # Both polygons have chords: 2000 of the way, and 256 of the roller's circle.
        assert ours.exterior.hausdorff_distance(inside.exterior) < 0.02
        assert abs(ours.area - inside.area) < 0.003 * inside.length


@given(st.floats(-20, 20), st.floats(30, 60), st.sampled_from(LAWS))
def test_pressure_angle_of_a_slide(offset, base, law):
    """Norton, Design of Machinery: tan α = (s' - e)/(s + √(Rp² - e²))."""
    params = cam(offset=offset, base_radius=base, laws=[law])
    rates = rates_at(params)
    (contact,) = contacts_at(mechanism_of(params), rates)
    height = rates.s + math.sqrt((base + 8) ** 2 - offset**2)
    assert_allclose(np.tan(contact.pressure_angle), (rates.v - offset) / height, rtol=0, atol=1e-12)


def test_radius_of_curvature_of_a_slide_in_line():
    """Norton: ρ = ((Rp + s)² + s'²)^(3/2)/((Rp + s)² + 2 s'² - s'' (Rp + s))."""
    params = cam(laws=["3-4-5"])
    rates = rates_at(params)
    (contact,) = contacts_at(mechanism_of(params), rates)
    r = 48 + rates.s
    wanted = (r**2 + rates.v**2) ** 1.5 / (r**2 + 2 * rates.v**2 - rates.a * r)
    assert_allclose(contact.pitch_radius, wanted, rtol=1e-12)
    assert_allclose(contact.radius, wanted - 8, rtol=1e-12)


def test_eccentric_circle():
    """A flat face on harmonic motion over the whole turn: the cam is a circle off its axis, its face the stroke long.

    An exercise of many textbooks: total lift 50 mm, least radius 25 mm.
    """
    params = cam(
        contact="flat", angles=(180, 180), lifts=(50, 0), laws=("simple-harmonic",), base_radius=25, bore=0
    )
    (contact,) = contacts_at(mechanism_of(params), rates_at(params))
    profile = contact.point * np.exp(-1j * TURN)
    assert_allclose(contact.radius, 50, rtol=1e-12)
    assert_allclose(np.abs(profile + 25j), 50, rtol=1e-12)
    low, high = face_ends(mechanism_of(params))
    assert (low, high) == pytest.approx((-25, 25), abs=1e-9)
    assert outline_of(mechanism_of(params))[0].area == pytest.approx(math.pi * 2500, rel=1e-6)


def test_flat_face_radius():
    """ρ = R_b + s + s'' for a slide; a lever's by differences of its profile."""
    params = cam(contact="flat", laws=["4-5-6-7"])
    rates = rates_at(params)
    (contact,) = contacts_at(mechanism_of(params), rates)
    assert_allclose(contact.radius, 40 + rates.s + rates.a, rtol=1e-12)
    lever = cam(
        contact="flat",
        follower="oscillating",
        base_radius=60,
        swings=(8, 8, 0, 0),
        centre_distance=150,
        laws=["4-5-6-7"],
    )
    fine = np.linspace(0.2, 1.9, 40001)
    (contact,) = contacts_at(mechanism_of(lever), rates_at(lever, fine))
    profile = contact.point * np.exp(-1j * fine)
    rate = np.gradient(profile, fine)
    bend = np.gradient(rate, fine)
    found = -(np.abs(rate) ** 3) / (np.conj(rate) * bend).imag
    assert_allclose(contact.radius[5:-5], found[5:-5], rtol=1e-4)


@pytest.mark.parametrize(
    "table", [{"offset": 9.0}, {"follower": "oscillating"}, {"follower": "oscillating", "turning": "cw"}]
)
@pytest.mark.parametrize("second", [False, True])
def test_radius_of_curvature_by_differences(table, second):
    """ρ of the pitch curve and of the cam, both of a pair, from their points alone."""
    params = cam(**table, conjugate=True, laws=["4-5-6-7"])
    fine = np.linspace(0.2, 1.9, 40001)
    contact = contacts_at(mechanism_of(params), rates_at(params, fine))[second]
    turned = np.exp(-1j * params.sense * fine)
    for points, radius in ((contact.centre, contact.pitch_radius), (contact.point, contact.radius)):
        rate = np.gradient(points * turned, fine)
        bend = np.gradient(rate, fine)
        curvature = -params.sense * (np.conj(rate) * bend).imag / np.abs(rate) ** 3
        assert_allclose(1 / radius[5:-5], curvature[5:-5], rtol=0, atol=1e-6)


@settings(deadline=None)
@given(st.floats(0.1, 3), st.floats(0, 400), st.floats(0, 20), st.floats(10, 1200), st.floats(-20, 50))
def test_force_of_harmonic_motion(mass, preload, rate, speed, load):
    """F = m ω² h/2 cos θ + F0 + k h/2 (1 - cos θ) + load: linear in cos θ, so its least is at an end of the stroke."""
    table = {"mass": mass, "spring_preload": preload, "spring_rate": rate, "speed": speed, "load": load}
    params = cam(angles=(180, 180), lifts=(20, 0), laws=("simple-harmonic",), **table)
    swing = mass / 1000 * params.omega**2 * 10
    wanted = min(swing + preload + load, -swing + preload + load + 20 * rate)
    assert weakest(mechanism_of(params)).value == pytest.approx(wanted, rel=1e-9, abs=1e-9)
    told = [one for one in findings(params) if one.code == "follower.contact"]
    assert bool(told) == (wanted <= 0)
    for change in told[0].proposed if told else ():
        (key, value) = next(iter(change.items()))
        assert weakest(mechanism_of(params.model_copy(update={key.split(".")[1]: value}))).value > 0


def test_torque_is_the_power_of_the_follower():
    """Over a turn the camshaft gives back what it took; at each place it is F s'."""
    motion = motion_of(cam(laws=["3-4-5"], speed=600), 7201)
    force, alpha = motion["contact_force"], motion["pressure_angle"]
    assert_allclose(
        motion["torque"] * motion["omega1"],
        force * np.cos(alpha) * motion["velocity"] / 1000,
        rtol=0,
        atol=1e-9,
    )
    assert (
        abs(np.trapezoid(motion["torque"], motion["theta"]))
        < 1e-6 * load_peak(mechanism_of(cam(laws=["3-4-5"])), "torque_max").value * 10
    )


def test_a_cam_that_locks_has_forces_all_the_same():
    """A flat face that is touched beyond the lever's axis cannot be pushed; its motion is one all the same."""
    kind = {"follower": "oscillating", "contact": "flat", "swings": (45, 45, 0, 0), "turning": "cw"}
    params = CamParams(**kind, angles=(60, 120, 120, 60), base_radius=18, centre_distance=177)
    motion = motion_of(params, 721)
    assert np.degrees(np.abs(motion["pressure_angle"])).max() > 100
    for name in ("contact_force", "contact_pressure"):
        values = motion[name]
        assert np.isfinite(values).all()
        assert values.min() >= 0
    assert "follower.undercut" in [finding.code for finding in findings(params)]


def test_conjugate_pair_shares_the_force():
    """One of both cams carries, never both; together they do what the acceleration asks."""
    params = cam(conjugate=True, speed=900, laws=["cycloidal"], mass=2.0)
    motion = motion_of(params, 721)
    one, two = motion["contact_force"], motion["contact_force2"]
    assert (np.minimum(one, two) == 0).all()
    assert one.max() > 0 < two.max()
    axial = one * np.cos(motion["pressure_angle"]) - two * np.cos(motion["pressure_angle2"])
    assert_allclose(axial, 2.0 * motion["acceleration"] / 1000, rtol=0, atol=1e-9)


def test_dwells_are_arcs():
    segments = outline_of(mechanism_of(cam()))[0].segments
    arcs = [one for one in segments if one.tag == "dwell"]
    assert sorted(one.radius for one in arcs) == pytest.approx([40, 55], abs=1e-12)
    assert outline_of(mechanism_of(cam()))[1] <= FIT


def test_extremes_are_refined():
    """The greatest pressure angle of a coarse grid is below, and that of a fine one no more than that."""
    params = cam(laws=["modified-sine"], offset=4)
    best = pressure_peak(mechanism_of(params))
    fine = np.linspace(0, math.tau, 200001)
    (contact,) = contacts_at(mechanism_of(params), rates_at(params, fine))
    seen = np.abs(contact.pressure_angle)
    assert 0 <= best.value - seen.max() < 1e-9
    assert best.angle == pytest.approx(fine[seen.argmax()], abs=1e-4)


def test_jumps_belong_to_the_segment():
    """At the end of a harmonic rise into a dwell the deceleration counts, though the dwell has none."""
    params = cam(angles=(90, 180, 90), lifts=(10, 10, 0), laws=("simple-harmonic",))
    least = -greatest(mechanism_of(params), "slowest", lambda one: -one.rates.a).value
    assert least == pytest.approx(-(math.pi**2) * 10 / 2 / (math.pi / 2) ** 2, rel=1e-6)


UNDERCUT = {
    "base_radius": 12,
    "bore": 0,
    "lifts": [30, 30, 0, 0],
    "angles": [60, 60, 60, 180],
    "roller_radius": 25,
}


def test_undercut_is_named_and_mended():
    (found,) = errors(findings(cam(**UNDERCUT)))
    assert found.code == "follower.undercut"
    assert {key for change in found.proposed for key in change} >= {
        "parameters.base_radius",
        "parameters.roller_radius",
    }
    for change in found.proposed:
        ((key, value),) = change.items()
        mended = findings(cam(**{**UNDERCUT, key.split(".")[1]: value}))
        assert "follower.undercut" not in {one.code for one in mended}
    base = next(
        value for change in found.proposed for key, value in change.items() if key.endswith("base_radius")
    )
    nearly = findings(cam(**{**UNDERCUT, "base_radius": base - 0.05}))
    assert "follower.undercut" in {one.code for one in nearly}


@pytest.mark.parametrize(
    "table",
    [{"offset": 70.0}, {"follower": "oscillating", "centre_distance": 200.0, "arm_length": 20.0}],
)
def test_a_cam_that_its_follower_does_not_reach_is_not_valid(table):
    (found,) = errors(findings(cam(**table)))
    assert not is_valid(mechanism_of(cam(**table)), steep=False)[0]
    (change,) = found.proposed
    ((key, value),) = change.items()
    assert is_valid(mechanism_of(cam(**table | {key.split(".")[1]: value})), steep=False)[0]


def test_steep_cam_is_mended():
    params = cam(lifts=[30, 30, 0, 0], angles=[70, 60, 120, 110])
    (found,) = [one for one in findings(params) if one.severity is Severity.WARNING]
    assert found.code == "follower.pressure-angle"
    for change in found.proposed:
        ((key, value),) = change.items()
        mended = cam(lifts=[30, 30, 0, 0], angles=[70, 60, 120, 110], **{key.split(".")[1]: value})
        assert math.degrees(pressure_peak(mechanism_of(mended)).value) <= 30


@pytest.mark.parametrize("table", [{}, {"contact": "flat"}, {"follower": "oscillating"}, {"conjugate": True}])
def test_lift_error_as_made(table):
    """The drawn outline gives the law within its fit; a cam 10 µm fat lifts by that over the cosine."""
    params = cam(**table)
    contacts = contacts_at(mechanism_of(params), rates_at(params))
    for second, contact in zip(mechanism_of(params).cams, contacts, strict=True):
        outline = outline_of(mechanism_of(params), second)[0].flatten(1e-5)
        exact = error_of(mechanism_of(params), TURN, contact, outline) * contact.share
        assert np.abs(exact).max() < FIT + 2e-5
        fat = np.asarray(shapely.Polygon(outline).buffer(0.01, 64).exterior.coords)
        lifted = error_of(mechanism_of(params), TURN, contact, fat) * contact.share
        assert_allclose(lifted, 0.01, rtol=0, atol=FIT + 5e-5)


def test_a_roller_on_an_eccentric_circle():
    """Radius of curvature A and sin α = e sin θ/A, without any formula of cams: the roller's centre runs on a circle.

    Radius and roller together A = 50 mm, 15 mm off the axis: greatest pressure angle arcsin(15/50) = 17.458 degrees.
    """
    whole, off, roller = 50.0, 15.0, 8.0
    u = np.linspace(0, 1, 73)
    away = np.sqrt(whole**2 - (off * np.sin(np.pi * u)) ** 2) - off * np.cos(np.pi * u)
    rows = [[float(a), float(b)] for a, b in zip(u, (away - away[0]) / (2 * off), strict=True)]
    rows[0], rows[-1] = [0.0, 0.0], [1.0, 1.0]
    params = cam(
        angles=(180, 180),
        lifts=(2 * off, 0),
        laws=("table", "cycloidal"),
        table=rows,
        base_radius=whole - off - roller,
        roller_radius=roller,
    )
    theta = np.radians(np.linspace(30, 150, 481))
    (contact,) = contacts_at(mechanism_of(params), rates_at(params, theta))
    assert_allclose(np.sin(contact.pressure_angle), off * np.sin(theta) / whole, rtol=0, atol=1e-6)
    assert_allclose(contact.pitch_radius, whole, rtol=1e-4)
    assert_allclose(contact.radius, whole - roller, rtol=1e-4)
    # The contact lies on the eccentric circle itself, and the greatest pressure angle is the closed one.
    assert math.degrees(contact.pressure_angle.max()) == pytest.approx(17.4576, abs=1e-4)
