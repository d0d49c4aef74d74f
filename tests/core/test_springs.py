"""Extension springs: closed forms, stocked sizes, and fatigue."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright.errors import DesignError
from mechwright.standards.spring_strength import (
    correction,
    fatigue_safety,
    greatest_force,
    hook_stress,
    initial_stress,
    shear_stress,
    spring_rate,
    tensile_strength,
)
from mechwright.standards.springs import ExtensionSpring, extension_spring, extension_springs

SPRINGS = extension_springs()


def test_rate_is_that_of_a_bar_in_torsion():
    """A wire of the length π D n and the polar moment π d⁴/32 turns at the arm D/2."""
    d, mean, n, shear = 1.6, 12.0, 17.0, 81500.0
    turn_per_newton = math.pi * mean * n * (mean / 2) / (shear * math.pi * d**4 / 32)
    assert spring_rate(d, mean, n) == pytest.approx(1 / (turn_per_newton * mean / 2))


def test_stress_is_that_of_the_torque_in_a_round_bar():
    force, d, mean = 40.0, 1.25, 10.0
    assert shear_stress(force, d, mean) == pytest.approx(force * mean / 2 * (d / 2) / (math.pi * d**4 / 32))
    assert hook_stress(force, d, 1e6 * d) / shear_stress(force, d, 1e6 * d) == pytest.approx(2.0, rel=1e-5)
    assert correction(1.0, 1e9) == pytest.approx(1.0)
    assert correction(1.0, 6.0) == pytest.approx(6.5 / 5.25)


def test_handbook_values():
    """SM wire of 2 mm has 1760 MPa at least (EN 10270-1); the static limit is 0.45 of it."""
    assert tensile_strength(2.0) == pytest.approx(1757, abs=2)
    assert shear_stress(greatest_force(2.0, 14.0), 2.0, 14.0) == pytest.approx(0.45 * tensile_strength(2.0))
    assert initial_stress(2.0, 14.0) == pytest.approx(tensile_strength(2.0) * (0.075 - 0.00375 * 7))


def test_fatigue_of_a_pulsating_force():
    """Of 0 to F swing and mean are alike: 1/n = τ (1/S_e + 1/S_u) in the coils, by hand for 1 mm on 8 mm."""
    shear = 0.67 * 1980
    alternating = 241 / (1 - 379 / shear)
    coils = 8.5 / 7.25 * 8 * 8 * 10 / math.pi
    hooks = ((4 * 64 - 8 - 1) / (4 * 8 * 7) * 16 * 8 * 10 + 4 * 10) / math.pi
    expected = 1 / max(coils * (1 / alternating + 1 / shear), hooks * (0.577 / alternating + 1 / 1980))
    assert fatigue_safety(0.0, 20.0, 1.0, 8.0) == pytest.approx(expected)


@given(st.sampled_from(SPRINGS), st.floats(0.1, 0.9), st.floats(0.05, 0.5))
def test_more_force_or_swing_is_less_safe(spring: ExtensionSpring, share: float, more: float):
    most = share * spring.greatest

    def safety(low: float, high: float) -> float:
        return fatigue_safety(low, high, spring.wire, spring.mean)

    assert safety(0.5 * most, most) > safety(0.5 * most, (1 + more) * most)
    assert safety(0.5 * most, most) > safety((0.5 - more) * most, (1 + more) * most)


@given(st.sampled_from(SPRINGS))
def test_a_stocked_spring_is_a_spring(spring: ExtensionSpring):
    assert 4 <= spring.mean / spring.wire <= 20, "EN 13906-2"
    assert spring.coils >= 3
    assert spring.initial < spring.greatest / 3
    assert spring.longest > spring.free
    assert extension_spring(spring.name) == spring
    body = (spring.coils + 1) * spring.wire
    assert body + 2 * spring.hook == pytest.approx(spring.free)


def test_an_unknown_spring_is_refused_with_its_neighbours():
    with pytest.raises(DesignError, match="1x10x40"):
        extension_spring("1x10x41")


@pytest.mark.parametrize("spring", SPRINGS[:: len(SPRINGS) // 4])
def test_hooks_go_around_both_pins(spring: ExtensionSpring):
    pytest.importorskip("cadquery")
    pin, apart = 0.6 * spring.inside, 1.2 * spring.free
    bought = spring.bought(apart, pin)
    assert bought.stretched
    assert bought.mass == spring.mass
    solid = bought.shape.solid()
    box = solid.BoundingBox()
    assert box.ymax == pytest.approx(spring.outside / 2, abs=0.02)
    assert (box.xmin, box.xmax) == pytest.approx(
        (-pin / 2 - spring.wire, apart + pin / 2 + spring.wire), abs=1e-3
    )
    assert solid.isValid()
