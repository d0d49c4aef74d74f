"""Whether gears as their programs leave them go together and turn, and what their joint has."""

from collections.abc import Mapping, Sequence

from mechwright import AsMade, MadePart
from mechwright.mechanics.gearing.running import (
    MadePair,
    about_bore,
    play_curve,
    running_figures,
    running_findings,
)
from mechwright_elliptic_gears.as_made.joint import going_in, joint_figures
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.backlash import least_backlash
from mechwright_elliptic_gears.parts.gear import pair_of, teeth_of
from mechwright_elliptic_gears.parts.gear_parts import gears_of

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
