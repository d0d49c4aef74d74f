"""What bought parts take to be fitted: tool, torque, compound."""

import re

from mechwright.contracts.part import Part
from mechwright.errors import DesignError
from mechwright.mechanics.strength.bolts import PROOF, preload, stress_area, tightening_torque
from mechwright.standards.screws import screw_size

_SCREW = re.compile(r"ISO (4762|10642|4026) - M([\d.]+) x [\d.]+ - (\S+)")


def screwed(part: Part, later: int | None = None) -> str:
    """Tool and torque of a screw; empty for what is none that is known.

    ``later``: the number of the step in which it is drawn tight, where that is not its own.
    """
    found = _SCREW.fullmatch(part.bought.designation) if part.bought is not None else None
    if found is None:
        return ""
    standard, size, grade = found[1], float(found[2]), found[3]
    try:
        of = screw_size(size)
    except DesignError:
        return ""
    if standard == "4026":
        return f"Tool: hexagon key {of.set_hexagon:g} mm. Thread locker of medium strength."
    key, head = (of.hexagon, of.head) if standard == "4762" else (of.sunk_hexagon, of.sunk_head)
    if grade not in PROOF:
        return f"Tool: hexagon key {key:g} mm."
    force = preload(stress_area(size, of.pitch), PROOF[grade])
    torque = tightening_torque(force, size, of.pitch, head, of.clearance())
    if later is not None:
        return f"Tool: hexagon key {key:g} mm; only until its head rests: step {later} draws it tight."
    return f"Tool: hexagon key {key:g} mm; tighten to {torque:.2g} N m ({grade}, oiled; half of it in POM)."


def is_coupling(part: Part) -> bool:
    """Whether it is clamped on the ends of two shafts."""
    return part.bought is not None and part.bought.designation.startswith("flexible coupling")


def fitted(part: Part) -> str:
    """What to mind with a circlip, a bearing, a dowel or a coupling; empty for the rest."""
    if is_coupling(part):
        return "Tighten its screw on this shaft; that on the other shaft comes once both stand."
    standard = part.bought.standard if part.bought is not None else ""
    match standard:
        case "DIN 471" | "DIN 472":
            kind = "outer" if standard == "DIN 471" else "inner"
            return f"Tool: pliers for {kind} circlips. Turn the ring in its groove to see that it sits."
        case "ISO 2795":
            return "Press it in on a mandrel as thick as the shaft; never ream it, which closes its pores."
        case "ISO 15":
            return "Press on the ring that sits tight, never through the balls."
        case "ISO 8734" | "ISO 2338":
            return "Tool: soft hammer, drift a little thinner than the dowel."
    return ""
