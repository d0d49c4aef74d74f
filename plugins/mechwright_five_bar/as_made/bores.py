"""What a five-bar of plates as made does: error of the coupler point."""

from collections.abc import Mapping, Sequence

from mechwright import AsMade, MadePart
from mechwright.mechanics.linkage.made import Hole, Joint, joint, link, stuck
from mechwright.mechanics.linkage.made_error import EXACT, made_errors, room_figure
from mechwright_five_bar.as_made.tolerances import FiveBarTolerances
from mechwright_five_bar.parts.hardware import turning_bore
from mechwright_five_bar.parts.joints import LINKS, bosses_of, slotted
from mechwright_five_bar.table import FiveBarTable

RULE = "Σ |∂P/∂l| Δl, every pin and mesh off in the worst direction; least: pins centred"

TURNING = {
    "shaft-a0": ("A0", "ground", 0),
    "pin-a": ("A", "coupler", 0),
    "pin-c": ("C", "coupler", 1),
    "shaft-b0": ("B0", "ground", 1),
    "pin-b1": ("B1", "rocker", 0),
}
"""Contributor to the name of its joint, the plate in whose bore its pin turns, and which bore of that."""


def as_made(m: FiveBarTable, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the linkage with plates as made."""
    params = m.params
    if not {*LINKS, "ground"} <= set(made) or slotted(params, "A") or slotted(params, "C"):
        return AsMade()  # where A or C is clamped, how well it is set says more than how it is made
    holes = {"ground": [Hole(0j, turning_bore(params)), Hole(complex(params.ground), turning_bore(params))]}
    for name, bosses in bosses_of(params).items():
        own = {boss.tag: boss for boss in reversed(bosses) if boss.tag != "point"}
        ends = sorted(own.values(), key=lambda boss: abs(boss.centre))
        holes[name] = [Hole(boss.centre, boss.bore) for boss in ends]
    links = {name: link(made[name][0], *own) for name, own in holes.items()}
    bushed = params.running_fit if params.bushing_wall > 0 else None
    joints = {
        name: joint(shown, made[plate][0], holes[plate][end], params.pin_diameter, bushed)
        for name, (shown, plate, end) in TURNING.items()
    }
    sure = {name: one for name, one in links.items() if one is not None}
    pins = {name: one for name, one in joints.items() if one is not None}
    if len(sure) < len(links) or len(pins) < len(joints):
        return AsMade()
    model = FiveBarTolerances(m, EXACT)
    meshes = {name: Joint(name, params.backlash / 2, 0.0) for name in model.meshes}
    drawn = dict.fromkeys(pins, params.running_fit / 2) | {name: one.room for name, one in meshes.items()}
    errors = made_errors(model, sure, pins | meshes, drawn)
    figures = [one.figure("point.error", RULE) for one in errors]
    figures.append(
        room_figure([*pins.values()], params.running_fit, "; that of the bushings" if bushed else "")
    )
    jammed = stuck("five-bar.as-made", list(pins.values()), "running_fit", params.running_fit)
    return AsMade(tuple(figures), tuple(one.curve("crank") for one in errors), tuple(jammed))
