"""Errors of follower and coupler point from links, pins and the input, exact and to first order.

Pins move the hole of one link against that of the other by v, complex, in the directions along and across the
coupler: v1 at A0, v2 at A, v3 at B, v4 at B0 (ground plate to follower). The loop is then

    v1 + a e^{iφ} + v2 + c e^{iσ} + v3 = f e^{iθ} + v4 + b e^{iψ}

so that all four shift the ground vector. To first order, with N = b sin(σ - ψ), u = e^{iσ}, w = e^{iψ}:

    N dψ              = dc + u·(da e^{iφ} - df e^{iθ} - db w + Σ ±v) + a sin(σ - φ) dφ
    c sin(σ - ψ) dσ   = w·(dc u + da e^{iφ} - df e^{iθ} - db w + Σ ±v) - a sin(φ - ψ) dφ
    dP                = v1 + da e^{iφ} + v2 + i a e^{iφ} dφ + i p u dσ + dp u

A pin's displacement of any joint is an error of the coupler's length. N = 0 is a toggle.
"""

from collections.abc import Sequence

import numpy as np

from mechwright import Array, DesignError, Output, ToleranceModel, Tolerances
from mechwright.mechanics.planar import Plane
from mechwright.mechanics.planar.dyad import directions
from mechwright_four_bar.kinematics.reach import bar_of, course_of
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.plates import joints_of, sides_of

FOLLOWER = Output("follower angle", "rad")
POINT = Output("coupler point", "mm", 2)

LINKS = ("crank", "coupler", "follower", "ground")

_POSITIONS = 361
"""Positions of the crank, both ends of the turn, or of the swing of a lever, included."""


