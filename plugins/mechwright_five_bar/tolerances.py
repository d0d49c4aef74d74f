"""Errors of the coupler point from links, pins, gears and the input, exact and to first order.

Pins move the hole of one link against that of the other by v, complex, in the directions along and across the
coupler: v1 at A0, v2 at A, v3 at C, v4 at B0, v5 at B1. The play of a mesh lets the arm run ahead or behind
by dφ = s/r, s along the pitch circle and r that of the wheel. The loop is then

    v1 + r1 e^{iθ} + v2 + c e^{iσ} + v3 = f e^{iγ} + v4 + r4 e^{iφ} + v5 + r3 e^{iψ}

To first order, with u = e^{iσ}, w = e^{iψ} and E what is added to the left side but for dc and dσ:

    c sin(σ - ψ) dσ = w·(dc u + E),   E = dr1 e^{iθ} - df e^{iγ} - dr4 e^{iφ} - dr3 w + Σ ±v
                                          + i r1 e^{iθ} dθ - i r4 e^{iφ} (ρ dθ + dφ)
    dP              = v1 + dr1 e^{iθ} + v2 + i r1 e^{iθ} dθ + i p u dσ + dp u
"""

from collections.abc import Sequence

import numpy as np

from mechwright import Array, GeometryError, Output, ToleranceModel, Tolerances
from mechwright.mechanics.planar import Plane
from mechwright.mechanics.planar.dyad import directions
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.reach import bar_of, course_of
from mechwright_five_bar.train import train_of

POINT = Output("coupler point", "mm", 2)

LINKS = ("crank", "coupler", "rocker", "arm", "ground")
PINS = {"shaft-a0": 1, "pin-a": 1, "pin-c": 1, "shaft-b0": -1, "pin-b1": -1}
"""Joints, and whether their displacement adds to the left side of the loop or to the right one."""

_POSITIONS = 361
"""Positions per turn of the crank, or of the swing of a lever, both ends included."""

_TOGGLE = 1e-6
"""Sine of the angle at C below which a first order says nothing: errors there go with the square root."""


class FiveBarTolerances(ToleranceModel):
    """The model of a design that shows its first phase; crank angles count from X, as in the motion."""

    input_name = "theta"

    def __init__(self, params: FiveBarParams, tolerances: Tolerances) -> None:
        self.bar, self.place = bar_of(params), params.coupler_point
        way = course_of(params)
        turns = 1 if way.rocks else self.bar.turns
        self.positions = np.sort(
            way.way(_POSITIONS)
            if way.rocks
            else np.linspace(0, 2 * np.pi * turns, (_POSITIONS - 1) * turns + 1)
        )
        try:
            train = train_of(params)
            self.wheel = train.radius("wheel")
            self.meshes = tuple(f"mesh-{one}-{two}" for one, two in train.meshes())
        except GeometryError:  # it moves all the same, but its gears cannot be made
            self.wheel, self.meshes = 1.0, ()
        sizes = [tolerances.length(name, float(getattr(params, name))) for name in LINKS]
        pins = [
            tolerances.pin(name, params.pin_diameter, params.running_fit, member=name in ("pin-a", "pin-c"))
            for name in PINS
        ]
        plays = [tolerances.gap(name, params.backlash, 2) for name in self.meshes]
        point = [
            tolerances.length("point-along", self.place.real),
            tolerances.length("point-across", self.place.imag),
        ]
        self.contributors = (*sizes, *pins, *plays, *point, *tolerances.input("input"))
        self.outputs = (POINT,)

    def nominal(self, output: str, at: Array) -> Array:  # noqa: ARG002 - there is one
        """The coupler point from A0, mm."""
        one, u, _ = self._closed({}, 0j, at)
        return components(one + self.place * u)

    def sensitivities(self, output: str, at: Array) -> list[Array]:  # noqa: ARG002 - there is one
        """Formulas of the module."""
        bar = self.bar
        one, u, w = self._closed({}, 0j, at)
        crank, arm = one / bar.crank, np.exp(1j * self._arm(at))
        none = np.zeros_like(u)
        ground = none + np.exp(1j * bar.ground_angle)
        behind = -1j * bar.arm * arm
        # What a deviation adds to the left side of the loop, and to the point by itself; pins along, across.
        steps: dict[str, list[tuple[Plane, Plane]]] = {
            "crank": [(crank, crank)],
            "coupler": [(u, none)],
            "rocker": [(-w, none)],
            "arm": [(-arm, none)],
            "ground": [(-ground, none)],
            "point-along": [(none, u)],
            "point-across": [(none, 1j * u)],
            "input": [(1j * one + bar.ratio * behind, 1j * one)],
        }
        for name, sign in PINS.items():
            carries = 1.0 if name in ("shaft-a0", "pin-a") else 0.0
            steps[name] = [(sign * d, carries * d) for d in (u, 1j * u)]
        steps |= {name: [(behind / self.wheel, none)] for name in self.meshes}
        with np.errstate(divide="ignore", invalid="ignore"):
            sine = (u * np.conj(w)).imag
            rate = np.where(np.abs(sine) > _TOGGLE, 1 / sine, np.nan) / bar.coupler
        found = []
        for item in self.contributors:
            rows = [
                direct + 1j * self.place * u * (np.conj(w) * added).real * rate
                for added, direct in steps[item.name][: item.components]
            ]
            found.append(components(np.stack(rows)))
        return found

    def errors(self, output: str, deviations: Sequence[Array], at: Array) -> Array:  # noqa: ARG002 - one
        """The loop closed anew."""
        named = {one.name: value for one, value in zip(self.contributors, deviations, strict=True)}
        one, u, _ = self._closed({}, 0j, at)
        shifts = {name: _plane(named[name]) * u for name in PINS}
        turned = at + named["input"][0] if "input" in named else at
        play = sum((named[name][0] for name in self.meshes), np.zeros_like(at)) / self.wheel
        sizes = {name: named[name][0] for name in LINKS}
        shift = sum((PINS[name] * v for name, v in shifts.items()), np.zeros_like(u))
        moved, s, _ = self._closed(sizes, shift, turned, play)
        place = self.place + named["point-along"][0] + 1j * named["point-across"][0]
        start = shifts["shaft-a0"] + shifts["pin-a"] + moved - one
        return components(start + place * s - self.place * u)

    def _arm(self, at: Array) -> Array:
        return np.asarray(self.bar.offset + self.bar.ratio * at)

    def _closed(
        self,
        sizes: dict[str, Array],
        shift: Plane | complex,
        at: Array,
        play: Array | float = 0.0,
    ) -> tuple[Plane, Plane, Plane]:
        """A from A0, and the directions of coupler and rocker."""
        bar = self.bar
        one = (bar.crank + sizes.get("crank", 0.0)) * np.exp(1j * at)
        arm = (bar.arm + sizes.get("arm", 0.0)) * np.exp(1j * (self._arm(at) + play))
        ground = (bar.ground + sizes.get("ground", 0.0)) * np.exp(1j * bar.ground_angle)
        coupler = bar.coupler + sizes.get("coupler", 0.0)
        u, w = directions(
            ground + arm - one - shift, coupler, bar.rocker + sizes.get("rocker", 0.0), bar.branch
        )
        return one, u, w


def components(z: Plane) -> Array:
    """Both coordinates (2, ...) of points or displacements of the plane."""
    return np.stack([z.real, z.imag])


def _plane(v: Array) -> Plane:
    """A pin's displacement: along the coupler alone where it is loaded."""
    return np.asarray(v[0] + 1j * v[1] if len(v) == 2 else v[0] + 0j)
