"""Every four-bar through nine points: the equations, the start, certificates, and the independent check's counts."""

from collections import Counter

import numpy as np
import pytest
from by_night import in_ci
from pydantic import ValidationError
from synthesis_reference import fact, facts

from mechwright.testing.likeness import repeated
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.kinematics.cognates import cognates
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.synthesis.burmester.rectify import Way, way_through
from mechwright_four_bar.synthesis.nine.equations import evaluate
from mechwright_four_bar.synthesis.nine.make_start import any_linkage, looped, moved
from mechwright_four_bar.synthesis.nine.precise import certificate, followed, points_of
from mechwright_four_bar.synthesis.nine.requirement import NinePointsRequirement
from mechwright_four_bar.synthesis.nine.solving import Triples, all_triples
from mechwright_four_bar.synthesis.nine.start import any_points, start
from mechwright_four_bar.synthesis.nine.synthesis import CIRCLE, drawn, infinite, special, through_nine
from mechwright_four_bar.synthesis.nine.triples import TRIPLES, fingerprints, members, new_ones

BAR, POINT = FourBar(40, 120, 80, 100, 0.3), 60 + 35j


def quiet(*_):
    pass


def at(z, points, way=None):
    values, slopes, along = np.empty(8, complex), np.empty((8, 8), complex), np.empty(8, complex)
    evaluate(z, points, points if way is None else way, values, slopes, along)
    return values, slopes, along


def known():
    """Unknowns of BAR and the points that it draws, over 50 mm: (8,), (2, 8), [[x, y]] in mm."""
    loop = close(BAR, np.array([0.1, 0.7, 1.2, 1.9, 2.4, 3.3, 4.1, 4.9, 5.8]))
    drawn_at = loop.joint_a + POINT * loop.coupler.direction
    origin = drawn_at[0]
    z = np.array([loop.joint_a[0] - origin, -origin, loop.joint_b[0] - origin, 100 * np.exp(0.3j) - origin])
    z = np.stack((z, z.conj()), axis=1).ravel() / 50
    deltas = (drawn_at[1:] - origin) / 50
    return z, np.stack((deltas, deltas.conj())), [(float(p.real), float(p.imag)) for p in drawn_at]


def test_a_linkage_and_its_cognates_fulfil_the_equations():
    z, points, _ = known()
    for one in members(z[None])[0]:
        for each in (one, np.roll(one, 4)):
            values, slopes, _ = at(each, points)
            assert np.abs(values).max() < 1e-12 * np.abs(slopes).max()
            assert fingerprints(each[None]) == pytest.approx(fingerprints(z[None]), rel=1e-12)
    off = z.copy()
    off[1] += 1e-3
    assert np.abs(at(off, points)[0]).max() > 1e-4


def test_slopes_and_rates_are_those_of_the_values():
    rng = np.random.default_rng(1)
    z, points, way = rng.normal(size=8) + 1j * rng.normal(size=8), any_points(rng), any_points(rng)
    _, slopes, along = at(z, points, way)
    step = 1e-6
    for k in range(8):
        by = np.eye(8)[k] * step
        change = (at(z + by, points)[0] - at(z - by, points)[0]) / (2 * step)
        assert change == pytest.approx(slopes[:, k], abs=1e-7 * np.abs(slopes).max())
    change = (at(z, points + step * way)[0] - at(z, points - step * way)[0]) / (2 * step)
    assert change == pytest.approx(along, abs=1e-7 * np.abs(along).max())


def test_the_equations_have_their_degree():
    """On a line through the unknowns values are polynomials of that degree, and of no lower one."""
    rng, degree = np.random.default_rng(2), fact("nine_point.equation_degree")["expected"]
    z, way = rng.normal(size=(2, 8)) + 1j * rng.normal(size=(2, 8))
    points = any_points(rng)
    round_ = np.exp(2j * np.pi * np.arange(16) / 16)
    powers = np.abs(np.fft.fft([at(z + one * way, points)[0] for one in round_], axis=0))
    assert (powers[degree] > 1e-6 * powers.max(axis=0)).all()
    assert (powers[degree + 1 :] < 1e-12 * powers.max(axis=0)).all()


