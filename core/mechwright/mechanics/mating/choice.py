"""Which fit a pin and its hole get where their part says none.

All shafts without a fit get one class, ``shaft``, so that they can be cut from ground bar; the class of the
hole says what the pair is for. ISO 286 speaks of the shaft-basis system of fits.

Glossary
--------
group
    Bodies that move as one.
hub
    A plate on a shaft of its own group that turns about the shaft's axis: it takes a torque.
bush
    A tube that sits in a hole of its own group.
spacer
    A tube round a shaft of its own group that sits in no hole.
"""

from collections.abc import Sequence

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.bodies import Placed, rigid
from mechwright.contracts.fit_settings import RUNNING, Fits
from mechwright.contracts.fits import Fit, hole_fit, running_hole, shaft_fit
from mechwright.contracts.joint import GROUND
from mechwright.contracts.motion import Motion
from mechwright.mechanics.mating.rounds import NEAR, PARALLEL, ROOM, Match, Round, matches, rounds_of

BASIC = "H7"
"""Of a hole whose pin is below its size by a class that has the clearance in it, such as f7."""

DRAWN = 0.002
"""A hole is drawn with a clearance if it is wider than its pin by more, mm."""


class Assembled:
    """The copies of parts at the start of a motion, their groups, and the pins in their holes."""

    def __init__(self, bodies: Sequence[Placed], motion: Motion) -> None:
        self.bodies, self.motion = tuple(bodies), motion
        groups = self._groups = rigid(motion)
        self.heads = [groups[body.instance.body] for body in self.bodies]
        self.rounds = [rounds_of(body, 0) for body in self.bodies]
        self._axes = [
            (
                *_axis(motion, joint.one, joint.point, joint.axis),
                frozenset((groups[joint.one], groups[joint.two])),
            )
            for joint in motion.joints.values()
            if joint.kind == "revolute"
        ]
        every = range(len(self.bodies))
        self.matches: tuple[Match, ...] = tuple(
            match
            for two in every
            for match in matches(self.bodies, 0, [two], range(two))
            if not match.inside.threaded
        )

    def same_group(self, match: Match) -> bool:
        """Whether pin and hole move as one."""
        return self.heads[match.pin] == self.heads[match.hole]

    def pair(self, match: Match) -> str:
        """The names of both parts, as the settings have them.

        A shaft ``shaft`` in a plate ``crank`` is ``"shaft in crank"``.
        """
        return f"{self.bodies[match.pin].part.name} in {self.bodies[match.hole].part.name}"

    def joints_of(self, match: Match) -> list[str]:
        """The joints that a pin makes in its hole: it turns there, or both bodies are of a fixed one."""
        bodies = {self.bodies[k].instance.body for k in (match.pin, match.hole)}
        groups, heads = {self.heads[match.pin], self.heads[match.hole]}, self._groups
        return [
            name
            for name, joint in self.motion.joints.items()
            if (joint.kind == "revolute" and {heads[joint.one], heads[joint.two]} == groups)
            or (joint.kind == "fixed" and {joint.one, joint.two} == bodies)
        ]

    def turns_on(self, k: int, one: Round, on: str | None = None) -> bool:
        """Whether a face has the axis of a joint about which its group turns, on a group or on any."""
        return any(
            self.heads[k] in heads and (on is None or on in heads) and _coaxial(one, point, axis)
            for point, axis, heads in self._axes
        )

    def is_tube(self, k: int) -> bool:
        """Whether a body is a turned ring."""
        turned = self.bodies[k].part.turned
        return turned is not None and turned.bore > 0 and len(turned.steps) == 1

    def in_hole(self, k: int) -> bool:
        """Whether the outside of a body sits in a hole of its own group."""
        return any(match.pin == k and self.same_group(match) for match in self.matches)


def _axis(motion: Motion, body: str, point: Sequence[float], axis: Sequence[float]) -> tuple[Array, Array]:
    if body == GROUND:
        return np.array(point), np.array(axis)
    poses = motion.poses[body]
    turn, place = poses.rotation[0], poses.position[0]
    return turn @ np.array(point) + place, turn @ np.array(axis)


def _coaxial(one: Round, point: Array, axis: Array) -> bool:
    if abs(axis @ one.axis) < 1 - PARALLEL:
        return False
    away = one.at - point
    return bool(np.linalg.norm(away - (away @ axis) * axis) <= NEAR)


def pin_fit(whole: Assembled, match: Match, fits: Fits) -> Fit:
    """The limits of a pin that has none of its own, by what it does in a hole."""
    settings, hole = fits.settings, match.inside.fit
    name = settings.shaft
    if whole.is_tube(match.pin) and whole.same_group(match):
        name = settings.bush
    elif hole is not None and not whole.same_group(match) and hole.lower <= 0:
        name = settings.journal
    return shaft_fit(match.outside.diameter, name)


def hole_class(whole: Assembled, match: Match, fits: Fits) -> str | None:
    """The class of a hole by what the pair is for, with a pin that has its limits.

    None where the drawn clearance decides.
    """
    pin, fit, settings = whole.bodies[match.pin].part, match.outside.fit, fits.settings
    if not whole.same_group(match):
        if settings.running is not None:
            return settings.running
        if fit is not None and fit.upper < 0:  # the pin has all of the clearance
            return BASIC
        return None if match.inside.diameter - match.outside.diameter > DRAWN else RUNNING
    if whole.is_tube(match.hole) and not whole.in_hole(match.hole):
        return settings.spacer
    if fit is not None and fit.lower > 0:
        return settings.housing if _first(whole, match) else settings.dowel
    turns = whole.heads[match.pin] != GROUND and whole.turns_on(match.pin, match.outside, GROUND)
    if pin.bought is not None or turns:
        return settings.hub
    others = {other.hole for other in whole.matches if other.pin == match.pin and whole.same_group(other)}
    plates = [k for k in others if not whole.is_tube(k)]
    # A pin that is thinner, since it runs elsewhere, is held by no press.
    thin = fit is not None and fit.upper < 0 and fit.name != settings.shaft
    return settings.hub if thin or len(plates) > 1 else settings.pressed


def _first(whole: Assembled, match: Match) -> bool:
    """Whether a hole is that of the heaviest, by its plan, of the parts in which a dowel sits."""
    if whole.bodies[match.pin].part.bought is None:
        return True
    holes = [one.hole for one in whole.matches if one.pin == match.pin and whole.same_group(one)]
    return match.hole == max(holes, key=lambda k: (_size(whole, k), -k))


def _size(whole: Assembled, k: int) -> float:
    outline = whole.bodies[k].part.outline
    return 0.0 if outline is None else outline.outer.area


def hole_fit_of(whole: Assembled, match: Match, fits: Fits) -> Fit | None:
    """The limits of a hole by its pin, which has its own; None for room, and where a bought pin has none."""
    name, shaft = hole_class(whole, match, fits), match.outside.fit
    size = match.outside.diameter if shaft is None else shaft.size
    if name is not None:
        return hole_fit(size, name)
    clearance = match.inside.diameter - size
    if shaft is None or clearance >= ROOM:
        return None
    return running_hole(size, clearance, shaft)
