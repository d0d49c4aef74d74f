"""Checks of the slots: bottom, mouths, undercut, loop, island, web."""

import math
from collections.abc import Iterator

from mechwright import Finding
from mechwright.tolerances import falls_short
from mechwright_geneva.cures import walls_of
from mechwright_geneva.kinematics import Frame
from mechwright_geneva.mechanism import Mechanism
from mechwright_geneva.sound import LEAST_TIP

CURED = tuple(
    f"geneva.{name}" for name in ("offset-sign", "mouth", "undercut", "loop", "island-tip", "island", "web")
)
"""Codes of what is wrong with a curved slot: another offset angle or roller may cure it, which is sought when
the finding is told (:func:`mechwright_geneva.cures.slot_cure`)."""

REGIMES = {-1: "A", 1: "B"}


def slot_findings(m: Mechanism) -> Iterator[Finding]:
    """Everything about the slots that can be told without the rest of the design; the first errors first."""
    found = list(_bottom(m)) or (list(_straight(m)) if m.straight else list(_curved(m)))
    yield from found


def _bottom(m: Mechanism) -> Iterator[Finding]:
    walls = walls_of(m)
    room, wanted = m.bottom - m.groove, walls.hub + walls.least
    if not falls_short(room, wanted):
        return
    most = m.bottom - wanted - m.params.groove_clearance / 2
    given = "roller_radius" not in m.params.left_out
    cure = f"make roller_radius at most {math.floor(most * 100) / 100:g}" if given and most >= 0.5 else ""
    yield Finding.error(
        "geneva.slot-bottom",
        "roller_radius",
        f"the slots come within {room:.3f} mm of the wheel's axis; hub and wall need {wanted:.3f} mm",
        m.roller,
        most,
        "mm",
        cure,
    )


def _straight(m: Mechanism) -> Iterator[Finding]:
    """Two straight slots are nearest where their round bottoms begin, or at the bottoms themselves."""
    web = 2 * (m.bottom * math.sin(m.wheel_half) - m.groove)
    if falls_short(web, m.params.least_wall):
        most = m.bottom * math.sin(m.wheel_half) - (m.params.least_wall + m.params.groove_clearance) / 2
        cure = f"make roller_radius at most {math.floor(most * 100) / 100:g}" if most >= 0.5 else ""
        yield _web(m, web, cure)


def _web(m: Mechanism, web: float, cure: str) -> Finding:
    return Finding.error(
        "geneva.web",
        "roller_radius",
        "neighbouring slots run into each other" if web <= 0 else "the web between slots is too thin",
        web,
        m.params.least_wall,
        "mm",
        cure,
    )


def _curved(m: Mechanism) -> Iterator[Finding]:
    found, offset = m.measures, float(m.frame.offset)
    walls = walls_of(m)
    regime = REGIMES.get(m.side)
    if regime is None or offset * m.side >= 0:
        wanted = "above 0" if m.side <= 0 else "below 0"
        yield Finding.error(
            "geneva.offset-sign",
            "offset_angle",
            f"the wheel turns {_ratio(m):.4g} times as fast as the crank at mid stroke, b/(a - b) is "
            f"{float(m.frame.turning_ratio):.4g}: in this regime {regime or '(a cusp)'} the two ways "
            f"of a slot cross unless the offset angle is {wanted}",
            math.degrees(offset),
            0.0,
            "deg",
        )
        return
    if not found.mouth[0] > 0:
        least = _least_mouth(m.frame, m.groove)
        yield Finding.error(
            "geneva.mouth",
            "offset_angle",
            "the two mouths of a slot overlap",
            math.degrees(abs(offset)),
            least,
            "deg",
        )
        return
    limits = {"island's": float(found.island_limit[0]), "hub's": float(found.hub_limit[0])}
    for which, limit in limits.items():
        if m.groove >= limit:
            yield Finding.error(
                "geneva.undercut",
                "roller_radius",
                f"the wall on the {which} side is undercut: its way is curved more sharply than the roller, "
                f"whose critical radius M b is {limit:.4f} mm with M = {limit / m.crank:.6f}",
                m.roller,
                limit - m.params.groove_clearance / 2,
                "mm",
            )
            return
    if not found.width[0] > 0:
        yield Finding.error(
            "geneva.loop",
            "offset_angle",
            "the island's wall crosses itself in a loop: the roller's ways in and out are too close together",
            float(found.width[0]) * 2,
            0.0,
            "mm",
        )
        return
    tip = limits["island's"] - m.groove
    if falls_short(tip, LEAST_TIP):
        yield Finding.error(
            "geneva.island-tip",
            "roller_radius",
            f"the island's tip has a radius of {tip:.3f} mm",
            tip,
            LEAST_TIP,
            "mm",
        )
    neck = 2 * float(found.neck[0])
    if falls_short(neck, walls.least):
        yield Finding.error(
            "geneva.island",
            "offset_angle",
            f"the island is {neck:.3f} mm wide at its neck",
            neck,
            walls.least,
            "mm",
        )
    if falls_short(float(found.web[0]), walls.least):
        yield _web(m, float(found.web[0]), "")


def _ratio(m: Mechanism) -> float:
    return m.wheel_half / m.crank_half * float(m.law.at(0.5).v)


def _least_mouth(frame: Frame, radius: float) -> float:
    """The offset angle at which the two mouths touch, degrees: sin θoff = (r/l) sin(θw0 + θd0)."""
    sine = radius / float(frame.entry_radius) * math.sin(float(frame.wheel_half + frame.crank_half))
    return math.degrees(math.asin(min(1.0, sine)))
