"""The ends of the stroke that a requirement asks for, where its slider-crank has them."""

import math
from functools import partial
from typing import Any

from mechwright import Target
from mechwright_slider_crank.requirements import StrokeRequirement
from mechwright_slider_crank.synthesis.stroke import bounds, lengths_of

SHORTEST = 0.1
"""mm, the least stroke that can be asked for."""

NEARBY = 1e-4
"""Part of the stroke over which it is seen how the ends move with it."""

DECIMALS = 3
"""Of what a drag writes, mm."""


def ends_of(wanted: StrokeRequirement) -> tuple[Target, ...]:
    """Both ends of the stroke: dragged along the slide they change it, across the slide the offset if given.

    Where nothing has this stroke it begins beside the crank's pivot.

    >>> far, near = ends_of(StrokeRequirement(stroke=120, time_ratio=1.5))
    >>> [round(one.place[0], 3) for one in (far, near)], near.moved((1.5 * near.place[0], 0.0))
    ([150.094, 30.094], {'stroke': 180.0})
    """
    way = complex(
        math.cos(math.radians(wanted.slide_direction)), math.sin(math.radians(wanted.slide_direction))
    )
    near, far, offset = _along(wanted, wanted.stroke)
    step = NEARBY * wanted.stroke
    there = _along(wanted, wanted.stroke + step)
    found = []
    for name, along, after in (("far", far, there[1]), ("near", near, there[0])):
        place = (along + 1j * offset) * way
        if after != along:
            moved = partial(_moved, wanted, way, along, step / (after - along))
            found.append(Target(f"{name} end of the stroke", (place.real, place.imag), moved, "stroke"))
    return tuple(found)


def _along(wanted: StrokeRequirement, stroke: float) -> tuple[float, float, float]:
    """Where the slider's pin turns back, along the slide, and the offset, mm."""
    asked = wanted.model_copy(update={"stroke": stroke})
    if any(bounds(asked)):
        return 0.0, stroke, abs(wanted.offset or 0.0)
    known = lengths_of(asked)
    near = math.sqrt(max(0.0, (known.rod - known.crank) ** 2 - known.offset**2))
    return near, near + stroke, known.offset


def _moved(
    wanted: StrokeRequirement, way: complex, along: float, slope: float, place: tuple[float, ...]
) -> dict[str, Any]:
    """A step of Newton's method towards the stroke that has its end there, to no more than twice as long."""
    there = complex(*place) / way
    stroke = wanted.stroke + slope * (there.real - along)
    stroke = max(SHORTEST, wanted.stroke / 2, min(2 * wanted.stroke, stroke))
    across = {} if wanted.offset is None else {"offset": round(max(there.imag, SHORTEST), DECIMALS)}
    return {"stroke": round(stroke, DECIMALS), **across}
