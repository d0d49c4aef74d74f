"""Motion of the four-bar against the reference, against many digits, and against itself."""

import math

import numpy as np
import pytest
from flint import acb, arb, ctx
from four_bar_reference import expected, random_bars
from planar_circles import (
    bresse_point,
    centre_of_curvature,
    curvature,
    in_body,
    inflection_pole,
    pole_velocity,
    velocity_pole,
)
from signed_distances import of_four_bar

from mechwright.mechanics.planar import acceleration_pole
from mechwright_four_bar.kinematics.dimensions import FourBar, Kind
from mechwright_four_bar.kinematics.loop import close

BAR = FourBar(40, 120, 80, 100)
PHI, OMEGA, POINT = math.radians(120), 10.0, 60 + 30j
MANY = 5000


def bodies(bar=BAR, phi=PHI, omega=OMEGA):
    return close(bar, np.array([phi])).bodies(bar, omega)


def fact(name):
    return expected(f"fourbar_{name}")


def close_to(value, name, scale=1.0):
    wanted = fact(name)
    assert abs(complex(np.ravel(value)[0]) * scale - wanted) <= 1e-9 * max(1, abs(wanted)), name


def test_positions_rates_and_jerks_are_the_reference():
    loop, links = close(BAR, PHI), bodies()
    close_to(loop.joint_a, "A")
    close_to(loop.joint_b, "B")
    coupler, follower = links["coupler"].turning, links["follower"].turning
    close_to(coupler.theta, "coupler_angle_sigma_deg", 180 / math.pi)
    close_to(follower.theta, "follower_angle_psi_deg", 180 / math.pi)
    for name, turning in (("coupler", coupler), ("follower", follower)):
        close_to(turning.omega, f"omega_{name}")
        close_to(turning.alpha, f"alpha_{name}")
        close_to(turning.jerk, f"jerk_{name}")


def test_limits_and_transmission_angles_are_the_reference():
    limits = BAR.limits()
    assert limits is not None
    assert BAR.kind.value == fact("grashof_class")
    for value, name in (
        (limits.extended, "limit_phi_extended_deg"),
        (limits.folded, "limit_phi_folded_deg"),
        (limits.swing, "rocker_swing_deg"),
        (BAR.least_transmission_angle(), "mu_at_phi0_deg"),
        (BAR.greatest_transmission_angle(), "mu_at_phi180_deg"),
    ):
        assert math.degrees(value) == pytest.approx(fact(name), abs=1e-8)
    assert limits.time_ratio == pytest.approx(fact("time_ratio"), rel=1e-9)


def test_poles_circles_and_curvature_are_the_reference():
    coupler = bodies()["coupler"]
    per_radian = bodies(omega=1.0)["coupler"]
    close_to(velocity_pole(coupler), "instant_centre_P")
    close_to(in_body(coupler, velocity_pole(coupler)), "moving_centrode_point_coupler_frame")
    pole = acceleration_pole(coupler)
    close_to(pole.fixed, "acceleration_pole_fixed")
    close_to(pole.moving, "acceleration_pole_coupler_frame")
    close_to(pole_velocity(per_radian), "pole_changing_velocity_per_rad")
    close_to(np.abs(inflection_pole(coupler) - velocity_pole(coupler)), "inflection_circle_diameter")
    close_to(inflection_pole(coupler), "inflection_pole")
    close_to(bresse_point(coupler), "bresse_far_point")
    crossed = bodies(FourBar(40, 120, 80, 100, 0.0, -1))["coupler"]
    close_to(acceleration_pole(crossed).fixed, "acceleration_pole_fixed_branch-")
    close_to(acceleration_pole(crossed).moving, "acceleration_pole_coupler_branch-")


def test_a_coupler_point_is_the_reference():
    motion = bodies()["coupler"].point(POINT)
    close_to(motion.position, "coupler_point_pos")
    close_to(motion.velocity, "coupler_point_vel")
    close_to(motion.acceleration, "coupler_point_acc")
    close_to(motion.jerk, "coupler_point_jerk")
    close_to(1 / curvature(motion), "coupler_point_signed_radius_of_curvature")
    close_to(centre_of_curvature(motion), "coupler_point_centre_of_curvature")


