"""Errors of the wheel from axes, crank, roller and slots, and its plays in the slot and in the lock.

A roller that stands off by v, or a wall that does by v·n, turns the wheel by v·n over the lever of the slot's
normal n on the wheel. At mid stroke of a curved slot there is no lever: errors go with the square root there,
and the model says where.

In dwell the horns of the wheel's concave arc meet the disc: the wheel can turn by the difference of the polar
angles at which the arc and the disc cut its rim, to first order (c + da cos η)/(a sin η) either way with c
the clearance less what is left on both walls, a the distance of the axes, and η half the angle of the arc
seen from the crank. On the line of centres the disc is free while c + da is above 0.
"""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from mechwright import Array, Contributor, Output, ToleranceModel, Tolerances
from mechwright_geneva.as_made.play import Play, drawn_room
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.kinematics.geometry import RIGHT, Points, Stroke, corner_angle
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.parameters import GenevaParams

WHEEL = Output("wheel angle", "rad")
PLAY = Output("play in the slot", "rad", figure="least")
LOCK = Output("play in the lock", "rad", figure="steady")
FREE = Output("clearance of the lock", "mm", figure="steady")

FIT = "H7/h6"
"""Of a roller's pin whose hole has no class that leaves play: H7 locates an h6 pin."""

_POSITIONS = 361
"""Positions over a stroke, both ends included."""

_CURVED = 10.0
"""How much the square of the lever has to exceed shift times :func:`_bend` for the first order to be right
within 5 %: the shift needed for a turn x is lever x + bend x²/2."""

_NEWTON, _STEP = 4, 0.05
"""Steps towards the crank angle at which the slot is as far from the wheel's axis, rad each at most."""


