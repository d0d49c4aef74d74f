"""Laws and pitch curves against identities, and against the elliptic gears, which are derived in another way."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from noncircular import TABLES, design

from mechwright import GeometryError
from mechwright.mechanics.gearing import Primitive, RatioLaw, RolledPair, Rolling
from mechwright_elliptic_gears.kinematics.equations import Turning, driven
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import outline_of
from mechwright_noncircular_gears.kinematics.law import law_of
from mechwright_noncircular_gears.kinematics.laws.fourier import FourierLaw
from mechwright_noncircular_gears.sized import SizedParams
from mechwright_noncircular_gears.table import table_of

STEP = 1e-5
SMOOTH = 2e-8
"""Central differences of ratios near 1: rounding over the step."""


@pytest.mark.parametrize("name", TABLES)
def test_rates_are_derivatives_and_close(name):
    law = law_of(design(name))
    phi = law.period * (np.arange(97) + 0.37) / 97
    near = np.abs(phi[:, None] - np.append(np.array(law.breaks), 0.0)).min(axis=1)
    phi = phi[near > 2 * STEP]
    ratio, first, second = law.rates(phi)
    for values, at in (
        (ratio, lambda x: law.angle(x)),
        (first, lambda x: law.rates(x)[0]),
        (second, lambda x: law.rates(x)[1]),
    ):
        slope = (at(phi + STEP) - at(phi - STEP)) / (2 * STEP)
        assert np.abs(slope - values).max() < SMOOTH * max(1.0, np.abs(values).max())
    one, two = law.lobes
    assert law.angle(np.array(0.0)) == pytest.approx(0.0, abs=1e-14)
    assert law.angle(np.array(math.tau / one)) == pytest.approx(math.tau / two, rel=1e-13)


@pytest.mark.parametrize("name", TABLES)
def test_ratio_and_slope_have_no_jump(name):
    law = law_of(design(name))
    for edge in (0.0, *law.breaks):
        before, after = (law.rates(np.array(edge + side)) for side in (-1e-9, 1e-9))
        assert np.abs(np.array(before[:2]) - np.array(after[:2])).max() < 1e-6


@pytest.mark.parametrize("name", ["D1", "D3", "D4", "D8", "SL"])
def test_frames_are_those_of_the_curve(name):
    pair = table_of(design(name)).pair
    t = np.linspace(0.1, 6.1, 41)
    for curve in (pair.driver, pair.driven):
        before, now, after = curve.frame(t - STEP), curve.frame(t), curve.frame(t + STEP)
        way = (after.point - before.point) / (2 * STEP)
        speed = np.linalg.norm(way, axis=1)
        assert speed == pytest.approx(curve.arc_rate(t), rel=1e-7)
        assert np.abs(way / speed[:, None] - now.tangent).max() < 1e-7
        bend = ((after.normal - before.normal) / (2 * STEP) * now.tangent).sum(axis=1) / speed
        assert np.abs(bend - 1 / now.radius).max() < 1e-5
        assert curve.parameter(now.arc) == pytest.approx(t, abs=1e-13)
        assert curve.arc(np.array(math.tau)) == pytest.approx(curve.perimeter, rel=1e-14)


@settings(max_examples=25)
@given(
    st.lists(st.floats(-0.25, 0.25), min_size=1, max_size=3),
    st.lists(st.floats(-0.25, 0.25), max_size=3),
    st.integers(1, 3),
    st.integers(1, 3),
)
def test_curves_roll_on_each_other(sines, cosines, one, two):
    """In the pitch point both curves have one place and one tangent, and Euler and Savary's sum."""
    swing = sum((k + 1) * abs(a) for values in (sines, cosines) for k, a in enumerate(values))
    scale = min(1.0, 0.6 / two / (swing + 1e-9))
    law = FourierLaw((one, two), tuple(scale * a for a in sines), tuple(scale * b for b in cosines))
    phi = np.linspace(0, math.tau, 61)
    assert law.rates(phi)[0].min() > 0
    pair = RolledPair.of(law, 100.0)
    theta2 = pair.law(phi)[0]
    first, second = pair.driver.frame(-phi), pair.driven.frame(phi / pair.driven.sense)

    def there(values, angle):
        return (values[:, 0] + 1j * values[:, 1]) * np.exp(1j * angle)

    at1, at2 = there(first.point, phi), 100.0 + there(second.point, theta2)
    assert np.abs(at1 - at2).max() < 1e-9
    assert np.abs(at1.imag).max() < 1e-9
    # The tangents run against each other: one contact goes clockwise, the other one counter-clockwise.
    assert np.abs(there(first.tangent, phi) + there(second.tangent, theta2)).max() < 1e-10
    ratio, slope, _ = law.rates(phi)
    w, g = 1 + ratio, np.sqrt((ratio * (1 + ratio)) ** 2 + slope**2)
    assert 1 / first.radius + 1 / second.radius == pytest.approx(w**3 / (100 * g), rel=1e-9)
    assert Rolling.of(law, phi).r1 + Rolling.of(law, phi).r2 == pytest.approx(1.0)


