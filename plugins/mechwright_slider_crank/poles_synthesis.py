"""Slider-cranks whose coupler has its acceleration pole in given places (seed document 000).

In the slide frame the pole of a crank angle φ is G = a exp(i φ) (1 + 1/(i α - ω²)): two equations for each
pole. With the crank's rotation between two poles given, a, c, e and the first angle are four unknowns for
four equations; with free angles three poles give six equations for six unknowns. Very many random starts go
through Levenberg and Marquardt's method at once, for each assembly by itself, so that no solution changes its
assembly between poles. A solution is certified: its residual is bounded in interval arithmetic.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from flint import acb, arb, ctx

from mechwright.motion import Array
from mechwright.multistart import distinct, solve_all
from mechwright.planar import Plane
from mechwright_slider_crank.figures import least_transmission_angle

ACCURACY = 1e-10
"""Largest certified distance of a pole from its place, over the largest distance of a pole from the pivot."""

_SAME = 1e-6
"""Solutions closer than this, relative, are one."""

_FIRST, _NEAR, _POLISH = 30, 1e-2, 200
"""Steps of every start, the residual that makes a start worth more, and how many more it then gets: most
starts are lost at once, and badly conditioned solutions are slow at the end."""

_FAR_SHARE = 0.3
"""Share of starts with a short crank and a slide line far off, where a few solutions lie."""

_ANGLES, _CHANCE = 90, 1.0
"""Angles of a turn among which a start chooses, and how freely."""

_DIGITS = 40
"""Digits of the certificate: enough to leave no doubt about a residual of 1e-10."""


@dataclass(frozen=True, slots=True)
class Found:
    """A slider-crank through the poles.

    Parameters
    ----------
    crank, rod, offset
        a, c, e, mm.
    branch
        +1 with the slider ahead of the crank pin, -1 behind.
    angles
        Crank angles at the poles from the slide's direction, rad.
    residual
        Certified bound of the distance of any pole from its place, mm.
    """

    crank: float
    rod: float
    offset: float
    branch: int
    angles: tuple[float, ...]
    residual: float

    @property
    def transmission(self) -> float:
        """Least transmission angle, rad."""
        return least_transmission_angle(self.crank, self.rod, self.offset)


def pole(phi: Array, crank: Array, rod: Array, offset: Array, branch: int) -> Plane:
    """The acceleration pole in the slide frame; arrays broadcast; NaN where nothing can be assembled."""
    pin = crank * np.exp(1j * phi)
    t = offset - pin.imag
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        w = branch * np.sqrt(rod * rod - t * t)
        turn = -pin.real / w
        bend = (pin.imag + t * turn * turn) / w
        place: Plane = pin * (1 + 1 / (1j * bend - turn * turn))
    return place


def through_poles(
    poles: Plane,
    rotations: Array,
    starts: int,
    seed: int,
    heard: Callable[[float, str], None],
) -> tuple[list[Found], float]:
    """Find slider-cranks through two poles with a rotation between them, or three with free angles.

    Parameters
    ----------
    poles
        Places (2,) or (3,) in the slide frame, mm.
    rotations
        (1,) rad from the first pole to the second, or (0,) for free angles.
    starts, seed
        Random starts for each assembly.
    heard
        Told of the progress.

    Returns
    -------
    found, best
        Solutions whose crank turns fully, by transmission angle, best first; and the least residual of any
        start that ended with a crank that turns, mm.
    """
    scale = float(np.abs(poles).max())
    wanted = poles / scale
    found: list[Found] = []
    best = math.inf
    for number, branch in enumerate((1, -1)):
        heard(number / 2, f"{starts} starts, slider {'ahead of' if branch > 0 else 'behind'} the crank pin")
        equations = _equations(wanted, rotations, branch)
        x, error = solve_all(equations, _random(wanted, rotations, branch, starts, seed), _FIRST)
        turning = np.exp(x[:, 1]) > np.exp(x[:, 0]) + np.abs(x[:, 2])
        best = min(best, scale * float(np.min(error, where=turning, initial=math.inf)))
        near = x[turning & (error < _NEAR)]
        x, error = solve_all(equations, near, _POLISH)
        good = x[error < ACCURACY]
        good[:, 3:] = np.angle(np.exp(1j * good[:, 3:]))
        for row in good[distinct(good, _SAME)]:
            solution = _certified(row, wanted, rotations, branch, scale)
            if solution.residual <= ACCURACY * scale:
                found.append(solution)
    heard(1.0, f"{len(found)} solutions")
    return sorted(found, key=lambda one: (-one.transmission, one.crank)), best


def _angles(x: Array, rotations: Array) -> Array:
    """Crank angles (n, poles) of rows of unknowns."""
    if rotations.size == 0:
        return x[:, 3:]
    return x[:, 3:4] + np.concatenate(([0.0], rotations))


def _equations(wanted: Plane, rotations: Array, branch: int) -> Callable[[Array], Array]:
    """Residuals of rows (log a, log c, e, angles)."""

    def residuals(x: Array) -> Array:
        with np.errstate(over="ignore", invalid="ignore"):
            a, c = np.exp(x[:, :1]), np.exp(x[:, 1:2])
        miss = pole(_angles(x, rotations), a, c, x[:, 2:3], branch) - wanted
        return np.concatenate((miss.real, miss.imag), axis=1)

    return residuals


def _random(wanted: Plane, rotations: Array, branch: int, starts: int, seed: int) -> Array:
    """Starting points that can be assembled at every angle."""
    rng = np.random.default_rng(seed)
    # Most solutions have sizes like the poles' distances; some have a short crank beside a far slide line, or
    # a rod that only just lets the crank round.
    far = rng.random(starts) < _FAR_SHARE
    a = np.exp(rng.normal(np.where(far, -3.0, -0.5), 1.0))
    e = rng.choice((-1.0, 1.0), starts) * np.exp(rng.normal(np.where(far, 0.5, -1.0), 1.0))
    c = (a + np.abs(e)) * (1 + np.exp(rng.normal(np.where(far, -4.0, -0.7), 1.5)))
    grid = np.linspace(-math.pi, math.pi, _ANGLES, endpoint=False)
    if rotations.size:
        turned = grid[:, None] + np.concatenate(([0.0], rotations))
        places = pole(turned, a[:, None, None], c[:, None, None], e[:, None, None], branch)
        miss = np.abs(places - wanted).max(axis=2)[:, None]
    else:
        places = pole(grid, a[:, None], c[:, None], e[:, None], branch)
        miss = np.abs(places[:, None] - wanted[:, None])
    # The nearest angle, or by chance another one that is near: a pole's path may come by several times.
    chance = np.exp(_CHANCE * rng.standard_exponential(miss.shape))
    angles = grid[np.argmin(miss * chance, axis=2)]
    return np.column_stack((np.log(a), np.log(c), e, angles))


def _certified(row: Array, wanted: Plane, rotations: Array, branch: int, scale: float) -> Found:
    """The solution in mm, with the bound of its residual."""
    a, c, e = scale * math.exp(row[0]), scale * math.exp(row[1]), scale * float(row[2])
    angles = _angles(row[None], rotations)[0]
    with ctx.workdps(_DIGITS):
        worst = max(
            _distance(a, c, e, branch, float(row[3]) if rotations.size else float(phi), turn, place * scale)
            for phi, turn, place in zip(
                angles, (0.0, *rotations) if rotations.size else (0.0,) * len(wanted), wanted, strict=True
            )
        )
    return Found(a, c, e, branch, tuple(float(phi) for phi in angles), worst)


def _distance(a: float, c: float, e: float, branch: int, phi: float, turn: float, place: complex) -> float:
    """Upper bound of the pole's distance from its place, in interval arithmetic."""
    angle = arb(phi) + arb(turn)
    x, y = arb(a) * angle.cos(), arb(a) * angle.sin()
    t = arb(e) - y
    w = branch * (arb(c) ** 2 - t * t).sqrt()
    omega = -x / w
    alpha = (y + t * omega * omega) / w
    found = acb(x, y) * (1 + 1 / acb(-omega * omega, alpha))
    return float(abs(found - acb(place.real, place.imag)).abs_upper())
