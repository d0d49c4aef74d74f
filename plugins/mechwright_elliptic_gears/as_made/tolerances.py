"""Play and transmission error of gears as made, to first order in walls, centre distance and run-out.

With δ = atan2(e sin θ, 1 - e cos θ), the slope of the common pitch tangent, the normals of both flanks stand
α ± δ from the perpendicular to the line of centres, and have the levers h± = s' cos(α ± δ) on the driven
gear, s' from its axis to the pitch point. Where stock d and d' is left on the walls of both gears and the
driven axis stands off by v, along (x, positive apart) and across the line of centres, its play each way is

    play± = [j cos α / 2 - d - d' + vx sin(α ± δ) ± vy cos(α ± δ)] / h±

Both together have to be above 0 at every position, or the pair does not go together; the transmission error
is greatest less least of one of them over a turn. Teeth that stand off their bore turn their v with the gear.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mechwright import Array, Contributor, Output, ToleranceModel, Tolerances
from mechwright_elliptic_gears.kinematics.equations import Turning, driven, pitch_radii, ratio, tilt, train
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.backlash import backlash_of
from mechwright_elliptic_gears.parts.gear import ellipse_of

PLAY = Output("play", "rad", figure="least")
FIRST = Output("play of gear 3", "rad", figure="least")
AHEAD = Output("play of gear 5 ahead", "rad", figure="least")
BEHIND = Output("play of gear 5 behind", "rad", figure="least")
ERROR = Output("transmission error", "rad", figure="spread")

NOMINAL = "nominal"
"""Where the play without deviations stands among its rates."""

_POSITIONS = 361
"""Positions of gear 2, both ends of the turn included."""

Rows = dict[str, Array]
"""Contributor to the rates (m, ...) of one play by its deviation."""


@dataclass(frozen=True)
class PairPlay:
    """One pair, by the numbers of its gears; sizes in mm and rad."""

    driving: str
    driven: str
    semi_major: float
    eccentricity: float
    pressure_angle: float
    backlash: float

    @property
    def gap(self) -> float:
        """Normal gap of one side in the nominal pose, mm."""
        return self.backlash * math.cos(self.pressure_angle) / 2

    @property
    def names(self) -> tuple[str, ...]:
        """Of its contributors, in the order in which they are listed."""
        one, two = self.driving, self.driven
        gears = (f"wall-{one}", f"wall-{two}", f"centre-{one}-{two}")
        return (*gears, f"eccentricity-{one}", f"eccentricity-{two}")

    def contributors(self, tolerances: Tolerances) -> list[Contributor]:
        """Walls of both gears, the centre distance, and teeth that stand off their bores."""
        one, two, centre, first, second = self.names
        return [
            tolerances.wall(one),
            tolerances.wall(two),
            tolerances.centre(centre, 2 * self.semi_major),
            tolerances.eccentricity(first),
            tolerances.eccentricity(second),
        ]

    def side(self, theta: Array, mate: Array, side: int) -> Rows:
        """Play (1, ...), rad, to one side (1 or -1), under NOMINAL, and its rates by each contributor."""
        gear = Turning.of(theta)
        angle = self.pressure_angle + side * tilt(gear, self.eccentricity)
        lever = pitch_radii(gear, self.semi_major, self.eccentricity)[1] * np.cos(angle)
        x, y = np.sin(angle) / lever, side * np.cos(angle) / lever
        wall = (-1 / lever)[None]
        rates = (wall, wall, x[None], -_turned(x, y, theta), _turned(x, y, mate))
        return {NOMINAL: (self.gap / lever)[None], **dict(zip(self.names, rates, strict=True))}


class GearTolerances(ToleranceModel):
    """The model of a pair, or of a train.

    Gears of a pair find their own angle. In a train keys and the coupler fix that of gear 5 to gear 4, so
    each flank of this pair needs play of its own.
    """

    input_name = "theta2"

    def __init__(self, params: EllipticGearParams, tolerances: Tolerances) -> None:
        self.positions = np.linspace(0, 2 * np.pi, _POSITIONS)
        self.phase = params.phase_angle
        size = ellipse_of(params).semi_major, params.eccentricity, math.radians(params.pressure_angle)
        self.first = PairPlay("2", "4" if self.phase is None else "3", *size, backlash_of(params))
        self.second = PairPlay("4", "5", *size, backlash_of(params))
        pairs = [self.first] if self.phase is None else [self.first, self.second]
        self.contributors = tuple(one for pair in pairs for one in pair.contributors(tolerances))
        self.outputs = (PLAY, ERROR) if self.phase is None else (FIRST, AHEAD, BEHIND, ERROR)

    def nominal(self, output: str, at: Array) -> Array:
        """A play, rad, with the backlash of the design and nothing else."""
        return self._rows(output, at)[NOMINAL]

    def sensitivities(self, output: str, at: Array) -> list[Array]:
        """Formulas of the module."""
        rows = self._rows(output, at)
        return [rows.get(one.name, np.zeros((one.components, *at.shape)))[None] for one in self.contributors]

    def errors(self, output: str, deviations: Sequence[Array], at: Array) -> Array:
        """Formulas of the module: what they leave out is of second order, 2 µrad at 20 µm."""
        named = {one.name: value for one, value in zip(self.contributors, deviations, strict=True)}
        rows = self._rows(output, at)
        own = [one for one in rows if one != NOMINAL]
        rates = np.concatenate([rows[one] for one in own])
        values = np.concatenate([named[one] for one in own])
        if values.shape[-1] == 1 < values.ndim and rates.ndim == values.ndim - 1:
            return np.asarray(values[..., 0].T @ rates)[None]  # every mechanism in every position
        return np.asarray(sum(rate * value for rate, value in zip(rates, values, strict=True)))[None]

    def _rows(self, output: str, at: Array) -> Rows:
        """An output at input angles (...)."""
        e, first, second = self.first.eccentricity, self.first, self.second
        three, *more = (
            [driven(Turning.of(at), e)] if self.phase is None else train(Turning.of(at), e, self.phase)
        )
        ahead = first.side(at, three.theta, 1)
        if output in {PLAY.name, FIRST.name}:
            return _sum(ahead, first.side(at, three.theta, -1))
        if self.phase is None:
            return ahead
        four, five = more
        # Gear 4 turns the other way than gear 2, so the flank that drives is the other one.
        if output == BEHIND.name:
            return second.side(four.theta, five.theta, 1)
        other = second.side(four.theta, five.theta, -1)
        if output == AHEAD.name:
            return other
        carried = -ratio(np.cos(four.theta), e)
        return _sum({name: carried * rate for name, rate in ahead.items()}, other)


def _sum(one: Rows, two: Rows) -> Rows:
    """Rates of the sum of two plays."""
    both = one.keys() & two.keys()
    return {**one, **two, **{name: one[name] + two[name] for name in both}}


def _turned(x: Array, y: Array, angle: Array) -> Array:
    """Rates (2, ...) by a displacement that turns with a gear."""
    cos, sin = np.cos(angle), np.sin(angle)
    return np.stack([x * cos + y * sin, y * cos - x * sin])
