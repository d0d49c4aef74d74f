"""What the sheet says of holding: the force of the heaviest cut, and what bears it, where."""

import math

from mechwright.contracts.details import Chamfer
from mechwright_cam.planning.holding_force import (
    GLUE_SAFETY,
    SAFETY,
    Holding,
    Way,
    clamp_hold,
    glue_hold,
    holding,
)
from mechwright_cam.setup.clamping import (
    COVERED,
    EDGES,
    SCREW,
    SKIN,
    STRAP_ROOM,
    least_margin,
    rims,
    widest_channel,
)
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.limits import HOLDER_GAP
from mechwright_cam.shop.lengths import Lengths

STRAP_HEIGHT = 20.0
"""Of a strap with its nut above the plate, mm."""
TORQUE = 12
"""Of the screw M8 of a strap, N m."""
BROKEN = 0.2
"""What edges are broken by where a drawing says nothing else, mm (ISO 13715 in the title block)."""


def holding_lines(job: Job, to: Lengths) -> list[str]:
    """The heaviest cut, what holds the plate against it, and the tabs against the cuts beside them."""
    found = holding(job)
    if found.push is None:
        return ["No mill works on it: drills press it on the table. Two clamps keep it from turning."]
    push = found.push
    lines = [
        f"The heaviest cut, {push.tool.name} {to.with_unit(round(push.depth, 2))} deep, pushes with "
        f"{push.force:.0f} N (worn edge). What holds the plate has to bear {SAFETY:g} times that, "
        f"{SAFETY * push.force:.0f} N.",
        *_way_lines(job, found, to),
    ]
    if found.tabs is not None and found.low is not None:
        lines.append(
            f"The tabs of one part bear {found.tabs.holds:.0f} N; the cuts beside them push with "
            f"{found.low.force:.0f} N: {found.tab_safety:.1f} times."
        )
    if (clamp := clamp_hold(job)) is not None:
        screw, holds = clamp
        lines.append(
            f"The bore clamp with {screw} 8.8 bears {holds:.0f} N at the rim of the part, where the outside "
            f"is cut: {holds / push.force:.1f} times the heaviest cut."
        )
        if holds < SAFETY * push.force:
            lines.append("That is too little: a second clamp, or tape under the part, keeps it from turning.")
    return lines


def _way_lines(job: Job, found: Holding, to: Lengths) -> list[str]:
    way = found.way
    if way is None:
        margin = to.with_unit(least_margin(widest_channel(job)))
        lines = [
            f"There is no room for that: no rim of {to.with_unit(STRAP_ROOM)} for clamps, and no waste for "
            f"screws. Stock that is {margin} larger on every side has it."
        ]
        glued = glue_hold(job)
        if found.push is not None and glued >= GLUE_SAFETY * found.push.force:
            lines.append(
                f"Or stick it down: superglue between two layers of masking tape under all of it bears "
                f"{glued:.0f} N. Degrease the faces, and keep coolant off."
            )
        return lines
    bears = f"{way.holds:.0f} N, {found.safety:.1f} times"
    if way.straps:
        lines = [
            f"{way.name}, tightened with {TORQUE} N m, bear {bears}: {_straps(way, to)}. Each lies "
            f"{to.with_unit(COVERED)} on the rim, over a support, its heel no lower than its toe."
        ]
        holder = max(mill.holder_diameter for mill in job.mills)
        least = min(rims(job)[strap.edge] for strap in way.straps)
        # A mill's centre is in the middle of its channel, and the strap begins where it covers the rim.
        if least + SKIN + widest_channel(job) / 2 - COVERED < holder / 2:
            out = to.with_unit(math.ceil(STRAP_HEIGHT - job.floor + HOLDER_GAP))
            lines.append(
                f"Holders of ⌀{to.plain(holder)} pass over the straps while the outside is cut: with straps "
                f"{to.with_unit(STRAP_HEIGHT)} high its mills stand {out} out. Lower straps need less."
            )
        return lines
    if way.screws:
        places = ", ".join(f"X {to.signed(x, 1)} Y {to.signed(y, 1)}" for x, y in way.screws)
        return [
            f"The rim does not take clamps enough for that. {way.name}, 8.8, bear {bears}: at {places}. "
            f"Drill their holes of {to.with_unit(SCREW + 0.5)} by hand before the program."
        ]
    return [f"{way.name[0].upper()}{way.name[1:]} bears {bears}."]


def _straps(way: Way, to: Lengths) -> str:
    edges: dict[str, list[str]] = {}
    for strap in way.straps:
        axis = EDGES[strap.edge].upper()
        edges.setdefault(strap.edge, []).append(f"{axis} {to.signed(strap.at, 1)}")
    return "; ".join(f"on the {edge} edge at {' and '.join(at)}" for edge, at in edges.items())


def edge_line(job: Job, to: Lengths) -> str:
    """Which edges the program breaks, and which are broken by hand."""
    wide = to.with_unit(BROKEN)
    if any(isinstance(detail, Chamfer) for detail in job.details):
        return f"The program breaks edges of the face on top. Break all others by {wide} by hand."
    return f"The program breaks no edges: break those of both faces by {wide} by hand."
