"""Friction and play of joints: by the fits of their pins, and by what they carry.

Friction is Coulomb's, with the mean force of a joint over its period at the design's speed: a torque
μ r F of a pin of the radius r, a force μ F of a slide. Tilting moments are left out.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mechwright.contracts.bodies import placed
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part
from mechwright.machine.reactions import carried_of
from mechwright.mechanics.mating.choice import Assembled
from mechwright.standards import bearings
from mechwright_cad.exporters.simulation.elements import METRES
from mechwright_cad.exporters.simulation.settings import Options


@dataclass(frozen=True)
class Pin:
    """The pins of a joint in their holes.

    Parameters
    ----------
    radius
        Of the thickest, mm.
    play
        Of the tightest, on the diameter, in the middle of its limits, mm; 0 where it has none.
    rolling
        Whether one of the holes is that of a ball bearing.
    """

    radius: float
    play: float
    rolling: bool


@dataclass(frozen=True)
class Bearings:
    """What the joints of a file have, by their names.

    Parameters
    ----------
    friction
        Torque of a pin, N m, or force of a slide, N.
    play
        How far the axes of both bodies may be apart, m: half the play.
    coefficient
        Of rollers on their walls.
    left_out
        Sentences about what is asked for and not known.
    """

    friction: Mapping[str, float]
    play: Mapping[str, float]
    coefficient: float = 0.0
    left_out: tuple[str, ...] = ()


ROUNDING = 1e-9
"""Share of the greatest force of a joint below which that of another is rounding."""

NONE = Bearings({}, {})
"""Of a file without friction and play."""


def pins_of(parts: Sequence[Part], motion: Motion) -> dict[str, Pin]:
    """The pins of revolute joints, by the joints' names, where parts have them."""
    whole = Assembled(placed(parts, motion), motion)
    found: dict[str, Pin] = {}
    for match in whole.matches:
        if whole.same_group(match):
            continue
        bought = whole.bodies[match.hole].part.bought
        play = max(0.0, sum(match.play) / 2)
        one = Pin(
            match.outside.diameter / 2, play, bought is not None and bought.standard == bearings.STANDARD
        )
        for name in whole.joints_of(match):
            known = found.get(name, one)
            found[name] = Pin(
                max(one.radius, known.radius), min(one.play, known.play), one.rolling or known.rolling
            )
    return found


def bearings_of(parts: Sequence[Part], motion: Motion, options: Options) -> Bearings:
    """Friction and play of all joints, as far as they are wanted.

    Raises
    ------
    DesignError
        Friction is wanted, and the motion does not say how fast it runs, or its input is no angle.
    KinematicsError
        Friction is wanted, and the forces of the joints are not known.
    """
    wanted = options.wanted
    if not wanted.friction and not wanted.play:
        return NONE
    pins = pins_of(parts, motion)
    turning = [name for name, joint in motion.joints.items() if joint.kind == "revolute"]
    missing = [name for name in turning if name not in pins]
    found = replace(
        NONE,
        left_out=tuple(
            f"friction and play of {name}: no pin of the parts turns in a hole" for name in missing
        ),
    )
    if wanted.play:
        play = {name: pin.play / 2 * METRES for name, pin in pins.items() if pin.play > 0}
        found = replace(found, play=play)
    if wanted.friction:
        machine = options.machine
        if not wanted.gravity:
            machine = machine.model_copy(update={"up": "none"})
        means = {
            name: float(np.mean(force)) for name, force in carried_of(motion, parts, machine).forces.items()
        }
        friction = {}
        for name, mean in means.items():
            if mean <= ROUNDING * max(means.values()):
                continue
            if motion.joints[name].kind == "prismatic":
                friction[name] = wanted.friction * mean
            elif name in pins:
                coefficient = bearings.FRICTION if pins[name].rolling else wanted.friction
                friction[name] = coefficient * pins[name].radius * METRES * mean
        found = replace(found, friction=friction, coefficient=wanted.friction)
    return found
