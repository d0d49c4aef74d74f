"""The wheel's counterbore: a recess about its bore for head or washer of a screw in the end of the shaft."""

import math
from collections.abc import Iterator

from mechwright import Finding, Loop, Pocket, Stage, circle
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.parts.dowels import hub_dowels, web_place

SHOULDER = 0.5
"""Least width of the flat that a washer rests on, mm."""


def counterbore(m: Mechanism, thickness: float) -> list[Pocket]:
    """The recess in a wheel plate of this thickness, mm; none if it is not asked for."""
    params = m.params
    if params.counterbore_diameter == 0:
        return []
    rim = Loop((circle((0.0, 0.0), params.counterbore_diameter / 2, tag="counterbore"),))
    depth = params.counterbore_depth
    top = thickness - depth if params.counterbore_side == "underside" else 0.0
    return [Pocket("counterbore", rim, (), top, depth, params.counterbore_radius)]


def _greatest(m: Mechanism) -> float:
    """Radius up to which nothing but the bore is cut into the wheel, less the least wall, mm."""
    params = m.params
    nearest = [m.bottom - m.groove, m.axes - m.arc]
    nearest += [math.hypot(*place) - params.fixing / 2 for place in hub_dowels(m)]
    if m.params.slots_made == "backed" and params.fixing > 0:
        nearest.append(math.hypot(*web_place(m)[0]) - params.fixing / 2)
    return min(nearest) - params.least_wall


def counterbore_findings(m: Mechanism) -> Iterator[Finding]:
    """Walls, floor and shoulder of the counterbore, and whether anything covers it."""
    params = m.params
    if params.counterbore_diameter == 0:
        return
    plate = m.params.groove_depth if m.params.slots_made == "backed" else params.thickness
    depth, radius = params.counterbore_depth, params.counterbore_radius
    below = params.counterbore_side == "underside"
    if below and (params.hub_diameter > 0 or m.params.slots_made == "backed"):
        cover = "hub plate" if params.hub_diameter > 0 else "backing plate"
        yield _error("counterbore_side", f"the {cover} covers the wheel's underside", remedy="use the top")
    if below and radius > 0:
        said = "a fillet on a floor is milled from above only"
        yield _error("counterbore_radius", said, radius, 0.0, "make it 0, or use the top")
    if depth > plate - params.least_wall:
        most = math.floor(100 * (plate - params.least_wall)) / 100
        said = f"a counterbore {depth:g} mm deep leaves {plate - depth:.3f} mm of the wheel"
        yield _error("counterbore_depth", said, depth, most, f"make it at most {most:g}")
    if radius > depth:
        said = f"a fillet of {radius:g} mm is higher than the counterbore is deep"
        yield _error("counterbore_radius", said, radius, depth, f"make it at most {depth:g}")
    least = math.ceil(20 * (m.opening + SHOULDER + radius)) / 10
    most = math.floor(20 * _greatest(m)) / 10
    if least > most:
        said = f"bore, shoulder and fillet need a counterbore of {least:g} mm; the walls leave {most:g} mm"
        yield _error("counterbore_diameter", said, least, most, "make it 0 for none, or the bore smaller")
    elif not least <= params.counterbore_diameter <= most:
        said = f"a counterbore of {params.counterbore_diameter:g} mm is outside {least:g} to {most:g} mm"
        limit = most if params.counterbore_diameter > most else least
        remedy = f"make it {least:g} to {most:g}, or 0 for none"
        yield _error("counterbore_diameter", said, params.counterbore_diameter, limit, remedy)


def _error(
    key: str, said: str, value: float | None = None, limit: float | None = None, remedy: str = ""
) -> Finding:
    unit = "" if value is None else "mm"
    return Finding.error("geneva.counterbore", key, said, value, limit, unit, remedy, Stage.PARTS)
