"""Whether the machine can be set from phase to phase, how, and whether its clamps hold."""

import math
from collections.abc import Iterator

from mechwright import Finding, KinematicsError, Severity, Stage, of_stage
from mechwright.contracts.finding import Change
from mechwright.mechanics.linkage.clamp import least_stud
from mechwright.mechanics.strength.bolts import CLAMP_SAFETY
from mechwright.tolerances import exceeds, falls_short
from mechwright_five_bar.hardware import clamp_of_design, turning_bore
from mechwright_five_bar.hub import hub_of
from mechwright_five_bar.joints import slotted
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.peaks import peaks_of
from mechwright_five_bar.phases import pose_angles, set_joints


def setting_findings(params: FiveBarParams) -> Iterator[Finding]:
    """Whether the machine can be set, and in which order; ``params`` as the design has them."""
    if not params.phases:
        return
    try:
        crank, rocker = pose_angles(params)
    except KinematicsError as error:
        said, _, remedy = str(error).partition("; ")
        yield Finding.error(
            "five-bar.setting", "setting_angle", said.partition(": ")[2], params.setting_angle, unit="deg",
            remedy=remedy,
        )  # fmt: skip
        return
    ways = set_joints(params)
    for number, row in enumerate(params.phases, start=2):
        steps = [
            f"turn the crank to {crank:.6g} degrees in phase 1 and pin the coupler to the ground",
            "open the clamp of the arm's gear and hold the arm",
            f"{_open(ways['A'].slot is not None, 'A')}, turn the crank by {row.crank_turn:+.6g} degrees to "
            f"{crank + row.crank_turn:.6g} and fasten A",
            "close the clamp of the arm's gear",
            f"{_open(ways['C'].slot is not None, 'C')}, turn the rocker by {row.rocker_turn:+.6g} degrees to "
            f"{_angle(rocker + row.rocker_turn):.6g} and fasten C",
            "draw the pins and see the point on its mark",
        ]
        yield Finding(
            "five-bar.setting",
            Severity.NOTE,
            "phases",
            f"phase {number}: "
            + "; ".join(f"{step}. {what}" for step, what in enumerate(steps, start=1))
            + f". The places are {_chord(params.crank, row.crank_turn):.4g} mm (A) and "
            f"{_chord(params.rocker, row.rocker_turn):.4g} mm (C) from those of phase 1",
            stage=Stage.PARTS,
        )


def _open(slot: bool, name: str) -> str:
    return f"loosen the clamp of {name}" if slot else f"take {name} out of its hole"


def _angle(degrees: float) -> float:
    """From -180 to 180."""
    return math.remainder(degrees, 360.0)


def _chord(radius: float, degrees: float) -> float:
    return 2 * radius * abs(math.sin(math.radians(degrees) / 2))