def test_the_start_has_all_triples_each_once():
    base = start()
    assert len(base.solutions) == TRIPLES == fact("nine_point.generic_triples")["expected"]
    assert fact("nine_point.generic_four_bars")["expected"] == 3 * TRIPLES
    assert fact("nine_point.generic_solutions")["expected"] == 6 * TRIPLES
    assert len(new_ones(base.solutions, np.empty((0, 12)))) == TRIPLES
    for z in base.solutions:
        values, slopes, _ = at(z, base.points)
        assert np.abs(np.linalg.solve(slopes, values)).max() < 1e-8


def test_a_loop_from_any_linkage_stays_in_the_start_and_finds_others():
    """The file is what its script makes: another linkage's solution comes to one of the start's."""
    rng, base = np.random.default_rng(5), start()
    z, points = any_linkage(rng)
    assert np.abs(at(z[0], points)[0]).max() < 1e-10
    found = moved(z, points, any_points(rng), base.points)
    assert len(found) == 1
    together = np.concatenate((base.solutions, found))
    assert len(new_ones(together, np.empty((0, 12)))) == TRIPLES
    more = looped(base.solutions[:30], base.points, rng)
    assert len(more) > 35
    assert len(new_ones(np.concatenate((base.solutions, more)), np.empty((0, 12)))) == TRIPLES


def test_certificates_hold_what_is_true_and_nothing_else():
    z, points, places = known()
    texts = [(repr(x), repr(y)) for x, y in places]
    exact = points_of(texts, 50.0)
    proof = certificate(z + 1e-6, exact)
    assert proof is not None
    assert proof.real
    assert proof.z == pytest.approx(z, abs=1e-9)
    assert certificate(np.zeros(8, complex), exact) is None
    # A solution of the start, followed to real points, is complex as a rule.
    base = start()
    complex_ones = moved(base.solutions[:12], base.points, points)
    proofs = [certificate(one, exact) for one in complex_ones]
    assert len(proofs) > 8
    assert False in {one.real for one in proofs if one is not None}


def test_paths_in_balls_end_where_those_in_doubles_do():
    base, (_, points, places) = start(), known()
    exact = points_of([(repr(x), repr(y)) for x, y in places], 50.0)
    near = 0.97 * points + 0.03 * base.points
    one = moved(base.solutions[:1], base.points, near)
    end = moved(one, near, points)[0]
    precise = followed(one[0], near, exact, 0.0)
    assert [complex(value) for value in precise] == pytest.approx(end.tolist(), abs=1e-9)


@pytest.mark.parametrize(
    ("points", "said"),
    [
        ([[k, k * k] for k in range(8)], "8 points are given"),
        ([[k, k * k] for k in range(10)], "10 points are given"),
        ([*([k, k * k] for k in range(8)), [3, 9]], "points 4 and 9 are both (3, 9)"),
        ([*([k, k * k] for k in range(8)), [float("nan"), 9]], "finite number"),
    ],
)
def test_points_that_are_refused(points, said):
    with pytest.raises(ValidationError) as caught:
        NinePointsRequirement(points=points)
    assert said in str(caught.value)


@in_ci
@pytest.mark.parametrize("name", ["problem3", "public2"])
def test_all_triples_of_the_check(name):
    places = fact(f"nine_point.{name}.real_triples")["inputs"]["points"]
    triples = all_triples([(repr(x), repr(y)) for x, y in places], quiet)
    assert triples.complete
    assert len(triples.certified) == fact(f"nine_point.{name}.certified_triples")["expected"]
    assert len(triples.real) == fact(f"nine_point.{name}.real_triples")["expected"]
    assert all(one.real is not None for one in triples.certified)
    farthest = max(np.abs(members(one.z[None])).max() for one in triples.certified) * triples.size
    assert farthest == pytest.approx(fact(f"nine_point.{name}.farthest_entry")["expected"], abs=1e-3)
    bars = drawn(triples, np.array(places) @ [1, 1j])
    assert len(bars) == fact(f"nine_point.{name}.real_four_bars")["expected"]
    kinds, expected = (
        Counter(one.bar.kind.value for one in bars),
        fact(f"nine_point.{name}.four_bars_by_kind")["expected"],
    )
    assert kinds["triple rocker"] == expected["non-Grashof"]
    assert kinds["Grashof double rocker"] == expected["coupler_turns"]
    assert kinds["crank-rocker"] + kinds["rocker-crank"] == expected["a_side_link_turns_or_b_side"]
    assert kinds["double crank"] == expected["double-crank"]
    ways = [way_through(one.a0, one.b0, one.a, one.b) for each in bars for one in (each, each.driven_at_b0)]
    full = [way for way in ways if isinstance(way, Way) and way.full]
    assert len(full) == fact(f"nine_point.{name}.full_crank_one_branch_in_order")["expected"]
    usable = [one["expected"] for one in facts(f"nine_point.{name}.usable")]
    by_crank = sorted(full, key=lambda way: way.bar.crank)
    for way, one in zip(by_crank, sorted(usable, key=lambda one: one["crank"]), strict=True):
        lengths = [one[key] for key in ("crank", "coupler", "follower", "ground")]
        assert way.bar.lengths == pytest.approx(lengths, rel=1e-5)
        assert np.degrees(way.least_angle) == pytest.approx(one["least_transmission_angle_deg"], abs=1e-5)


