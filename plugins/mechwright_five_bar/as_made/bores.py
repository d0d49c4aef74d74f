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

SET = RULE + "; A and C set as their scales say"
PINS = {
    "shaft-a0": ("A0", "ground"),
    "pin-a": ("A", "coupler"),
    "pin-c": ("C", "coupler"),
    "shaft-b0": ("B0", "ground"),
    "pin-b1": ("B1", "rocker"),
}
"""Contributor to the name of its joint, and the plate in whose bore its pin turns."""
STUDS = {"pin-a": ("A", "crank"), "pin-c": ("C", "rocker")}
"""The same of studs that are clamped in slots of the coupler."""


def as_made(m: FiveBarTable, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the linkage with plates as made.

    Where A or C is clamped in a slot, the length of the coupler is set and not made: it counts as drawn, and
    the stud turns in the bore of crank or rocker.
    """
    params = m.params
    if not {*LINKS, "ground"} <= set(made):
        return AsMade()
    studs = {pin: one for pin, one in STUDS.items() if slotted(params, one[0])}
    holes = {
        name: {boss.tag: Hole(boss.centre, boss.bore) for boss in reversed(bosses) if boss.bore}
        for name, bosses in bosses_of(params).items()
    }
    bore = turning_bore(params)
    holes["ground"] = {"A0": Hole(0j, bore), "B0": Hole(complex(params.ground), bore)}
    ends = {name: [one for tag, one in own.items() if tag != "point"] for name, own in holes.items()}
    if studs:
        del ends["coupler"]
    links = {
        name: link(made[name][0], *sorted(own, key=lambda one: abs(one.centre))) for name, own in ends.items()
    }
    bushed = params.running_fit if params.bushing_wall > 0 else None
    joints = {
        pin: joint(shown, made[plate][0], holes[plate][shown], params.pin_diameter, bushed)
        for pin, (shown, plate) in {**PINS, **studs}.items()
    }
    sure = {name: one for name, one in links.items() if one is not None}
    pins = {name: one for name, one in joints.items() if one is not None}
    if len(sure) < len(links) or len(pins) < len(joints):
        return AsMade()
    model = FiveBarTolerances(m, EXACT)
    meshes = {name: Joint(name, params.backlash / 2, 0.0) for name in model.meshes}
    drawn = dict.fromkeys(pins, params.running_fit / 2) | {name: one.room for name, one in meshes.items()}
    errors = made_errors(model, sure, pins | meshes, drawn)
    figures = [one.figure("point.error", SET if studs else RULE) for one in errors]
    figures.append(
        room_figure([*pins.values()], params.running_fit, "; that of the bushings" if bushed else "")
    )
    jammed = stuck("five-bar.as-made", list(pins.values()), "running_fit", params.running_fit)
    return AsMade(tuple(figures), tuple(one.curve("crank") for one in errors), tuple(jammed))
