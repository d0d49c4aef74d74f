"""Sintered bronze bushes (ISO 2795) of a train: in the base plate and in gears, wherever something turns."""

from mechwright import DesignError, Instance, Part
from mechwright.contracts.fits import Fit, hole_fit
from mechwright.standards.bushes import Bush, bush_for
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.layout import Layout

_BRONZE = (0.72, 0.56, 0.34)


def idling(params: EllipticGearParams) -> tuple[str, ...]:
    """Gears that turn on their shafts, and not on a register."""
    if params.phase_joint == "pins":
        return ("gear-3", "gear-4", "gear-5")
    return ("gear-3", "gear-5") if params.phase_joint == "clamp" else ("gear-5",)


def turning_axes(params: EllipticGearParams) -> tuple[str, ...]:
    """Bodies of the base plate in whose axes a shaft turns."""
    return ("axis-2", "base") if params.keyed_phase else ("axis-2",)


def bush_of(params: EllipticGearParams, length: float) -> Bush | None:
    """The longest for a plate of a thickness, mm; None where none is asked for, or none is sold."""
    if not params.bushes:
        return None
    try:
        return bush_for(params.bore, length)
    except DesignError:
        return None


def bush_seat(params: EllipticGearParams, length: float) -> Fit | None:
    """Limits of the hole that a bush is pressed into."""
    bush = bush_of(params, length)
    return None if bush is None else hole_fit(bush.outside, "H7")


def bush_parts(params: EllipticGearParams, layout: Layout) -> tuple[Part, ...]:
    """All bushes: flush with the upper face of the base plate, and with the lower ones of gears."""
    heights = {"gear-3": layout.lower, "gear-4": layout.upper, "gear-5": layout.upper}
    places = {layout.thickness: [(body, heights[body]) for body in idling(params)]}
    base = bush_of(params, layout.base)
    if base is not None:
        places.setdefault(layout.base, []).extend((body, -base.length) for body in turning_axes(params))
    by_length: dict[float, list[Instance]] = {}
    shorter: dict[float, float] = {}
    for thickness, where in places.items():
        bush = bush_of(params, thickness)
        if bush is not None:
            by_length.setdefault(bush.length, []).extend(Instance(body, z) for body, z in where)
            shorter[bush.length] = max(shorter.get(bush.length, 0.0), thickness - bush.length)
    return tuple(
        Part(
            f"bush-{params.bore:g}x{length:g}".replace(".", "_"),
            None,
            0.0,
            "brass",
            tuple(at),
            _BRONZE,
            bought=bush_for(params.bore, length).bought,
            play=shorter[length],
        )
        for length, at in by_length.items()
    )
