"""Degrees of the loci of the acceleration pole for a constant ratio, from exact points modulo a prime.

A curve of degree d holds all points if the monomials up to d, one row for each point, have not full rank; its
circular points are m-fold if the terms of its degree d - j are divisible by (x² + y²)^(m - j).
"""

import random
from collections.abc import Callable, Iterator

from flint import nmod, nmod_mat, nmod_poly

PRIME = 2**31 - 1
Point = tuple[nmod, nmod]


def number(value: int) -> nmod:
    return nmod(value, PRIME)


def root(square: nmod) -> nmod | None:
    """A square root, None where there is none; the prime is 3 modulo 4."""
    found = square ** ((PRIME + 1) // 4)
    return found if found * found == square else None


def product(one: Point, two: Point) -> Point:
    return one[0] * two[0] - one[1] * two[1], one[0] * two[1] + one[1] * two[0]


def turned_crank(chance: random.Random) -> Point:
    t = number(chance.randrange(PRIME))
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)


def pole(a: nmod, unit: Point, omega: nmod, steady: nmod, k: nmod) -> Point:
    """G - A = a (1 - i k) e^{iφ} / (i α - ω²)."""
    alpha = steady + k * omega
    size = omega**4 + alpha * alpha
    over = (-omega * omega / size, -alpha / size)
    return product(product((a, -a * k), unit), over)


def slider(lengths: tuple[int, int, int], k: nmod, plane: str, seed: int) -> Iterator[Point]:
    """Points of the locus of a slider-crank a, c, e."""
    a, c, e = map(number, lengths)
    chance = random.Random(seed)  # noqa: S311 - points, no secrets
    while True:
        cos, sin = turned_crank(chance)
        t = e - a * sin
        w = root(c * c - t * t)
        if w is None or w == 0:
            continue
        w *= chance.choice((1, -1))
        omega = -a * cos / w
        lever = pole(a, (cos, sin), omega, (a * sin + t * omega * omega) / w, k)
        if plane == "fixed":
            yield a * cos + lever[0], a * sin + lever[1]
        else:
            yield product(lever, (w / c, -t / c))


def four_bar(lengths: tuple[int, int, int, int], k: nmod, plane: str, seed: int) -> Iterator[Point]:
    """Points of the locus of a four-bar a, c, b, f."""
    a, c, b, f = map(number, lengths)
    chance = random.Random(seed)  # noqa: S311 - points, no secrets
    while True:
        unit = turned_crank(chance)
        d = f - a * unit[0], -a * unit[1]
        square = d[0] * d[0] + d[1] * d[1]
        along = c * c - b * b + square
        w = root(4 * c * c * square - along * along)
        if w is None or w == 0 or square == 0:
            continue
        w *= chance.choice((1, -1))
        s = product(d, (along / (2 * c * square), w / (2 * c * square)))
        p = (c * s[0] - d[0]) / b, (c * s[1] - d[1]) / b
        sine = s[1] * p[0] - s[0] * p[1]

        def solve(r: Point, p: Point = p, s: Point = s, sine: nmod = sine) -> tuple[nmod, nmod]:
            dot = [r[0] * v[0] + r[1] * v[1] for v in (p, s)]
            return -dot[0] / (c * sine), -dot[1] / (b * sine)

        omega, follower = solve((a * unit[1], -a * unit[0]))
        r = tuple(a * unit[i] + c * omega**2 * s[i] - b * follower**2 * p[i] for i in (0, 1))
        lever = pole(a, unit, omega, solve((r[0], r[1]))[0], k)
        if plane == "fixed":
            yield a * unit[0] + lever[0], a * unit[1] + lever[1]
        else:
            yield product(lever, (s[0], -s[1]))


def curve(points: Callable[[], Iterator[Point]], degree: int) -> list[list[int]] | None:
    """Coefficients of x^i y^j by i + j <= degree of the one curve through the points; None for none."""
    terms = [(i, n - i) for n in range(degree + 1) for i in range(n + 1)]
    found = points()
    rows = []
    for _ in range(len(terms) + 20):
        x, y = next(found)
        xs, ys = [number(1)], [number(1)]
        for _ in range(degree):
            xs.append(xs[-1] * x)
            ys.append(ys[-1] * y)
        rows.append([int(xs[i] * ys[j]) for i, j in terms])
    matrix, rank = nmod_mat(len(rows), len(terms), [v for row in rows for v in row], PRIME).rref()
    if rank == len(terms):
        return None
    assert rank == len(terms) - 1, "more than one curve"
    pivots = []
    for row in range(rank):
        pivots.append(next(column for column in range(len(terms)) if int(matrix[row, column])))
    (free,) = set(range(len(terms))) - set(pivots)
    values = {terms[free]: number(1)}
    values |= {terms[column]: -matrix[row, free] for row, column in enumerate(pivots)}
    return [[int(values[(i, n - i)]) for i in range(n + 1)] for n in range(degree + 1)]


def circularity(found: list[list[int]]) -> int:
    """How many-fold the circular points are."""
    fold = len(found)
    circle = nmod_poly([1, 0, 1], PRIME)
    for n, terms in enumerate(found):
        part, times = nmod_poly(terms, PRIME), 0
        if part == 0:
            continue
        while part % circle == 0:
            part, times = part // circle, times + 1
        fold = min(fold, times + len(found) - 1 - n)
    return fold
