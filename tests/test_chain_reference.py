"""Every number of the reference about chains: rates by 40 digits of another hand, and Geneva wheels."""

import math
from functools import cache

import numpy as np
import pytest
from numpy.polynomial import Chebyshev
from plugins.noncircular import REFERENCE, TABLES
from scipy.optimize import brentq
from test_chain import D1, after, chain, last, linked

from mechwright import Turning
from mechwright.mechanics.chain.running import inputs_of
from mechwright.mechanics.laws import cycloidal
from mechwright_geneva.kinematics.straight_slot import StraightSlot
from mechwright_noncircular_gears.kinematics.laws.indexing import IndexLaw

PAIR = ("noncircular-gears", D1)
FACTS = {one["name"]: one for one in REFERENCE["facts"] if one["design"] not in TABLES}


def slope(values, at: float, reach: float = 0.2) -> float:
    """The derivative of a smooth function of arrays, by interpolation."""
    return float(Chebyshev.interpolate(values, 24, [at - reach, at + reach]).deriv()(at))


def turned(at: np.ndarray) -> Turning:
    """An input of 1 rad/s at angles, which begins at 0."""
    return Turning.of([0.0, *at], 1.0)


@cache
def rates_of(stages: tuple[str, ...]) -> tuple[float, ...]:
    """Place and four derivatives of what comes out at 0.5 rad of the input."""
    if stages == ("gears", "gears"):
        design = chain(PAIR, PAIR)

        def out(at):
            found = last(design, turned(at))
            return found.theta[1:], found.omega[1:], found.alpha[1:], found.jerk[1:]
    else:
        links = linked(chain(PAIR, ("slider-crank", {"crank": 30, "rod": 100, "offset": 0})))

        def out(at):
            *_, own = inputs_of(links, turned(at))
            motion = links[-1].transmission.motion(own, np.zeros(at.size + 1))
            return tuple(motion[name][1:] for name in ("s", "v", "a", "jerk"))

    first = [float(one[0]) for one in out(np.array([0.5]))]
    return (*first, slope(lambda at: out(at)[3], 0.5))


def jerk_of_a_slider() -> float:
    """Behind an input that itself speeds up."""
    links = linked(chain(PAIR, ("slider-crank", {"crank": 30, "rod": 100, "offset": 0})))
    *_, own = inputs_of(links, after(0.5, 4.0, 2.0, -5.0))
    return float(links[-1].transmission.motion(own, np.array([0.0, 1.0]))["jerk"][1])


@cache
def inverse() -> tuple[float, ...]:
    """Rates of the input that turns the output evenly: each follows from the pair's own rates."""
    design, found = chain(PAIR, PAIR), [0.0, 0.0, 0.0]
    pair = linked(design)[0].transmission

    def rates(at, w, e, j):
        out = pair.move(Turning.of(at, w, e, j))
        return -out.omega, -out.alpha, -out.jerk

    def needed(at):
        w = 1 / rates(at, 1.0, 0.0, 0.0)[0]
        e = -rates(at, w, 0.0, 0.0)[1] * w
        return w, e, -rates(at, w, e, 0.0)[2] * w

    found = [float(one) for one in needed(np.array(0.5))]
    # The fourth by the angle of the output is the slope of the third over its speed there, 1.
    return (*found, slope(lambda at: needed(at)[2], 0.5) * found[0])


@cache
def wheel() -> dict[str, float]:
    """Of four slots, that turn on in a quarter of the input: peaks of straight slots and of the pair's law."""
    per_crank = 2 / math.pi  # Δ/β², both a quarter turn

    def least(ramp: float) -> float:
        return IndexLaw((1, 1), 4, ramp, math.pi, 1.0).constant

    return {
        "Ca_straight": StraightSlot(4).peaks.a,
        "peak_per_crank": StraightSlot(4).peaks.a * per_crank,
        "cycloidal_per_crank": cycloidal().peaks.a * per_crank,
        "Ca_bang_bang": least(0.0),
        "bang_bang_per_crank": least(0.0) * per_crank,
        "law_b_0.145_per_crank": least(0.145) * per_crank,
        "b_for_2.62": brentq(lambda b: least(b) * per_crank - 2.62, 0.01, 0.4, xtol=1e-14),
    }


def value(design: str, key: str) -> float:
    """A figure of the reference by what chains compute."""
    if design == "geneva4":
        return wheel()[key]
    if design == "inverse_D1":
        return inverse()[int(key[1]) - 1]
    if key == "jerk":
        return jerk_of_a_slider()
    rates = rates_of(("gears", "gears") if design == "two_D1" else ("gears", "slider"))
    return rates[0 if key.startswith("out") else int(key[1])]


@pytest.mark.parametrize("name", FACTS)
def test_every_number(name: str) -> None:
    """Fourth derivatives, which no chain gives, are slopes of the third by interpolation: to 1e-9 of them."""
    fact = FACTS[name]
    allowed = fact["tolerance"]
    if ".d4@" in name:
        allowed = max(allowed, 1e-9 * abs(fact["expected"]))
    design, key = name.removeprefix("chain.").split(".", 1)
    assert value(design, key) == pytest.approx(fact["expected"], abs=allowed)