class GenevaTolerances(ToleranceModel):
    """The model of one stroke; crank angles count from its start, as in the motion."""

    input_name = "theta_d"

    def __init__(self, params: GenevaParams, tolerances: Tolerances) -> None:
        self.m = m = mechanism_of(params)
        self.positions = np.linspace(0, 2 * m.crank_half, _POSITIONS)
        fit = f"{params.pin_fit}/h6" if params.pin_fit in {"F7", "H7"} else FIT
        self.contributors: tuple[Contributor, ...] = (
            tolerances.centre("centre", m.axes),
            tolerances.length("crank", m.crank),
            tolerances.pin("roller-pin", m.params.pin_diameter, fit, member=True, joint="roller-1"),
            tolerances.gap("roller-in-slot", params.groove_clearance, 2),
            tolerances.eccentricity("wheel-eccentricity"),
            tolerances.wall("slot-left"),
            tolerances.wall("slot-right"),
            tolerances.wall("lock-wheel"),
            tolerances.wall("lock-disc"),
            tolerances.eccentricity("driver-eccentricity"),
            *tolerances.input("input"),
        )
        # The disc covers both horns of an arc in the middle of a dwell; NaN where a circle misses the rim.
        self.lock_play = m.lock_play(m.arc, m.lock)
        self.locks = m.pitch / 2 - m.crank_half >= m.arc_half and self.lock_play >= 0
        self.outputs = (WHEEL, PLAY, *((LOCK, FREE) if self.locks else ()))
        shift = sum(abs(one.mean) + one.reach for one in self.contributors[:5])
        self.least_lever = 0.0 if m.straight else math.sqrt(_CURVED * shift * _bend(m))
        self.told = (*self._singular(), *(() if self.locks else (_NO_LOCK,)))

    def _singular(self) -> tuple[str, ...]:
        m, half = self.m, self.m.params.groove_clearance / 2
        slack = np.abs(m.lever(m.way(self.positions))) < self.least_lever
        if not slack.any():
            return ()
        low, high = np.degrees(self.positions[slack][[0, -1]])
        words = (
            f"from {low:.1f} to {high:.1f} deg of the crank the slot has next to no lever on the wheel: its "
            "errors go with the square root of what is off, and there is no first order"
        )
        if half > 0:
            turns = Play.of(m.way(np.array([m.crank_half])), drawn_room(m, half)).turns()
            words += f"; at mid stroke the wheel can turn {1000 * np.sum(turns):.3g} mrad in its slot"
        return (f"{words}; preload or brake the load",)

    def nominal(self, output: str, at: Array) -> Array:
        """The wheel's angle, and its plays; where there is no lever that of the least one that counts."""
        m, params = self.m, self.m.params
        if output in {LOCK.name, FREE.name}:
            value = self.lock_play if output == LOCK.name else params.lock_clearance
            return np.full((1, *at.shape), value)
        run = m.way(at)
        return (run.theta if output == WHEEL.name else params.groove_clearance / self._safe(run))[None]

    def sensitivities(self, output: str, at: Array) -> list[Array]:
        """Formulas of the module; NaN where the lever is too short."""
        if output in {LOCK.name, FREE.name}:
            wheel, disc, along = self._lock_rates() if output == LOCK.name else (-1.0, -1.0, 1.0)
            axes = {name: [along, 0.0] for name in ("wheel-eccentricity", "driver-eccentricity")}
            return self._rows({"lock-wheel": [wheel], "lock-disc": [disc], **axes, "centre": [along]}, at)
        run = self.m.way(at)
        normal, lever = self.m.slot_normal(run), self.m.lever(run)
        with np.errstate(divide="ignore"):
            inverse = np.where(np.abs(lever) > self.least_lever, 1 / lever, np.nan)
        if output == PLAY.name:
            return self._rows({name: [-np.abs(inverse)] for name in ("slot-left", "slot-right")}, at)
        arm = np.exp(1j * run.phi)
        shifts: dict[str, list[Points]] = {
            "centre": [1 + 0j * arm],
            "crank": [-arm],
            "roller-pin": [normal, 1j * normal],
            "roller-in-slot": [normal],
            "wheel-eccentricity": [1 + 0j * arm, 1j + 0j * arm],
            "input": [1j * self.m.crank * arm],
        }
        rates = {name: [(np.conj(normal) * v).real * inverse for v in row] for name, row in shifts.items()}
        return self._rows(rates, at)

    def _rows(self, rates: Mapping[str, Sequence[Array | float]], at: Array) -> list[Array]:
        found = []
        for one in self.contributors:
            row = rates.get(one.name, [0.0, 0.0])[: one.components]
            found.append(np.stack([np.broadcast_to(rate, at.shape) for rate in row])[None])
        return found

    def errors(self, output: str, deviations: Sequence[Array], at: Array) -> Array:
        """The roller on its slot's middle line, found anew; plays by their closed forms."""
        named = {one.name: value for one, value in zip(self.contributors, deviations, strict=True)}
        if output == WHEEL.name:
            return self._wheel(named, at)[None]
        if output == PLAY.name:
            walls = named["slot-left"][0] + named["slot-right"][0]
            return np.asarray(-walls / self._safe(self.m.way(at)))[None]
        along = named["centre"][0] + named["wheel-eccentricity"][0] + named["driver-eccentricity"][0]
        wheel, disc = named["lock-wheel"][0], named["lock-disc"][0]
        if output == FREE.name:
            return np.asarray(along - wheel - disc + 0 * at)[None]
        play = self.m.lock_play(self.m.arc - wheel, self.m.lock + disc, along)
        return np.asarray(play - self.lock_play + 0 * at)[None]

    def _safe(self, run: Stroke) -> Array:
        """Size (...) of the lever, not less than the least one that counts, mm."""
        safe: Array = np.maximum(np.abs(self.m.lever(run)), max(self.least_lever, _TINY))
        return safe

    def _wheel(self, named: Mapping[str, Array], at: Array) -> Array:
        """Error (...), rad, of the wheel's angle."""
        m, run = self.m, self.m.way(at)
        normal = m.slot_normal(run)
        pin, off = named["roller-pin"], named["wheel-eccentricity"]
        arm = np.exp(1j * (run.phi - (named["input"][0] if "input" in named else 0.0)))
        centre = m.axes + named["centre"][0] - (m.crank + named["crank"][0]) * arm
        centre = centre + normal * (pin[0] + 1j * pin[1] if len(pin) == 2 else pin[0]) + off[0] + 1j * off[1]
        # A roller off the middle line is one on it that has been shifted by as much.
        beside, reach = named["roller-in-slot"][0], np.abs(centre)
        if m.straight:
            return np.asarray(np.angle(centre * np.conj(run.centre)) + np.arcsin(beside / reach))

        def line(angle: Array) -> tuple[Stroke, Points]:
            there = m.way(angle)
            return there, there.centre - beside * there.normal

        angle = at + 0 * reach
        for _ in range(_NEWTON):
            there, place = line(angle)
            rate = 2 * (np.conj(place) * there.velocity).real
            short = np.abs(rate) < _TINY
            change = (reach**2 - np.abs(place) ** 2) / np.where(short, np.inf, rate)
            angle = angle + np.clip(change, -_STEP, _STEP)
        there, place = line(angle)
        missed = np.abs(np.abs(place) - reach) > _MISSED
        return np.where(missed, np.nan, there.theta - run.theta + np.angle(centre * np.conj(place)))

    def _lock_rates(self) -> tuple[float, float, float]:
        """Derivatives of the play of the lock by the wall of the wheel, that of the disc, and the axes."""
        m, a, rim, lock = self.m, self.m.axes, self.m.rim, self.m.lock
        horn, stop = (a * rim * math.sin(corner_angle(a, rim, radius)) for radius in (m.arc, lock))
        return -m.arc / horn, -lock / stop, (a * a - rim * rim + lock * lock) / (2 * a * stop)


def _bend(m: Mechanism) -> float:
    """ρ² (κ + 1/ρ), mm, at mid stroke: half of it times x² is how far the way falls off the circle."""
    run = m.stroke(np.array([0.5]))
    away = (np.conj(run.normal) * run.centre).real
    return float(np.abs(away * run.regularity(away, RIGHT))[0])


_TINY = 1e-9
"""mm: a lever of this length is none."""

_MISSED = 1e-7
"""mm by which the slot's point may miss the roller: Newton's method ends far below, or not at all."""

_NO_LOCK = "the disc does not cover both horns of the wheel at once, so there is no play of the lock to judge"
