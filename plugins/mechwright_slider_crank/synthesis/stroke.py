"""Slider-cranks of a given stroke H and time ratio K, in closed form (seed document 001).

With θ = π (K - 1)/(K + 1) the crank turns by π + θ and π - θ between the limits, and the triangle of A0 and
the two limits gives

* (H/2)² = a² cos²(θ/2) + c² sin²(θ/2), e H = (c² - a²) sin θ;
* given e: a² = (H/2)² - (e H/2) tan(θ/2), c² = (H/2)² + (e H/2) cot(θ/2);
* given a: c = √((H/2)² - a² cos²(θ/2)) / sin(θ/2); given c: a = √((H/2)² - c² sin²(θ/2)) / cos(θ/2).

The crank turns fully for 0 < e <= H cot θ, (H/2) tan(θ/2) <= a < H/2, H/2 < c <= (H/2) cot(θ/2). With none
given e is where the least transmission angle, acos((a + e)/c), is the greatest.

K = 1 is the central slider-crank: e = 0, a = H/2 and any longer rod, of which none is the best.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from scipy.optimize import brentq

from mechwright import Finding
from mechwright_slider_crank.requirements import StrokeRequirement

RATIOS = (1.0, 3.0)
"""K between which an offset slider-crank exists: 1 has no offset, and at 3 the crank no longer turns."""

CENTRAL_ROD = 4.0
"""Rod of a central slider-crank over its crank, where none is given: as usual in engines, with a transmission
angle above 75 degrees."""

_NEARLY = 0.99
"""Part of the range of offsets that is searched for the best: the last hundredth is never it."""


@dataclass(frozen=True, slots=True)
class Lengths:
    """Crank a, rod c and offset e, mm."""

    crank: float
    rod: float
    offset: float


@dataclass(frozen=True, slots=True)
class Ranges:
    """Open or half-open ranges, mm, in which a length leads to a crank that turns."""

    crank: tuple[float, float]
    rod: tuple[float, float]
    offset: tuple[float, float]


def rocking_angle(time_ratio: float) -> float:
    """θ, rad."""
    return math.pi * (time_ratio - 1) / (time_ratio + 1)


def ranges(stroke: float, time_ratio: float) -> Ranges:
    """Where the three lengths may lie.

    >>> found = ranges(120, 1.5)
    >>> round(found.crank[0], 6), round(found.rod[1], 6), round(found.offset[1], 6)
    (19.495182, 184.661012, 165.16583)
    """
    half, theta = stroke / 2, rocking_angle(time_ratio)
    return Ranges(
        (half * math.tan(theta / 2), half),
        (half, half / math.tan(theta / 2)),
        (0.0, stroke / math.tan(theta)),
    )


def from_offset(stroke: float, time_ratio: float, offset: float) -> Lengths:
    """The slider-crank of an offset e.

    >>> found = from_offset(120, 1.5, 50)
    >>> round(found.crank, 6), round(found.rod, 6)
    (51.237105, 113.283055)
    """
    half, t = stroke / 2, math.tan(rocking_angle(time_ratio) / 2)
    return Lengths(math.sqrt(half**2 - offset * half * t), math.sqrt(half**2 + offset * half / t), offset)


def from_crank(stroke: float, time_ratio: float, crank: float) -> Lengths:
    """The slider-crank of a crank a."""
    theta = rocking_angle(time_ratio)
    rod = math.sqrt((stroke / 2) ** 2 - (crank * math.cos(theta / 2)) ** 2) / math.sin(theta / 2)
    return Lengths(crank, rod, _offset(stroke, theta, crank, rod))


def from_rod(stroke: float, time_ratio: float, rod: float) -> Lengths:
    """The slider-crank of a rod c."""
    theta = rocking_angle(time_ratio)
    crank = math.sqrt((stroke / 2) ** 2 - (rod * math.sin(theta / 2)) ** 2) / math.cos(theta / 2)
    return Lengths(crank, rod, _offset(stroke, theta, crank, rod))


def _offset(stroke: float, theta: float, crank: float, rod: float) -> float:
    return (rod**2 - crank**2) * math.sin(theta) / stroke


def best(stroke: float, time_ratio: float) -> Lengths:
    """The slider-crank whose least transmission angle is the greatest.

    It is where d/de of (a + e)/c is zero: (1 - H t/(4 a)) c² = (a + e) H/(4 t), t = tan(θ/2).

    >>> round(best(120, 1.5).offset, 6)
    34.593562
    """
    quarter, t = stroke / 4, math.tan(rocking_angle(time_ratio) / 2)

    def slope(offset: float) -> float:
        found = from_offset(stroke, time_ratio, offset)
        a, c = found.crank, found.rod
        return (1 - quarter * t / a) * c**2 - (a + offset) * quarter / t

    # The angle is 0 at both ends of the range; at the largest offset it has its least with a slope of 0.
    most = _NEARLY * ranges(stroke, time_ratio).offset[1]
    return from_offset(stroke, time_ratio, float(brentq(slope, 0.0, most, xtol=1e-15 * stroke)))


def bounds(wanted: StrokeRequirement) -> Iterator[Finding]:
    """What cannot be met, with the nearest value that can."""
    low, high = RATIOS
    if wanted.time_ratio < low or wanted.time_ratio >= high:
        slow = wanted.time_ratio < low
        yield Finding.error(
            "slider-crank.time-ratio",
            "time_ratio",
            f"no crank that turns fully has a time ratio of {wanted.time_ratio:g}: that of the slow stroke "
            "over the quick one is at least 1, and below 3",
            wanted.time_ratio,
            low if slow else high,
            remedy=f"ask for time_ratio = {1 / wanted.time_ratio:.6g}; quick says which stroke is the quick "
            "one"
            if slow and 1 / wanted.time_ratio < high
            else "ask for a time ratio just below 3",
        )
        return
    if wanted.time_ratio == low:
        yield from _central(wanted)
        return
    allowed = ranges(wanted.stroke, wanted.time_ratio)
    for name, (least, most) in (("crank", allowed.crank), ("rod", allowed.rod), ("offset", allowed.offset)):
        value = getattr(wanted, name)
        # The end at which the crank just turns is refused with its neighbourhood by the family's own check.
        if value is None or least < value < most:
            continue
        nearest = least if value <= least else most
        yield Finding.error(
            f"slider-crank.{name}-range",
            name,
            f"{name} = {value:g} mm does not lead to a stroke of {wanted.stroke:g} mm at a time ratio of "
            f"{wanted.time_ratio:g}: it must lie between {least:.6g} and {most:.6g} mm",
            value,
            nearest,
            "mm",
            f"take {name} near {nearest:.6g} mm, inside the range",
        )


def _central(wanted: StrokeRequirement) -> Iterator[Finding]:
    """What of the lengths does not go with a time ratio of 1."""
    half = wanted.stroke / 2
    if wanted.offset is not None:
        said, limit, cure = "has no offset", 0.0, "leave offset out, or ask for a time ratio above 1"
        name, value = "offset", wanted.offset
    elif wanted.crank is not None and not math.isclose(wanted.crank, half, rel_tol=1e-9):
        said, limit, cure = f"has a crank of half the stroke, {half:.6g} mm", half, "leave crank out"
        name, value = "crank", wanted.crank
    elif wanted.rod is not None and wanted.rod <= half:
        said, limit, cure = (
            f"needs a rod longer than {half:.6g} mm",
            half,
            "take a longer rod, or leave it out",
        )
        name, value = "rod", wanted.rod
    else:
        return
    yield Finding.error(
        f"slider-crank.{name}-range",
        name,
        f"{name} = {value:g} mm: a slider-crank with a time ratio of 1 {said}",
        value,
        limit,
        "mm",
        cure,
    )


def lengths_of(wanted: StrokeRequirement) -> Lengths:
    """The lengths that a requirement within its bounds leads to, offset positive."""
    stroke, ratio = wanted.stroke, wanted.time_ratio
    if ratio == RATIOS[0]:
        return Lengths(stroke / 2, CENTRAL_ROD * stroke / 2 if wanted.rod is None else wanted.rod, 0.0)
    if wanted.offset is not None:
        return from_offset(stroke, ratio, wanted.offset)
    if wanted.crank is not None:
        return from_crank(stroke, ratio, wanted.crank)
    if wanted.rod is not None:
        return from_rod(stroke, ratio, wanted.rod)
    return best(stroke, ratio)