class FourBarTolerances(ToleranceModel):
    """The model of one design; crank angles count from X, as in the motion."""

    input_name = "phi"

    def __init__(self, params: FourBarParams, tolerances: Tolerances) -> None:
        self.bar = bar_of(params)
        if lined_up(params):
            raise DesignError(
                "crank: where all links line up, no error is in proportion to a tolerance; swing the crank "
                "between its change points, or make the linkage a little different"
            )
        self.place = params.coupler_point
        way = course_of(params)
        self.positions = (
            np.sort(way.way(_POSITIONS))
            if way.rocks
            else self.bar.ground_angle + np.linspace(0, 2 * np.pi, _POSITIONS)
        )
        nominal = {name: float(getattr(params, name)) for name in LINKS}
        if sides_of(params) == 2:
            # In each plate its bore stands so far from the middle of those for the posts.
            nominal |= {"ground": params.ground / 2, "ground-2": params.ground / 2}
        self.joints, self.links = tuple(joints_of(params)), tuple(nominal)
        sizes = [tolerances.length(name, value) for name, value in nominal.items()]
        pins = [
            tolerances.pin(name, params.pin_diameter, params.running_fit, member=name in ("pin-a", "pin-b"))
            for name in self.joints
        ]
        point = []
        if self.place is not None:
            point = [
                tolerances.length("point-along", self.place.real),
                tolerances.length("point-across", self.place.imag),
            ]
        angle = tolerances.input("input")
        self.contributors = (*sizes, *pins, *point, *angle)
        self.outputs = (FOLLOWER,) if self.place is None else (FOLLOWER, POINT)

    def nominal(self, output: str, at: Array) -> Array:
        """The follower's angle, rad; the coupler point from A0, mm."""
        crank, u, w = self._closed(np.zeros(4), 0j, at)
        if self.place is None or output == FOLLOWER.name:
            return np.angle(w)[None]
        return components(self.bar.crank * crank + self.place * u)

    def sensitivities(self, output: str, at: Array) -> list[Array]:
        """Formulas of the module."""
        a, b, c = self.bar.crank, self.bar.follower, self.bar.coupler
        crank, u, w = self._closed(np.zeros(4), 0j, at)
        ground = np.exp(1j * np.full(at.shape, self.bar.ground_angle))
        along, one = np.ones(at.shape, dtype=complex), 1j
        # What each deviation adds to the left side of the loop, per unit; those of a pin along and across u.
        shift = [crank, u, -w, *[-ground] * (len(self.links) - 3)]
        pins = [(sign * u * along, sign * one * u) for sign in (1, 1, 1, -1)]
        steps = [[value] for value in shift] + [list(pair) for pair in pins]
        if self.place is not None:
            steps += [[0 * along], [0 * along]]
        steps += [[1j * a * crank]] * (len(self.contributors) - len(steps))
        steps = [row[: item.components] for row, item in zip(steps, self.contributors, strict=True)]
        with np.errstate(divide="ignore", invalid="ignore"):
            sine = (u * np.conj(w)).imag
            rate = np.where(np.abs(sine) > _TOGGLE, 1 / sine, np.nan)
        if output == FOLLOWER.name:
            return [np.stack([_dot(u, d) * rate / b for d in row])[None] for row in steps]
        return self._point(steps, [[_dot(w, d) * rate / c for d in row] for row in steps], u)

    def _point(self, steps: list[list[Plane]], sigma: list[list[Array]], u: Plane) -> list[Array]:
        assert self.place is not None  # noqa: S101 - there is no such output else
        names = [one.name for one in self.contributors]
        direct = {"crank", "shaft", "pin-a", "input"}
        own = {"point-along": u, "point-across": 1j * u}
        found = []
        for name, row, turn in zip(names, steps, sigma, strict=True):
            moved = [
                1j * self.place * u * rate + (d if name in direct else 0) + own.get(name, 0)
                for d, rate in zip(row, turn, strict=True)
            ]
            found.append(components(np.stack(moved)))
        return found

    def errors(self, output: str, deviations: Sequence[Array], at: Array) -> Array:
        """The loop closed anew."""
        named = {one.name: value for one, value in zip(self.contributors, deviations, strict=True)}
        crank, u, w = self._closed(np.zeros(4), 0j, at)
        pins = [_plane(named[name]) * u for name in self.joints]
        turned = at + named["input"][0] if "input" in named else at
        sizes = [*(named[name][0] for name in LINKS[:3]), sum(named[name][0] for name in self.links[3:])]
        moved, s, p = self._closed(sizes, pins[0] + pins[1] + pins[2] - pins[3], turned)
        if self.place is None or output == FOLLOWER.name:
            return np.angle(p * np.conj(w))[None]
        place = self.place + named["point-along"][0] + 1j * named["point-across"][0]
        start = pins[0] + pins[1] + (self.bar.crank + sizes[0]) * moved - self.bar.crank * crank
        return components(start + place * s - self.place * u)

    def _closed(
        self, sizes: Sequence[Array] | Array, shift: Plane | complex, at: Array
    ) -> tuple[Plane, Plane, Plane]:
        """Directions of crank, coupler and follower."""
        bar = self.bar
        crank = np.exp(1j * at)
        ground = (bar.ground + sizes[3]) * np.exp(1j * bar.ground_angle)
        d = ground - (bar.crank + sizes[0]) * crank - shift
        u, w = directions(d, bar.coupler + sizes[1], bar.follower + sizes[2], bar.branch)
        return crank, u, w


def lined_up(params: FourBarParams) -> bool:
    """Whether the crank turns through positions in which all links line up."""
    return bar_of(params).lines_up and params.swing_from is None


_TOGGLE = 1e-6
"""Sine of the angle at B below which a first order says nothing: errors there go with the square root."""


def components(z: Plane) -> Array:
    """Both coordinates (2, ...) of points or displacements of the plane."""
    return np.stack([z.real, z.imag])


def _dot(a: Plane, b: Plane) -> Array:
    product: Array = (np.conj(a) * b).real
    return product


def _plane(v: Array) -> Plane:
    """A pin's displacement: along the coupler alone where it is loaded."""
    return np.asarray(v[0] + 1j * v[1] if len(v) == 2 else v[0] + 0j)
