"""Whether gears as their programs leave them go together and turn, and what their joint has.

Play of the pin that sets the phase, with holes as made, and what it does to the speed of Q.

A pin of diameter d in holes of D3 and D4, r from the axis, lets gear 4 turn by (D3 + D4 - 2 d)/r against
gear 3.
The speed of Q is a product |ω4(θ2)| g(θ4), and the phase enters by θ4 alone: the greatest |d ln v/dφ| over a
turn is the same for every phase.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from mechwright import Array, AsMade, Finding, MadeFigure, MadePart, Severity, Stage
from mechwright.mechanics.gearing.running import (
    MadePair,
    about_bore,
    play_curve,
    running_figures,
    running_findings,
)
from mechwright_elliptic_gears.kinematics.peak import peak
from mechwright_elliptic_gears.kinematics.point import place, speed_of_q
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.backlash import least_backlash
from mechwright_elliptic_gears.parts.dividing import START
from mechwright_elliptic_gears.parts.gear import ellipse_of, pair_of, teeth_of
from mechwright_elliptic_gears.parts.gear_parts import gears_of
from mechwright_elliptic_gears.parts.layout import dividing_of
from mechwright_elliptic_gears.rules.pins import pin_play

MICRO = 1e6
PLAY = "phase-joint.play"
"""Name of the figure that a fit is judged by."""

STEP = 1e-4
"""Rad. Half the difference by which a slope is taken: its error is of the order of 1e-8."""


def phase_sensitivity(params: EllipticGearParams) -> float:
    """The greatest relative change of Q's speed over a turn by the phase joint, 1/rad.

    >>> round(phase_sensitivity(EllipticGearParams(stages=2)), 4)
    1.2477
    """
    e = params.eccentricity
    c = place(params.point_along, params.point_across, ellipse_of(params).semi_major)

    def slope(theta4: Array) -> Array:
        # Gear 5 is to gear 4 as gear 4 is to gear 2 of a single pair, at a speed of 1.
        after, before = (np.log(speed_of_q(theta4 + turn, e, None, c)) for turn in (STEP, -STEP))
        found: Array = np.abs(after - before) / (2 * STEP)
        return found

    return peak(slope).value


def joint_figures(params: EllipticGearParams, made: Mapping[str, Sequence[MadePart]]) -> list[MadeFigure]:
    """Play of the pin and the change of speed that it allows; none without a dividing circle."""
    dividing = dividing_of(params) if params.phase_joint == "pins" else None
    hole = None if dividing is None else dividing.hole_at(params.phase_degrees)
    if dividing is None or hole is None:
        return []
    three, four = made.get("gear-3", ()), made.get("gear-4", ())
    if not (three and four):
        return []
    hole_size, pin = dividing.hole_size, dividing.pin_size
    thin, thick = pin.size + pin.lower, pin.size + pin.upper
    at = dividing.rings[hole.ring] * np.exp(1j * START)
    places = ((three[0], dividing.centre(hole)), (four[0], complex(at)))
    found = [part.hole_at(point.real, point.imag, hole_size.middle) for part, point in places]
    sizes = [hole_size.middle if one is None else one.diameter for one in found]
    wide = sum(sizes) / 2
    corridor = three[0].corridor + four[0].corridor
    design, as_made = pin_play(params), pin_play(params, wide)
    low, high = pin_play(params, wide - corridor, thick), pin_play(params, wide + corridor, thin)
    widest = pin_play(params, hole_size.size + hole_size.upper, thin)
    plays = [widest, design, as_made, low, high]
    speed = 50 * phase_sensitivity(params)  # percent by half of the play, either way
    return [
        _figure(
            PLAY,
            "free turn of gear 4 against gear 3",
            "µrad",
            [play * MICRO for play in plays],
            "(D3 + D4 - 2 d)/r, pin g6; what fit H7/g6 allows is asked for",
        ),
        _figure(
            "phase-joint.speed",
            "change of Q's speed by half of that turn, greatest over a turn of gear 2",
            "%",
            [play * speed for play in plays],
            "max |d ln v/dφ|, the same at every phase",
        ),
    ]


def going_in(figures: Sequence[MadeFigure]) -> list[Finding]:
    """Whether the pin goes into its holes as made: ``figures`` are those of the joint."""
    plays = [figure for figure in figures if figure.name == PLAY]
    return [
        Finding(
            "train.phase-fit",
            Severity.ERROR if play.made <= 0 else Severity.WARNING,
            "phase_joint",
            "as made the pin does not go into its holes"
            if play.made <= 0
            else "as made the thickest pin does not go into the narrowest holes",
            play.made if play.made <= 0 else play.low,
            0.0,
            "µrad",
            "ream the holes of the pin to H7: drill them 0.2 mm smaller first",
            Stage.MACHINING,
        )
        for play in plays
        if play.low <= 0
    ]


def _figure(name: str, title: str, unit: str, values: list[float], rule: str) -> MadeFigure:
    asked, design, as_made, low, high = values
    return MadeFigure(name, title, unit, asked, design, as_made, low, high, rule)


PAIR_RULE = "least with which gears as made turn: 2 (D + c sin α / √(1 - e²)) / cos α"
TRAIN_RULE = "least with which a train as made turns: 2 (D + c) / cos α"


def as_made(params: EllipticGearParams, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the pair, or both pairs of a train: part name to its copies as made."""
    pairs = pairs_of(params, made)
    figures = [figure for pair in pairs for figure in running_figures(pair)]
    curves = [play_curve(pair) for pair in pairs]
    joint = joint_figures(params, made)
    findings = [finding for pair in pairs for finding in running_findings(pair)]
    findings += going_in(joint)
    return AsMade((*figures, *joint), tuple(curves), tuple(findings))


def pairs_of(params: EllipticGearParams, made: Mapping[str, Sequence[MadePart]]) -> list[MadePair]:
    """The pairs of a design whose parts are there."""
    bodies: dict[str, MadePart] = {}
    bores: dict[str, float] = {}
    for gear in gears_of(params):
        copies = made.get(gear.name, ())
        for number, (body, _) in enumerate(gear.bodies):
            bores[body] = params.bore if gear.seat is None else gear.seat.middle
            if copies:
                bodies[body] = copies[min(number, len(copies) - 1)]
    wanted = [("gear-2", "gear-4")] if params.stages == 1 else [("gear-2", "gear-3"), ("gear-4", "gear-5")]
    return [
        MadePair(
            pair_of(params),
            teeth_of(params),
            (one, two),
            (about_bore(bodies[one], bores[one]), about_bore(bodies[two], bores[two])),
            bodies[one].corridor + bodies[two].corridor,
            (least_backlash(params), PAIR_RULE if params.stages == 1 else TRAIN_RULE),
            params.stages == 1,
        )
        for one, two in wanted
        if one in bodies and two in bodies
    ]
