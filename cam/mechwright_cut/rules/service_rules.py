"""What a service refuses of a part besides circles: small openings, thin webs, parts that are too small."""

import math
from collections.abc import Iterator
from itertools import combinations

import shapely

from mechwright.contracts.finding import Finding, Stage
from mechwright.tolerances import TOLERANCES, falls_short
from mechwright_cut.jobs import CutPart
from mechwright_cut.settings.services import ServiceRules, services

ROUND = 1.02
"""Square of the circumference over that of the circle of like area, below which an opening is round."""


def service_findings(cut: CutPart, rules: ServiceRules, jet: bool) -> Iterator[Finding]:
    """An error for a part that a service does not take, with another one that does."""
    said = refusal_of(cut, rules, jet)
    if said is None:
        return
    # That it takes the part as it is cut now: what its own least hole changes is told once it is chosen.
    other = next((one.name for one in services().values() if refusal_of(cut, one, jet) is None), "")
    yield Finding.error(
        "cut.service",
        "cut.service",
        f"{cut.part.name}: {said}",
        remedy=f'set cut.service = "{other}"' if other else "no service takes it; change the part",
        stage=Stage.MACHINING,
        proposed=({"cut.service": other},) if other else (),
    )


def refusal_of(cut: CutPart, rules: ServiceRules, jet: bool) -> str | None:
    """Why a service does not take a part, in a clause; None where it does."""
    x0, y0, x1, y1 = cut.outline.bounds
    if (size := max(x1 - x0, y1 - y0)) < rules.part - TOLERANCES.outline:
        return f"{rules.words} takes parts of {rules.part:g} mm and more, and it has {size:.2f}"
    if said := _small_opening(cut, rules, jet):
        return said
    least = rules.least_web(cut.part.thickness)
    rings = [shapely.LinearRing(loop.flatten()) for loop in cut.outline.loops]
    webs = [(float(shapely.distance(one, two)), one, two) for one, two in combinations(rings, 2)]
    off, one, two = min(webs, key=lambda web: web[0], default=(least, None, None))
    if off < least - TOLERANCES.outline:
        x, y = shapely.get_coordinates(shapely.shortest_line(one, two))[0]
        said = f"{off:.2f} mm stay between two cuts at ({x:.2f}, {y:.2f})"
        return f"{said}, and {rules.words} asks for {least:g}"
    return None


def _small_opening(cut: CutPart, rules: ServiceRules, jet: bool) -> str | None:
    """An opening that is too small, and round to a service though it is no circle: a short slot."""
    least = rules.least_hole(cut.part.thickness, jet)
    for loop in cut.outline.inner:
        shape = shapely.Polygon(loop.flatten())
        size = 2 * math.sqrt(shape.area / math.pi)
        around = shape.length**2 / (4 * math.pi * shape.area)
        if not loop.is_circle and around < ROUND and falls_short(size, least):
            x, y = shape.centroid.coords[0]
            said = f"the opening at ({x:.2f}, {y:.2f}) is a hole of {size:.2f} mm to {rules.words}"
            return f"{said}, below its least, {least:g}"
    return None