def test_an_ellipse_is_the_elliptic_family():
    """Two ways to the same gear: closed forms of the ellipse, and the rolled curve of its law."""
    own = EllipticGearParams(eccentricity=0.3, teeth=39, module=2.0, backlash=0.05)
    law = design("D3", mate_lobes=1, teeth=39, eccentricity=0.3, backlash=0.05)
    theta = np.linspace(0, math.tau, 37)
    mate = driven(Turning.of(theta, 1.0), 0.3)
    turned, ratio = table_of(law).pair.law(theta)
    assert np.exp(1j * turned) == pytest.approx(np.exp(1j * mate.theta), abs=1e-12)
    assert ratio == pytest.approx(mate.omega, abs=1e-12)
    gear = table_of(law).outlines[0]
    points, others = (one.outer.flatten(1e-3) for one in (gear, outline_of(own)))
    assert shapely.hausdorff_distance(shapely.LinearRing(points), shapely.LinearRing(others)) < 2.2e-3


def test_a_shaper_leaves_the_flanks_of_a_rack():
    """Camus: the flank is that of any cutter, down to where the fillet of each begins."""
    table = {"eccentricity": 0.2, "teeth": 40, "mate_lobes": 1, "addendum": 0.8, "tip_radius": 0.2}
    rack, shaper = (table_of(design("D3", **table, cutter=cutter)).teeth[0] for cutter in ("rack", "shaper"))
    assert shaper.tip_trim[0] == pytest.approx(rack.tip_trim[0])
    assert shaper.flank_arcs == pytest.approx(rack.flank_arcs)
    # A round cutter's tip swings out of the space, and less of the flank is left straight.
    assert shaper.rack.straight_depth < rack.rack.straight_depth
    for one in (rack, shaper):
        start, join = one.arc_centres, one.join_arcs
        fillet = one.rack.fillet(one.curve.frame_at(join), start)
        flank = one.rack.flank(one.curve.frame_at(join), one.flank_arcs, np.array([-1.0, 1.0]))
        assert np.abs(fillet - flank).max() < 1e-12
        root = one.rack.fillet(one.curve.frame_at(start), start)
        assert np.abs(root - one.curve.frame_at(start).offset(-one.rack.dedendum)).max() < 1e-12


def test_a_circle_about_its_own_middle_is_a_round_gear():
    """The bound of the centre distance is then the distance itself."""
    for lobes in (1, 2, 3):
        law = law_of(design("D6", eccentricity=0.0, mate_lobes=lobes, teeth=24))
        assert law.rates(np.linspace(0, 6, 7))[0] == pytest.approx(1 / lobes, rel=1e-12)


class Kinked(RatioLaw):
    lobes = (1, 1)

    def rates(self, phi):
        away = np.abs(np.mod(phi, math.tau) - 2.0)
        return 1 + 0.1 * away, 0 * away, 0 * away


def test_a_corner_is_integrated_wherever_it_lies():
    """A panel that holds it is halved until it has no weight."""
    total = math.tau + 0.1 * (2.0**2 + (math.tau - 2.0) ** 2) / 2
    for breaks in ([], [2.0]):
        whole = Primitive.of(lambda phi: Kinked().rates(phi)[0], math.tau, breaks)
        assert whole.total == pytest.approx(total, rel=1e-14)


@pytest.mark.parametrize("function", [lambda x: 1 / (x - 2.0), lambda x: np.where(x < 2.0, 1.0, 1.1)])
def test_a_pole_and_a_jump_are_refused(function):
    with pytest.raises(GeometryError, match=r"jumps, has no bound"):
        Primitive.of(function, math.tau)


@pytest.mark.parametrize(
    ("nodes", "said"),
    [
        ([[0, 0], [400, 350]], "of several turns it is no plane gear"),
        ([[0, 0], [360, 350]], "which is no node; leave out"),
        ([[0, 0], [90, 80], [90.5, 81]], "less than 1 degree apart"),
        ([[0, 0], [90, 80], [180, 80]], "hold the driven gear"),
        ([[10, 0], [90, 80]], "begins at"),
    ],
)
def test_tables_that_are_no_lobe_are_refused(nodes, said):
    with pytest.raises(ValueError, match=said):
        design("D7", nodes=nodes)


@pytest.mark.parametrize("module", [1.0, 1.5])
def test_small_gears_turn_as_exactly_as_large_ones(module: float) -> None:
    """The ovals of a flowmeter: the smaller the driven gear, the nearer its flanks to the exact ones."""
    table = {"law": "ellipse", "lobes": 2, "mate_lobes": 2, "eccentricity": 0.2, "teeth": 30, "bore": 3}
    proof = table_of(SizedParams.model_validate({**table, "module": module})).proof()
    assert not proof.collides
    assert proof.error < 6e-6
