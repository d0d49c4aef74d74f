"""The pieces of the coupon as plates: an L with holes and slots, pins and walls, trials, a gauge pin.

Along X of the bed lie the round holes of the L, along Y its slots.
"""

from mechwright.contracts.part import Bore, Feature, Part, Pocket, Profile
from mechwright.geometry import Loop, Outline, circle
from mechwright.geometry.segments import Point
from mechwright_print.coupon.features import (
    BASE,
    GAPS,
    GAUGE_PIN,
    LONG,
    ROUND,
    SHORT,
    SLOTS,
    TALL,
    THICK,
    WALLS,
    trial_name,
)

HOLES_AT = (26.0, 33.5, 41.5, 50.5, 61.0, 74.0, 90.5)
"""X of the holes on the arm along X, mm: as many as there are diameters."""
PINS_AT = (8.0, 19.0, 31.0, 44.0, 59.0, 76.0, 97.0)
"""X of the pins on their base, mm: jaws of a calliper go between them."""
PITCH = 12.5
"""Distance of the trials, mm."""
MATERIAL = "pom"
"""Of the parts as the model has it; nobody weighs them by it."""
_SLOTS_X: dict[float, tuple[float, float]] = {2.0: (5.0, 32.0), 4.0: (13.0, 32.0), 8.0: (10.0, 49.0)}
"""Middles of the slots whose width lies along X, mm."""
_SLOTS_Y: dict[float, tuple[float, float]] = {2.0: (10.0, 61.0), 4.0: (10.0, 69.0), 8.0: (10.0, 80.0)}
_SLOT_LENGTH = 11.0


def _rectangle(middle: Point, width: float, height: float) -> Loop:
    (x, y), a, b = middle, width / 2, height / 2
    return Loop.polygon([(x - a, y - b), (x + a, y - b), (x + a, y + b), (x - a, y + b)])


def _plate(name: str, outline: Loop, features: list[Feature], thickness: float) -> Part:
    """A plate whose through features are also the openings of its outline."""
    inner = []
    for feature in features:
        if isinstance(feature, Bore):
            inner.append(Loop((circle(feature.centre, feature.diameter / 2, clockwise=True),)))
        elif isinstance(feature, Profile):
            inner.append(feature.loop.reversed())
    rim = Profile("outside", outline, "outside", 0.0, thickness)
    return Part(name, Outline(outline, tuple(inner)), thickness, MATERIAL, machined=(*features, rim))


def plate() -> Part:
    """The L: lengths, first layer, holes and slots."""
    rim = Loop.polygon([(0, 0), (LONG, 0), (LONG, SHORT), (SHORT, SHORT), (SHORT, LONG), (0, LONG)])
    features: list[Feature] = [
        Bore(f"hole-{size:g}", (x, SHORT / 2), size, 0.0, THICK)
        for size, x in zip(ROUND, HOLES_AT, strict=True)
    ]
    for width in SLOTS:
        along_x = _rectangle(_SLOTS_X[width], width, _SLOT_LENGTH)
        along_y = _rectangle(_SLOTS_Y[width], _SLOT_LENGTH, width)
        features.append(Profile(f"slot-x-{width:g}", along_x, "inside", 0.0, THICK))
        features.append(Profile(f"slot-y-{width:g}", along_y, "inside", 0.0, THICK))
    return _plate("coupon-plate", rim, features, THICK)


def pins() -> Part:
    """Pins and walls on a base."""
    length, width = PINS_AT[-1] + 13.0, 43.0
    islands = [Loop((circle((x, 14.0), size / 2),)) for size, x in zip(ROUND, PINS_AT, strict=True)]
    for number, thick in enumerate(WALLS):
        islands.append(_rectangle((10.0 + 16.0 * number, 33.0), thick, 10.0))
        islands.append(_rectangle((60.0 + 18.0 * number, 33.0), 10.0, thick))
    around = _rectangle((length / 2, width / 2), length + 20, width + 20)
    features: list[Feature] = [Pocket("around", around, tuple(islands), 0.0, TALL)]
    return _plate("coupon-pins", _rectangle((length / 2, width / 2), length, width), features, TALL + BASE)


def trials() -> Part:
    """The plate of trials; the tight end has a broken corner."""
    length, width = PITCH * len(GAPS) + 2.0, 18.0
    rim = Loop.polygon([(4.0, 0), (length, 0), (length, width), (0, width), (0, 4.0)])
    features: list[Feature] = [
        Bore(trial_name(gap), (PITCH * (number + 0.5) + 1.0, width / 2), GAUGE_PIN + 2 * gap, 0.0, THICK)
        for number, gap in enumerate(GAPS)
    ]
    return _plate("coupon-trials", rim, features, THICK)


def gauge_pin() -> Part:
    """The pin for the trials, on a knob."""
    knob = Loop((circle((0.0, 0.0), 8.0),))
    around = _rectangle((0.0, 0.0), 30.0, 30.0)
    island = Loop((circle((0.0, 0.0), GAUGE_PIN / 2),))
    return _plate("coupon-gauge-pin", knob, [Pocket("around", around, (island,), 0.0, 16.0)], 16.0 + THICK)


def pieces() -> list[Part]:
    """All pieces."""
    return [plate(), pins(), trials(), gauge_pin()]
