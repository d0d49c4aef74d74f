"""Errors of output angle and path point from arcs and pins, exact and to first order.

On the unit sphere, with A and B the driven pins and C the third one of the loop (B is the output axis of a
four-bar). An arc of crank, arm or ground that is longer by δ carries its end on along its great circle. A pin
of radial clearance ρ on the radius R moves the hole by v, up to ρ/R long, in the tangent plane: that of shaft
and crank pin moves A, the others move the coupler's hole against C, with one component along the coupler's
arc and one across. The loop is

    C·A' = cos(α3 + dα3) - v·A',   C·B' = cos(α4 + dα4),   |C| = 1

and dC solves its derivative, three linear equations with the rows A, B, C; where these lie on one great
circle is a dead centre. With t the prolongation of the ground at B and y its normal, C = cos α4 B + sin α4
(cos ψ t + sin ψ y), so sin α4 dψ = dC·(cos ψ y - sin ψ t) + cos α4 sin ψ dα1. The path point is fixed to the
coupler's A and to the great circle through its two holes.

A bore that is longer than its pin is wide lets the pin tilt besides, off the sphere: that binds, and is no
error of the output.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from mechwright import Array, Output, ToleranceModel, Tolerances
from mechwright.mechanics.planar import Turning
from mechwright_spherical.kinematics.chain import third_position
from mechwright_spherical.kinematics.jets import circle
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.vectors import arc, column, cross, dot, norm, rotate
from mechwright_spherical.parameters import SphericalParams

ANGLE = Output("output angle", "rad")
POINT = Output("path point", "mm", 3)

_POSITIONS = 361
"""Positions over the travel of the phase that is shown."""

_DEAD = 1e-6
"""Volume of A, B and C below which a first order says nothing: errors there go with the square root."""

_ARCS = ("ground", "crank", "coupler", "rocker", "arm")

_MADE = {
    "crank-shaft": "a0",
    "crank-pin": "a",
    "coupler-pin": "c",
    "output-shaft": "b0",
    "arm-pin": "b",
    "arm-shaft": "b0",
}
"""Contributor to the joint of the motion."""

_CRANK_SIDE = ("crank-shaft", "crank-pin")
"""Joints whose play moves A."""


class SphericalTolerances(ToleranceModel):
    """The model of the phase that is shown."""

    input_name = "theta"

    def __init__(self, params: SphericalParams, tolerances: Tolerances) -> None:
        linkage = linkage_of(params)
        self.phase, self.radius = linkage.shown, params.radius
        self.loop = loop = self.phase.loop
        four_bar = linkage.four_bar is not None
        self.positions = np.sort(self.phase.sweep(_POSITIONS))
        keys = ("ground", "crank", "coupler", "rocker") if four_bar else _ARCS
        self.names = dict(
            zip(keys, ("ground", "input", "coupler", "output") if four_bar else _ARCS, strict=True)
        )
        far = ("output-shaft",) if four_bar else ("arm-pin", "arm-shaft")
        self.joints = (*_CRANK_SIDE, "coupler-pin", *far)
        values = {
            "ground": arc(loop.a0, loop.b0),
            "crank": arc(loop.a0, loop.a1),
            "coupler": np.arccos(loop.ca),
            "rocker": np.arccos(loop.cb),
            "arm": arc(loop.b0, loop.b1),
        }
        arcs = [
            tolerances.angle(name, float(value), self.radius * float(value))
            for name, value in ((name, values[key]) for key, name in self.names.items())
        ]
        hardware = params.hardware
        pins = [
            tolerances.pin(
                name,
                hardware.pin_diameter,
                hardware.fit,
                member=name in ("crank-pin", "coupler-pin"),
                joint=_MADE[name],
            )
            for name in self.joints
        ]
        self.contributors = (*arcs, *pins, *tolerances.input("input-angle"))
        self.outputs = (ANGLE, POINT) if four_bar else (POINT,)

    def nominal(self, output: str, at: Array) -> Array:
        """Output angle of a four-bar, rad, from the prolongation of the ground; path point, mm."""
        a, b, c = self._pins(at, {}, {})
        if output == ANGLE.name:
            return self._angle(b, c, 0.0)[None]
        return self.radius * self._point(a, c)

    def sensitivities(self, output: str, at: Array) -> list[Array]:
        """Formulas of the module."""
        a, b, c = self._pins(at, {}, {})
        along, across = _tangents(a, c, c)
        volume = dot(c, cross(a, b))
        with np.errstate(divide="ignore", invalid="ignore"):
            inverse = np.where(np.abs(volume) > _DEAD, 1 / volume, np.nan)
        found = []
        for one in self.contributors:
            moved = []
            for da, db, dc3, dc4, v, dg in self._steps(one.name, a, b, c, along, across)[: one.components]:
                to_a, to_b = dc3 - dot(v, a) - dot(c, da), dc4 - dot(c, db)
                dc = inverse * (to_a * cross(b, c) + to_b * cross(c, a))
                if output == ANGLE.name:
                    moved.append(self._angle_rate(b, c, dc, dg)[None])
                else:
                    moved.append(self.radius * self._point_rate(a, c, da, dc + v))
            found.append(np.stack(moved, axis=1))
        return found

    def errors(self, output: str, deviations: Sequence[Array], at: Array) -> Array:
        """The loop closed anew."""
        named = {one.name: value for one, value in zip(self.contributors, deviations, strict=True)}
        arcs = {key: named[name][0] for key, name in self.names.items()}
        at = at.reshape((1,) * (arcs["ground"].ndim - at.ndim) + at.shape)
        a, b, c = self._pins(at, {}, {})
        turned = at + named["input-angle"][0] if "input-angle" in named else at
        at_a, at_c = _tangents(a, c, a), _tangents(a, c, c)
        shifts = {"a": np.zeros_like(a), "c": np.zeros_like(c)}
        for name in self.joints:
            place, tangents = ("a", at_a) if name in _CRANK_SIDE else ("c", at_c)
            for tangent, size in zip(tangents, named[name], strict=False):
                shifts[place] = shifts[place] + size * tangent / self.radius
        a2, b2, c2 = self._pins(turned, arcs, shifts)
        if output == ANGLE.name:
            return _turned(self._angle(b2, c2, arcs["ground"]) - self._angle(b, c, 0.0))[None]
        return self.radius * (self._point(a2, _unit(c2 + shifts["c"])) - self._point(a, c))

    def _steps(
        self, name: str, a: Array, b: Array, c: Array, along: Array, across: Array
    ) -> list[tuple[Array, ...]]:
        """What a unit of a contributor moves: A, B, both cosines, the coupler's hole, the ground."""
        loop, zero, none = self.loop, np.zeros_like(a), np.zeros(a.shape[1:])
        key = {own: key for key, own in self.names.items()}.get(name, name)
        if key == "ground":
            return [(zero, cross(column(self._normal, b), b), none, none, zero, none + 1)]
        if key == "crank":
            return [(cross(_swing(loop.a0, a), a), zero, none, none, zero, none)]
        if key == "arm":
            return [(zero, cross(_swing(loop.b0, b), b), none, none, zero, none)]
        if key == "coupler":
            return [(zero, zero, none - np.sqrt(1 - loop.ca**2), none, zero, none)]
        if key == "rocker":
            return [(zero, zero, none, none - np.sqrt(1 - loop.cb**2), zero, none)]
        if key == "input-angle":
            turning = loop.ratio * cross(column(loop.b0, b), b) + 0 * a
            return [(cross(column(loop.a0, a), a), turning, none, none, zero, none)]
        if key in _CRANK_SIDE:
            return [(tangent, zero, none, none, zero, none) for tangent in self._play(_tangents(a, c, a))]
        return [(zero, zero, none, none, tangent, none) for tangent in self._play((along, across))]

    def _play(self, tangents: tuple[Array, Array]) -> list[Array]:
        """What a millimetre of play is on the unit sphere."""
        return [tangent / self.radius for tangent in tangents]

    @property
    def _normal(self) -> Array:
        """Of the great circle through both fixed axes, from crank to arm."""
        return _unit(cross(self.loop.a0, self.loop.b0))

    def _pins(
        self, at: Array, arcs: Mapping[str, Array], shifts: Mapping[str, Array]
    ) -> tuple[Array, Array, Array]:
        """A as the coupler has it, B, and C as the rocker has it; NaN where they do not meet."""
        loop = self.loop
        turning = Turning.of(at)
        (a,), (b,) = (
            circle(loop.a0, loop.a1, turning, 0),
            circle(loop.b0, loop.b1, turning.scaled(loop.ratio), 0),
        )
        b = b + np.zeros_like(a)
        if arcs:
            a = rotate(_swing(loop.a0, a), arcs["crank"], a)
            if "arm" in arcs:
                b = rotate(_swing(loop.b0, b), arcs["arm"], b)
            b = rotate(column(self._normal, b), arcs["ground"], b)
        ca, cb = np.asarray(loop.ca), np.asarray(loop.cb)
        if arcs:
            ca, cb = np.cos(np.arccos(ca) + arcs["coupler"]), np.cos(np.arccos(cb) + arcs["rocker"])
        if shifts:
            a = _unit(a + shifts["a"])
            ca = ca - dot(shifts["c"], a)
        return a, b, third_position(a, b, ca, cb, np.asarray(loop.side))

    def _frame(self) -> Array:
        """Place of the path point along A, towards C and across, (3,)."""
        loop = self.loop
        along, towards, across = loop.point
        sine = np.sqrt(1 - loop.ca**2)
        return np.array([along + towards * loop.ca, towards * sine, across * sine], dtype=float).reshape(3)

    def _point(self, a: Array, c: Array) -> Array:
        x, y, z = self._frame()
        third = _unit(cross(a, c))
        return np.asarray(x * a + y * cross(third, a) + z * third)

    def _point_rate(self, a: Array, c: Array, da: Array, dc: Array) -> Array:
        x, y, z = self._frame()
        normal = cross(a, c)
        size = norm(normal)
        third = normal / size
        rate = (cross(da, c) + cross(a, dc)) / size
        rate = rate - third * dot(third, rate)
        return np.asarray(x * da + y * (cross(rate, a) + cross(third, da)) + z * rate)

    def _angle(self, b: Array, c: Array, ground: Array | float) -> Array:
        """ψ (...), rad, from the prolongation of the ground at B to C."""
        y = column(self._normal, b)
        return np.asarray(np.arctan2(dot(c, y + 0 * b), dot(c, cross(y, b)))) + 0 * ground

    def _angle_rate(self, b: Array, c: Array, dc: Array, ground: Array) -> Array:
        y = column(self._normal, b) + 0 * b
        cosine, sine = self.loop.cb, np.sqrt(1 - self.loop.cb**2)
        t = cross(y, b)
        s, k = dot(c, y) / sine, dot(c, t) / sine
        return np.asarray((dot(dc, k * y - s * t) + cosine * s * ground) / sine)


def _tangents(a: Array, c: Array, at: Array) -> tuple[Array, Array]:
    """Directions along and across the coupler's arc from A to C at one of its ends, pointing away from A."""
    across = _unit(cross(a, c))
    return cross(across, at), across


def _swing(axis: Array, v: Array) -> Array:
    """The axis about which a pin goes farther away from the axis it turns about."""
    return _unit(cross(column(axis, v), v))


def _unit(v: Array) -> Array:
    return np.asarray(v / norm(v))


def _turned(angle: Array) -> Array:
    """An angle between -π and π."""
    return np.asarray((angle + np.pi) % (2 * np.pi) - np.pi)