def test_the_seed_s_figures_are_the_reference():
    found = of_four_bar(BAR, PHI)
    close_to(found.instant_centre, "instant_centre_P")
    close_to(found.relative_centre, "relative_centre_Q")
    close_to(found.g, "g_signed")
    close_to(found.h, "h_signed")
    close_to(found.cot_delta, "cot_delta")
    assert math.degrees(math.atan(1 / float(found.cot_delta))) == pytest.approx(fact("delta_deg_mod180"))


@pytest.mark.parametrize("turning", [True, False])
def test_the_loop_closes_to_rounding(turning):
    bar, phi = random_bars(MANY, 1, turning)
    loop = close(bar, phi)
    end = bar.ground * np.exp(1j * bar.ground_angle) + bar.follower * loop.follower.direction
    longest = np.max(bar.lengths, axis=0)
    assert np.abs(loop.joint_b - end).max() < 1e-12 * longest.min()
    assert np.abs(np.abs(loop.joint_b - loop.joint_a) - bar.coupler).max() < 1e-12 * longest.min()
    # B is to the left of A to B0 on the open branch.
    side = (
        np.conj(bar.ground * np.exp(1j * bar.ground_angle) - loop.joint_a) * (loop.joint_b - loop.joint_a)
    ).imag
    assert (np.sign(side) == bar.branch).all()


def test_the_seed_s_equations_6_to_9_give_the_direct_pole():
    bar, phi = random_bars(MANY, 2, turning=True)
    found, loop = of_four_bar(bar, phi), close(bar, phi)
    # The forms are 0/0 where crank and follower are parallel and where P is in A: stay off by a thousandth.
    parallel = np.abs((loop.joint_a / bar.crank * np.conj(loop.follower.direction)).imag)
    regular = (parallel > 1e-3) & (np.abs(found.g) > 1e-3 * bar.crank) & (np.abs(found.cot_delta) < 1e3)
    assert regular.sum() > 0.97 * MANY
    lever = bar.crank * np.exp(1j * phi) / (1j * loop.coupler.second - loop.coupler.first**2)
    fixed, moving = loop.joint_a + lever, lever / loop.coupler.direction
    scale = np.abs(lever) + np.max(bar.lengths, axis=0)
    for one, two in ((found.fixed, fixed), (found.coupler, moving)):
        assert (np.abs(one - two)[regular] < 1e-9 * scale[regular]).all()
    assert (np.abs(found.omega - loop.coupler.first)[regular] < 1e-9).all()
    size = 1 + np.abs(loop.coupler.second)
    assert (np.abs(found.alpha - loop.coupler.second)[regular] < 1e-9 * size[regular]).all()
    assert (np.abs(found.g - found.h - bar.crank)[regular] < 1e-9 * np.abs(found.g)[regular] + 1e-9).all()


def test_another_sign_of_delta_is_wrong():
    """The equations hold by their signs: the same ones with -δ miss the pole."""
    bar, phi = random_bars(200, 3, turning=True)
    found = of_four_bar(bar, phi)
    ratio = found.h / found.g
    other = (ratio - ratio**2) * -found.cot_delta
    assert (np.abs(other - close(bar, phi).coupler.second) > 1e-6).mean() > 0.99


def _angles(lengths, theta, branch, phi):
    """σ and ψ as unit vectors in ball arithmetic: an independent way, by the cosine rule and tangents."""
    a, c, b, f = lengths
    d = acb(f) * acb(0, theta).exp() - acb(a) * acb(0, phi).exp()
    square = d.real**2 + d.imag**2
    distance = square.sqrt()
    at_a = ((c * c + square - b * b) / (2 * c * distance)).acos()
    s = d / distance * acb(0, branch * at_a).exp()
    return s, (c * s - d) / b


