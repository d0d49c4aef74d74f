"""Motion laws: closed forms against integrals, peaks against brute force, and the faults of a user's own."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.mechanics.laws import LAWS, HarmonicPieces, Polynomial
from mechwright.mechanics.laws.faults import polynomial_faults, table_faults
from mechwright.mechanics.laws.harmonic import Piece
from mechwright.mechanics.laws.table import Table

ALL = [law() for law in LAWS.values()]
NAMES = list(LAWS)


def rows(law, count, digits=None):
    u = np.linspace(0, 1, count)
    s = law.at(u).s
    return list(zip(u.tolist(), (s if digits is None else s.round(digits)).tolist(), strict=True))


TABLES = [Table(rows(LAWS[name](), 61)) for name in ("cycloidal", "modified-sine", "simple-harmonic")]


@pytest.mark.parametrize("law", [*ALL, *TABLES], ids=[*NAMES, "table-c", "table-s", "table-h"])
class TestEveryLaw:
    def test_goes_from_rest_to_rest(self, law):
        ends = law.at(np.array([0.0, 1.0]))
        assert ends.s == pytest.approx([0, 1], abs=1e-12)
        assert ends.v == pytest.approx([0, 0], abs=1e-12)

    def test_rates_are_derivatives(self, law):
        # Gauss quadrature of each rate between places that avoid breaks gives the change of the one before.
        ends = np.unique(np.concatenate((np.linspace(0, 1, 61), law.breaks)))
        nodes, weights = np.polynomial.legendre.leggauss(12)
        half = np.diff(ends)[:, None] / 2
        u = ends[:-1, None] + half * (nodes + 1)
        inside, at = law.at(u), law.at(ends)
        for order, rate in (("s", "v"), ("v", "a")):
            change = (getattr(inside, rate) * weights * half).sum(axis=1)
            assert change == pytest.approx(np.diff(getattr(at, order)), abs=1e-9)
        # The acceleration may jump at breaks in nothing but its slope.
        change = (inside.j * weights * half).sum(axis=1)
        assert change == pytest.approx(np.diff(at.a), abs=1e-6)

    def test_peaks_are_the_largest(self, law):
        u = np.linspace(0, 1, 200_001)
        found = law.at(u)
        for name in ("v", "a", "j"):
            peak, sampled = getattr(law.peaks, name), np.abs(getattr(found, name)).max()
            assert sampled <= peak * (1 + 1e-9)
            assert sampled == pytest.approx(peak, rel=1e-4)

    def test_never_runs_backwards(self, law):
        assert law.least_velocity >= -1e-9
        assert law.symmetric

    def test_shapes_are_kept(self, law):
        assert law.at(np.full((2, 3), 0.3)).j.shape == (2, 3)
        assert float(law.at(0.3).s) == pytest.approx(float(law.at(np.array([0.3])).s[0]))


@pytest.mark.parametrize(
    ("name", "cv", "ca", "cj"),
    [
        ("cycloidal", 2, 2 * math.pi, 4 * math.pi**2),
        ("modified-sine", 1.7596034, 5.5279571, 69.4663573),
        ("modified-trapezoid", 2, 8 * math.pi / (2 + math.pi), 61.4259748),
        ("3-4-5", 1.875, 10 / math.sqrt(3), 60),
        ("4-5-6-7", 2.1875, 7.5131884, 52.5),
        ("simple-harmonic", math.pi / 2, math.pi**2 / 2, math.pi**3 / 2),
    ],
)
def test_published_coefficients(name, cv, ca, cj):
    peaks = LAWS[name]().peaks
    assert (peaks.v, peaks.a, peaks.j) == pytest.approx((cv, ca, cj), rel=1e-7)


def test_closed_forms_at_one_place():
    u = 0.2
    assert float(LAWS["cycloidal"]().at(u).s) == pytest.approx(
        u - math.sin(math.tau * u) / math.tau, abs=1e-15
    )
    assert float(LAWS["3-4-5"]().at(u).s) == pytest.approx(10 * u**3 - 15 * u**4 + 6 * u**5, abs=1e-15)
    k = 4 + math.pi
    modified = (2 + math.pi * u - 9 / 4 * math.sin((4 * math.pi * u + math.pi) / 3)) / k
    assert float(LAWS["modified-sine"]().at(u).s) == pytest.approx(modified, abs=1e-14)


def test_only_the_simple_harmonic_law_jumps():
    jumping = [name for name in NAMES if max(map(abs, LAWS[name]().jumps)) > 1e-9]
    assert jumping == ["simple-harmonic"]


def test_a_law_may_be_lopsided():
    law = HarmonicPieces("lopsided", [Piece(0.3, 7, 0), Piece(1, -3, 0)])
    assert not law.symmetric
    assert law.breaks == (0.3,)
    assert law.peaks.v == pytest.approx(2.0)
    # s'' = A to u = t, then -A t/(1 - t): s(1) = 1 makes A = 2/t.
    assert law.peaks.a == pytest.approx(2 / 0.3)


@settings(deadline=None, max_examples=40)
@given(
    st.floats(0.05, 0.45),
    st.floats(0.05, 0.45),
    st.floats(0.2, 5),
    st.integers(1, 3),
)
def test_pieces_join_without_a_step(one, gap, height, waves):
    """However the accelerations are chosen, way and velocity go on, and the law ends at 1."""
    pieces = [
        Piece(one, height, 0),
        Piece(one + gap, 0.3, 1, waves * math.tau, 0.4),
        Piece(1, -height / 3, 0.2, math.pi, 1),
    ]
    law = HarmonicPieces("any", pieces)
    for place in law.breaks:
        sides = law.at(np.array([place - 1e-12, place + 1e-12]))
        scale = max(1.0, law.peaks.v)
        assert abs(np.diff(sides.s)[0]) < 1e-9 * scale
        assert abs(np.diff(sides.v)[0]) < 1e-9 * max(1.0, law.peaks.a)
    assert float(law.at(1.0).s) == pytest.approx(1)
    dense = law.at(np.linspace(0, 1, 4001))
    for name in ("v", "a", "j"):
        seen, said = np.abs(getattr(dense, name)).max(), getattr(law.peaks, name)
        assert seen <= said * (1 + 1e-12)
        assert said <= seen * (1 + 1e-2)


@pytest.mark.parametrize("phase", np.linspace(0, math.tau, 7).tolist())
def test_the_least_velocity_is_found_inside_of_a_wave(phase):
    law = HarmonicPieces("wave", [Piece(0.2, 6, 0), Piece(1, 2, 30, 4 * math.pi, phase)])
    seen = law.at(np.linspace(0, 1, 20_001)).v
    assert law.least_velocity == pytest.approx(seen.min(), abs=1e-5 * law.peaks.v)
    assert law.peaks.v == pytest.approx(np.abs(seen).max(), rel=1e-5)


class TestTable:
    def test_meets_its_rows_and_the_law_between(self):
        law = LAWS["modified-sine"]()
        table = Table(rows(law, 41))
        u = np.linspace(0, 1, 41)
        assert table.at(u).s == pytest.approx(law.at(u).s, abs=1e-14)
        between = np.linspace(0, 1, 997)
        assert table.at(between).s == pytest.approx(law.at(between).s, abs=2e-6)
        assert table.at(between).a == pytest.approx(law.at(between).a, abs=0.05)

    def test_more_rows_come_nearer(self):
        law, u = LAWS["cycloidal"](), np.linspace(0, 1, 997)
        errors = [np.abs(Table(rows(law, n)).at(u).a - law.at(u).a).max() for n in (11, 21, 41)]
        assert errors[1] < errors[0] / 8
        assert errors[2] < errors[1] / 8

    def test_an_end_acceleration_is_kept(self):
        assert Table(rows(LAWS["simple-harmonic"](), 41)).jumps == pytest.approx(
            (math.pi**2 / 2, -(math.pi**2) / 2), rel=1e-3
        )
        assert Table(rows(LAWS["cycloidal"](), 41)).jumps == pytest.approx((0, 0), abs=1e-3)


class TestFaults:
    @pytest.mark.parametrize("name", NAMES)
    @pytest.mark.parametrize(("count", "digits"), [(33, None), (33, 5), (17, None)])
    def test_a_table_of_a_law_has_none(self, name, count, digits):
        assert list(table_faults(rows(LAWS[name](), count, digits))) == []

    @pytest.mark.parametrize("coefficients", [(0, 0, 3, -2), (0, 0, 0, 10, -15, 6), (0, 0, 0, 4, -3)])
    def test_a_good_polynomial_has_none(self, coefficients):
        assert list(polynomial_faults(coefficients)) == []

    @pytest.mark.parametrize(
        ("coefficients", "kind"),
        [
            ((0, 1), "rest"),
            ((0, 0, 1), "rest"),
            ((0, 0, 0.5), "ends"),
            ((0.1, 0, 2.7, -1.8), "ends"),
            ((0, 0, -15, 70, -90, 36), "monotone"),
        ],
    )
    def test_a_bad_polynomial(self, coefficients, kind):
        faults = list(polynomial_faults(coefficients))
        assert kind in [fault.kind for fault in faults]
        assert all(fault.remedy and fault.message and math.isfinite(fault.value) for fault in faults)

    def test_the_bad_polynomial_really_runs_backwards(self):
        law = Polynomial((0, 0, -15, 70, -90, 36))
        ends = law.at(np.array([0.0, 1.0]))
        assert ends.s.tolist() == [0, 1]
        assert ends.v == pytest.approx([0, 0], abs=1e-12)
        assert law.at(np.linspace(0, 1, 1001)).v.min() < 0

    def test_bad_tables(self):
        good = rows(LAWS["cycloidal"](), 41)
        bad = {
            "rows": [good[:5], good[:3] + good[2:3] + good[3:], good[::-1]],
            "ends": [good[1:], good[:-1], [*good[:-1], (1.0, 0.9)]],
            "gap": [good[:15] + good[20:], good[:1] + good[7:]],
            "monotone": [[*good[:20], (good[20][0], 0.2), *good[21:]]],
            "rest": [[(u, u) for u, _ in good]],
        }
        for kind, tables in bad.items():
            for table in tables:
                assert [fault.kind for fault in table_faults(table)] == [kind], (kind, table[:3])

    def test_a_table_that_overshoots_between_its_rows(self):
        steps = [(k / 80, 0.0 if k < 40 else 1.0) for k in range(81)]
        assert [fault.kind for fault in table_faults(steps)] == ["monotone"]
