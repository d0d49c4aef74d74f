"""What bought parts take to be fitted: tool, torque, compound."""

import re
from collections.abc import Callable, Iterable

from mechwright.contracts.fits import hole_fit, shaft_fit
from mechwright.contracts.part import Part
from mechwright.mechanics.strength.tightening import torque_text
from mechwright.standards import bearings, bushes, circlips, dowels
from mechwright.standards.hexagon_keys import BIT_LENGTH
from mechwright_cad.assembly_order.reach import Tool
from mechwright_cad.bodies import is_coupling
from mechwright_cad.contacts.screw_joints import ScrewJoint, screw_of

_KEY = re.compile(r"DIN 6885 - [AB] ([\d.]+) x ")

KEY_WIDTH = "h9"
"""Class of the width of a parallel key (DIN 6885-1)."""

LOCKER = "thread locker of medium strength"


_TOOLS: dict[Tool | None, str] = {
    "key": "hexagon key {:g} mm",
    "long key": "hexagon key {:g} mm, its long arm in the screw",
    "bit": f"hexagon bit {{:g}} mm, {BIT_LENGTH:g} mm long",
    "ball end": "hexagon key {:g} mm with a ball end, tilted",
    None: "none that is known gets to it; hexagon {:g} mm",
}
"""Access to a screw to the words for its tool."""


def screwed(
    part: Part,
    joint: ScrewJoint | None = None,
    name: Callable[[int], str] = str,
    later: int | None = None,
    reached: Tool | None = "key",
) -> str:
    """Tool and torque of a screw; empty for what is none that is known.

    Parameters
    ----------
    joint
        The thread that it is in, from which its torque follows.
    name
        Gives the words for a body by its number.
    later
        The number of the step in which it is drawn tight, where that is not its own.
    reached
        The tool that gets to it; None if none does.
    """
    screw = screw_of(part)
    if screw is None:
        return ""
    tool = f"Tool: {_TOOLS[reached].format(screw.key)}"
    if not screw.head:
        return f"{tool}. {LOCKER.capitalize()}."
    found = None if joint is None else joint.tightening
    if joint is None or found is None:
        return f"{tool}."
    if later is not None:
        return f"{tool}; only until its head rests: step {later} draws it tight."
    torque, weakest = torque_text(found.torque), joint.weakest
    if weakest is None:
        return f"{tool}; tighten to {torque} N m ({screw.grade}, oiled)."
    if found.limit == "holder":
        return (
            f"{tool}; tighten by hand to {torque} N m at most: the rubber of {name(weakest)} bears no more. "
            f"Hold that by its metal face, and secure the screw with {LOCKER}."
        )
    where = {"thread": "in its thread", "head": "under the head"}[found.limit]
    return f"{tool}; tighten to {torque} N m ({screw.grade}, oiled): {name(weakest)} bears no more {where}."


def keyed(key: Part, shafts: Iterable[tuple[int, Part]], name: Callable[[int], str]) -> str:
    """How tightly a parallel key goes into its seat in one of the shafts, each with its number.

    Empty for what is no parallel key, and where no shaft has a seat of its width.
    """
    found = _KEY.match(key.bought.designation) if key.bought is not None else None
    if found is None:
        return ""
    width, bodies = float(found[1]), {one.body for one in key.instances}
    for k, shaft in shafts:
        seats = shaft.turned.seats if shaft.turned is not None else ()
        seat = next((one for one in seats if one.width == width), None)
        if seat is not None and bodies & {one.body for one in shaft.instances}:
            hole, pin = hole_fit(width, seat.limits), shaft_fit(width, KEY_WIDTH)
            tight, loose = pin.upper - hole.lower, hole.upper - pin.lower
            return (
                f"Its seat in {name(k)}, {hole.short} / {pin.name}, is from {tight:.3f} mm tight to "
                f"{loose:.3f} mm loose: tap it in with a soft hammer, until it lies on the floor all along."
            )
    return ""


def is_outer_ring(part: Part) -> bool:
    """Whether it is a circlip on a shaft."""
    return part.bought is not None and part.bought.standard == circlips.ON_SHAFTS


def fitted(part: Part) -> str:
    """What to mind with a circlip, a bearing, a dowel or a coupling; empty for the rest."""
    if is_coupling(part):
        return "Its other screw stays loose until both shafts stand."
    standard = part.bought.standard if part.bought is not None else ""
    if standard in circlips.STANDARDS:
        kind = "outer" if standard == circlips.ON_SHAFTS else "inner"
        return f"Tool: pliers for {kind} circlips. Turn the ring in its groove to see that it sits."
    if standard == bushes.STANDARD:
        return "Never ream it, which closes its pores. Let it soak in oil before the shaft comes."
    if standard == bearings.STANDARD:
        return "Never press through the balls."
    if standard in dowels.STANDARDS:
        return "Tool: soft hammer, drift a little thinner than the dowel."
    return ""
