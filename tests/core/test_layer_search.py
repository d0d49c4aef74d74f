"""The flattest dealing of plates to layers is the one that trying all of them gives."""

import itertools
import random
import time

import pytest

from mechwright.mechanics.linkage.layer_search import Problem, flattest


def tried(problem):
    """The same by trying every dealing."""
    best = None
    for chosen in itertools.product(*(sorted(choice) for choice in problem.choices)):
        if set(chosen) != set(range(max(chosen) + 1)):
            continue
        if any(len({chosen[plate] for plate in pair}) == 1 for pair in problem.clashes):
            continue
        if any(len({chosen[plate] for plate in group}) > 1 for group in problem.together):
            continue
        ends = [(min(chosen[p] for p in own), max(chosen[p] for p in own)) for own in problem.spindles]
        through = (
            low <= chosen[plate] <= high
            for (low, high), some in zip(ends, problem.blocked, strict=True)
            for plate in some
        )
        above = (
            chosen[plate] > high
            for (_, high), some in zip(ends, problem.covered, strict=True)
            for plate in some
        )
        if any(through) or any(above):
            continue
        cost = (max(chosen), sum(high - low for low, high in ends), *chosen)
        if best is None or cost < best:
            best = cost
    return None if best is None else best[2:]


def drawn(rng):
    """A problem of up to six plates, the first of which is most often the ground's."""
    count = rng.randint(2, 6)
    layers = [frozenset(range(1, count)) for _ in range(count)]
    if rng.random() < 0.9:
        layers[0] = frozenset({0})
    for plate in range(1, count):
        if rng.random() < 0.2:
            layers[plate] = frozenset(rng.sample(range(count + 1), rng.randint(1, 3)))
    plates = range(count)
    spindles = [
        frozenset(rng.sample(plates, rng.randint(1, min(3, count)))) for _ in range(rng.randint(0, 4))
    ]

    def others(own, share):
        return frozenset(plate for plate in plates if plate not in own and rng.random() < share)

    pairs = [frozenset(pair) for pair in itertools.combinations(plates, 2)]
    together = [frozenset(rng.sample(plates, 2))] if rng.random() < 0.15 else []
    return Problem(
        tuple(layers),
        tuple(spindles),
        tuple(pair for pair in pairs if rng.random() < 0.5),
        tuple(others(own, 0.25) for own in spindles),
        tuple(others(own, 0.25) for own in spindles),
        tuple(together),
    )


@pytest.mark.parametrize("seed", range(20))
def test_it_is_the_best_of_all_dealings(seed):
    rng = random.Random(seed)  # noqa: S311
    found = []
    for _ in range(60):
        problem = drawn(rng)
        found.append(flattest(problem))
        assert found[-1] == tried(problem), problem
    assert 5 < sum(one is None for one in found) < 55


def ladder(count, blocked=lambda number: ()):
    """Plates that all clash, each pinned to the next one."""
    plates = range(count + 1)
    spindles = [frozenset({0, 1}), *(frozenset({k, k + 1}) for k in range(1, count))]
    return Problem(
        (frozenset({0}), *(frozenset(range(1, count + 1)) for _ in range(count))),
        tuple(spindles),
        tuple(frozenset(pair) for pair in itertools.combinations(plates, 2)),
        tuple(frozenset(blocked(number)) for number in range(len(spindles))),
        tuple(frozenset() for _ in spindles),
    )


def test_many_plates_take_no_time():
    start = time.perf_counter()
    assert flattest(ladder(12)) == tuple(range(13))
    assert time.perf_counter() - start < 2.0


def test_a_proof_that_there_is_no_way_takes_no_time():
    """Every spindle but the first meets all plates that are not its own: only a row is left, and 3 bars it."""
    start = time.perf_counter()
    others = ladder(10, lambda number: set(range(1, 11)) - {number, number + 1} if number else {3})
    assert flattest(others) is not None
    barred = ladder(10, lambda number: set(range(11)) - {number, number + 1} if number else set(range(2, 11)))
    assert flattest(barred) is not None
    none = Problem(
        barred.choices, (*barred.spindles, frozenset({0, 10})), barred.clashes,
        (*barred.blocked, frozenset({5})), (*barred.covered, frozenset()),
    )  # fmt: skip
    assert flattest(none) is None
    assert time.perf_counter() - start < 2.0