@of_stage(Stage.PARTS)
def places_apart(params: FiveBarParams) -> Iterator[Finding]:
    """Whether holes, slots and the point leave material between them in the coupler."""
    ways, clamp = set_joints(params), clamp_of_design(params)
    point, bore = params.coupler_point, turning_bore(params)
    code = "five-bar.phases" if params.phases else "five-bar.bores"
    if clamp is None and any(one.slot is not None for one in ways.values()):
        least = least_stud()
        yield Finding.error(
            code,
            "pin_diameter",
            f"the phases need pivots in one place, so they are set in slots, and no screw clamps a stud of "
            f"{params.pin_diameter:g} mm in plates of {params.thickness:g} mm",
            params.pin_diameter,
            least,
            "mm",
            f"take pins of {least:g} mm or more and plates of 6 mm, or pins so thin that each phase has "
            "its holes",
            proposed=({"parameters.pin_diameter": least, "parameters.thickness": 6.0},),
        )
        return
    gaps: list[tuple[float, float, str]] = []
    for name, one in ways.items():
        if one.slot is not None:
            gaps.append(
                (one.slot.distance(point), (one.slot.width + params.pin_diameter) / 2, f"slot {name}")
            )
        else:
            gaps += [(abs(at - point), (bore + params.pin_diameter) / 2, f"hole {name}") for at in one.places]
    a, c = ways["A"], ways["C"]
    if a.slot is not None and c.slot is not None:
        gaps.append((a.slot.apart(c.slot), (a.slot.width + c.slot.width) / 2, "slots A and C"))
    for one, two in ((a, c), (c, a)):
        if one.slot is not None and two.slot is None:
            gaps += [
                (one.slot.distance(at), (one.slot.width + bore) / 2, "a slot and a hole") for at in two.places
            ]
    if a.slot is None and c.slot is None:
        gaps += [(abs(x - y), bore, "holes A and C") for x in a.places for y in c.places]
    for distance, halves, what in gaps:
        needed = halves + params.rim
        if falls_short(distance, needed):
            between = what.startswith(("slots", "holes", "a slot"))
            yield Finding.error(
                code,
                "phases" if params.phases else "coupler" if between else "coupler_point_x",
                (f"the phases need pivots in one place: {what} are" if between and params.phases else
                 f"{what} are" if between else f"{what} is")
                + f" {distance:.4g} mm {'apart in the coupler' if between else 'from its point'}, and "
                f"openings and rim need {needed:.4g} mm",
                distance,
                needed,
                "mm",
                "set the machine in another pose, or take smaller pins, bushings or rims"
                if params.phases
                else "move the point, lengthen the coupler, or take smaller pins, bushings or rims",
                proposed=_smaller(params),
            )  # fmt: skip
            return


def _smaller(params: FiveBarParams) -> tuple[Change, ...]:
    return tuple(
        {"parameters.pin_diameter": size, "parameters.rim": min(params.rim, size / 2)}
        for size in (8.0, 6.0, 5.0, 4.0, 3.0)
        if size < params.pin_diameter
    )


@of_stage(Stage.PARTS)
def clamps_hold(params: FiveBarParams) -> Iterator[Finding]:
    """Whether screws are long enough, and friction more than what pulls."""
    clamp, hub = clamp_of_design(params), hub_of(params)
    if clamp is None:
        return
    peaks = peaks_of(params)
    for name in "AC":
        if not slotted(params, name):
            continue
        force = CLAMP_SAFETY * peaks[f"force_{name}"].value
        if exceeds(force, clamp.holds):
            least = least_stud(force)
            yield Finding.warning(
                "five-bar.clamp",
                "pin_diameter",
                f"the clamp of {name} holds {clamp.holds:.4g} N by friction, and {CLAMP_SAFETY:g} times "
                "the load is "
                f"{force:.4g} N",
                force,
                clamp.holds,
                "N",
                "take thicker pins, whose screws are larger, a smaller load or a lower speed",
                proposed=({"parameters.pin_diameter": least},) if math.isfinite(least) else (),
            )
        yield Finding.note(
            "five-bar.clamp",
            f"{name} is set in a slot {clamp.width:g} mm wide and clamped by an M{clamp.size.size:g}, "
            "tightened with "
            f"{clamp.tightening:.3g} N m; it holds {clamp.holds:.4g} N, and carries up to "
            f"{force / CLAMP_SAFETY:.4g} N",
            clamp.holds,
            "N",
        )
    if hub is not None:
        torque, held = peaks["arm_torque"].value, hub.torque(params.pin_diameter)
        if exceeds(torque, held):
            yield Finding.warning(
                "five-bar.clamp",
                "pin_diameter",
                f"the clamp of the arm's gear holds {held:.4g} N m, and it carries up to {torque:.4g} N m",
                torque,
                held,
                "N*m",
                "take thicker pins, whose screws are larger, a smaller load or a lower speed",
            )
        yield Finding.note(
            "five-bar.clamp",
            f"the arm's gear is clamped by two M{hub.clamp.size.size:g} over {math.degrees(hub.sweep):.4g} "
            "degrees; "
            f"they hold {held:.4g} N m with safety, and carry up to {torque:.4g} N m",
            held,
            "N*m",
        )
