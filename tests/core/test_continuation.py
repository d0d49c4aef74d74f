"""All solutions of equations with parameters, where closed forms say what they are."""

import cmath
import math

import numpy as np
import pytest
from flint import acb, arb, ctx

from mechwright.mechanics.continuation import Start, System, all_solutions, closed
from mechwright.mechanics.continuation.certificate import BITS, balls, krawczyk, refined
from mechwright.mechanics.continuation.complete import certified
from mechwright.mechanics.continuation.paths import FAR, LOST, tracked

CIRCLE = System(lambda z, p: [z[0] * z[0] + z[1] * z[1] - p[0], z[0] * z[1] - p[1]])
"""x² + y² = p, x y = q: (x + y)² = p + 2 q and (x - y)² = p - 2 q, four solutions."""

ROOTS = System(lambda z, p: [z[0] * z[0] * z[0] - p[0]])


def exact_circle(p, q):
    sums, differences = cmath.sqrt(p + 2 * q), cmath.sqrt(p - 2 * q)
    return np.array(
        [
            [(i * sums + j * differences) / 2, (i * sums - j * differences) / 2]
            for i in (1, -1)
            for j in (1, -1)
        ]
    )


def start_of_circle():
    rng = np.random.default_rng(2)
    p, q = 0.7 + 0.9j, -0.4 + 0.3j
    known = closed(
        CIRCLE, exact_circle(p, q)[:1], np.array([p, q]), lambda: somewhere(rng), 12, lambda count: None
    )
    return Start(np.array([p, q]), known)


def somewhere(rng):
    return rng.normal(size=2) + 1j * rng.normal(size=2)


def conjugate(unknowns):
    return np.array([one.conjugate() for one in unknowns], dtype=object)


def sorted_rows(z):
    return np.array(sorted(np.round(z, 9).tolist(), key=lambda row: [(v.real, v.imag) for v in row]))


def test_loops_close_at_the_number_of_solutions():
    start = start_of_circle()
    assert len(start.solutions) == 4
    expected = exact_circle(*start.parameters)
    np.testing.assert_allclose(sorted_rows(start.solutions), sorted_rows(expected), atol=1e-8)


@pytest.mark.parametrize(("p", "q", "real"), [(5, 2, 4), (2, 5, 0), (5, -2, 4)])
def test_all_solutions_are_proven_and_the_real_ones_known(p, q, real):
    start = start_of_circle()
    found = all_solutions(CIRCLE, start, balls(np.array([p, q], dtype=complex)), conjugate, somewhere)
    assert (len(found.proven), found.of, found.complete, len(found.real)) == (4, 4, True, real)
    assert found.count == "4 found of 4 solutions, all of them, each certified"
    boxes = [[complex(one) for one in proof.box] for proof in found.proven]
    np.testing.assert_allclose(sorted_rows(np.array(boxes)), sorted_rows(exact_circle(p, q)), atol=1e-8)


def test_solutions_that_come_together_are_not_counted():
    """At p = 2 q the solutions are two double ones, which have no certificate."""
    start = start_of_circle()
    found = all_solutions(CIRCLE, start, balls(np.array([4, 2], dtype=complex)), conjugate, somewhere)
    assert (len(found.proven), found.complete) == (0, False)
    assert found.count.startswith("0 found of 4 solutions, at least these")


def test_a_certificate_holds_the_root_and_no_other():
    with ctx.workprec(BITS):
        two = np.array([acb(2)], dtype=object)
        proof = certified(ROOTS, np.array([1.26 + 0j]), two, conjugate)
        assert proof is not None
        assert proof.real
        assert proof.box[0].real.overlaps(arb(2).root(3))
        assert float(proof.box[0].real.rad()) < 1e-22
        turned = certified(ROOTS, 1.26 * np.exp([2j * math.pi / 3]), two, conjugate)
        assert turned is not None
        assert turned.real is False


def test_no_certificate_without_a_simple_root():
    with ctx.workprec(BITS):
        zero = np.array([acb(0)], dtype=object)

        def at(z):
            return ROOTS.in_balls(z, zero)

        assert refined(balls(np.array([0.1 + 0j])), at) is None
        assert krawczyk(balls(np.array([1e-30 + 0j])), at) is None
        near = balls(np.array([1.25 + 0j]))
        assert krawczyk(near, lambda z: ROOTS.in_balls(z, np.array([acb(2)], dtype=object))) is None


def test_ends_of_paths_that_do_not_arrive():
    """Of p z² = 1 both solutions run to infinity where p comes to 0."""
    system = System(lambda z, p: [z[0] * z[0] * p[0] - 1])
    paths = tracked(system, np.array([[1.0 + 0j], [-1.0]]), np.array([1.0 + 0j]), np.array([0j]))
    assert set(paths.how.tolist()) <= {FAR, LOST}
    assert paths.arrived.shape == (0, 1)
    half = tracked(system, np.array([[1.0 + 0j]]), np.array([1.0 + 0j]), np.array([0.25 + 0j]))
    assert half.arrived[0, 0] == pytest.approx(2, abs=1e-12)