def test_rates_are_differences_of_many_digits():
    """Central differences over 2^-60 radian in 300 bits are exact to 35 digits for smooth motions."""
    bar, phi = random_bars(MANY, 4, turning=True)
    loop = close(bar, phi)
    with ctx.workprec(300):
        h = arb(2) ** -40
        worst = 0.0
        for k in range(MANY):
            lengths = [arb(float(x[k])) for x in bar.lengths]
            theta, branch = arb(float(bar.ground_angle[k])), int(bar.branch[k])
            at = [_angles(lengths, theta, branch, arb(float(phi[k])) + n * h) for n in (-2, -1, 0, 1, 2)]
            for part, rate in ((0, loop.coupler), (1, loop.follower)):
                middle = at[2][part]
                m2, m1, p1, p2 = ((at[n][part] / middle).log().imag for n in (0, 1, 3, 4))
                for value, wanted in (
                    (rate.first[k], (p1 - m1) / (2 * h)),
                    (rate.second[k], (p1 + m1) / (h * h)),
                    (rate.third[k], (p2 - 2 * p1 + 2 * m1 - m2) / (2 * h**3)),
                ):
                    wanted = float(wanted)
                    worst = max(worst, abs(value - wanted) / (1 + abs(wanted)))
        assert worst < 1e-9


def test_a_design_axis_is_swept_in_one_call():
    cranks = np.array([20.0, 30.0, 40.0])[:, None]
    phi = np.linspace(0, 6, 7)[None, :]
    swept = close(FourBar(cranks, 120, 80, 100), phi)  # type: ignore[arg-type]
    assert swept.joint_b.shape == (3, 7)
    for row, crank in enumerate(cranks.ravel()):
        one = close(FourBar(float(crank), 120, 80, 100), phi[0])
        np.testing.assert_allclose(swept.follower.third[row], one.follower.third, rtol=1e-12)


def test_open_loops_are_said_to_be_open():
    loop = close(FourBar(100, 60, 50, 80), np.array([0.0, math.pi]))
    assert np.isfinite(loop.joint_b[0])
    assert np.isnan(loop.joint_b[1])


@pytest.mark.parametrize(
    ("lengths", "kind"),
    [
        ((40, 120, 80, 100), Kind.CRANK_ROCKER),
        ((50, 70, 60, 20), Kind.DOUBLE_CRANK),
        ((80, 120, 40, 100), Kind.ROCKER_CRANK),
        ((80, 40, 120, 100), Kind.DOUBLE_ROCKER),
        ((60, 80, 70, 90), Kind.CHANGE_POINT),
        ((60, 80, 70, 95), Kind.TRIPLE_ROCKER),
        ((60, 300, 70, 90), Kind.NOT_CLOSED),
    ],
)
def test_kinds_are_what_a_sweep_of_the_crank_shows(lengths, kind):
    bar = FourBar(*lengths)
    assert bar.kind is kind
    turns = np.isfinite(close(bar, np.linspace(0, 2 * math.pi, 3601)).joint_b)
    if kind is not Kind.CHANGE_POINT:
        assert bool(turns.all()) is kind.full_turn
        assert (bar.crank_room >= 0) is kind.full_turn


def test_limits_are_the_ends_of_the_swing():
    bars, _ = random_bars(300, 5, turning=True)
    phi = np.linspace(0, 2 * math.pi, 20001)
    seen = 0
    for k in range(300):
        bar = FourBar(*(float(x[k]) for x in bars.lengths), float(bars.ground_angle[k]), int(bars.branch[k]))
        limits = bar.limits()
        if limits is None:
            continue
        seen += 1
        psi = np.unwrap(np.angle(close(bar, phi + bar.ground_angle).follower.direction))
        assert np.ptp(psi) == pytest.approx(limits.swing, abs=1e-5)
        ends = np.sort([phi[psi.argmax()], phi[psi.argmin()]]) % math.tau
        wanted = np.sort([limits.extended, limits.folded])
        distance = np.abs((ends - wanted + math.pi) % math.tau - math.pi)
        assert distance.max() < 0.02
        if seen == 60:
            break
    assert seen == 60