@in_ci
def test_the_maker_of_nine_points_comes_back():
    """The curve of a crank-rocker: it is found again with its cognate, and drawn where it was asked for."""
    _, _, places = known()
    table = {"points": places, "longest_link": 300, "designs": 50}
    result = FourBars().synthesise("nine-points", NinePointsRequirement.model_validate(table), quiet)
    lengths = [
        [one.params.crank, one.params.coupler, one.params.follower, one.params.ground]
        for one in result.candidates
    ]
    found = [tuple(sorted(one)) for one in lengths]
    makers = [tuple(sorted(one.bar.lengths)) for one in cognates(BAR, 0j, POINT, np.linspace(0.1, 5.8, 60))]
    given = [one for one in found if any(np.allclose(one, maker, rtol=1e-6) for maker in makers)]
    assert len(given) == 1, "the maker or its cognate, whichever builds better"
    assert repeated(FourBars(), result.candidates) == []
    assert all(one.residual.value < 1e-6 for one in result.candidates)
    assert "1442 found of 1442" in result.findings[0].message
    narrow = NinePointsRequirement.model_validate({**table, "least_transmission_angle": 79})
    refused = through_nine(narrow, quiet)
    assert not refused.candidates
    assert "1442 found of 1442" in refused.findings[0].message


GENERAL = [
    18.58 + 50.66j,
    23.44 + 61.32j,
    15.12 + 64.02j,
    4.5 + 59.22j,
    -6.9 + 47.12j,
    -11.68 + 35.5j,
    -11 + 28.22j,
]
HALF = [22 + 13j, 5 + 17j, -11 + 19j, -27 + 8j]


@pytest.mark.parametrize(
    ("points", "said"),
    [
        ([*GENERAL, -5.04 + 26.88j, 5.7 + 35.74j], ""),
        ([k * (1 + 0.25j) for k in range(9)], "all points lie in one line"),
        ([*GENERAL[:5], *(60 + k * (3 - 1j) for k in range(4))], "points 6, 7, 8 and 9 lie in one line"),
        (30 * np.exp(1j * np.array([0, 1, 1.3, 2, 2.2, 3, 4, 5, 5.5])), CIRCLE),
        (
            [*(70 + 10 * np.exp(1j * np.arange(5))), *GENERAL[:4]],
            "points 1, 2, 3, 4 and 5 lie on one circle",
        ),
        ([31, *HALF, *np.conj(HALF)], "the points are their own image under a reflection"),
        ([0, *HALF, *(-one for one in HALF)], "the points are their own image under a turn"),
    ],
)
def test_what_is_special_about_points_is_said(points, said):
    moved_ = np.array(points) * np.exp(0.3j) + 5 - 2j
    assert special(moved_) == said
    assert infinite(moved_) == (said == CIRCLE)


@in_ci
def test_special_points_are_counted_and_not_called_complete():
    places = [(round(40 * np.cos(t), 3), round(18 * np.sin(t), 3)) for t in np.arange(9) * 2 * np.pi / 9]
    triples: Triples = all_triples([(repr(float(x)), repr(float(y))) for x, y in places], quiet)
    assert not triples.complete
    assert triples.far > 0
    assert len(triples.certified) + triples.far + triples.singular + triples.lost == TRIPLES
