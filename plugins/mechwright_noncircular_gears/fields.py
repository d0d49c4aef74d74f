"""Which fields make which law, what they are where they are left out, and what bounds them."""

from typing import Any

from mechwright.mechanics.gearing.rim_rules import HOLE
from mechwright.mechanics.gearing.ring_plate import HOLES

LEAST_MODULE = 0.1
"""mm. Finer teeth are below what the smallest end mills can cut, and near the outline's own tolerance."""

LEAST_TEETH, MOST_TEETH = 6, 600
"""Fewer have no room for a root and a shaft, more say nothing new."""

MOST_LOBES = 8
"""Of either gear: more are a toothed circle for all that a shaft can tell."""

MOST_HARMONICS = 16
"""Of a law: with more, the pitch curve is a gear by itself."""

MOST_HALF_TURN = 178.0
"""Degrees from the middle of an index to the end of its blend: some are left for the constant ratio."""

LAW_FIELDS = {
    "fourier": ("sines", "cosines"),
    "window": ("window_ratio", "window", "blend"),
    "table": ("nodes",),
    "ratio": ("ratio",),
    "angle": ("angle",),
    "spiral": ("first_ratio", "last_ratio"),
    "slider": ("rod_ratio", "stroke_start", "stroke_end", "window"),
    "geneva": ("slots", "ramp", "window", "blend"),
    "ellipse": ("eccentricity",),
    "limacon": ("eccentricity",),
    "eccentric-circle": ("eccentricity",),
}
"""Law to the fields that make it; no other law has a use for them."""

USUAL_SINE, MOST_SWING = 15.0, 30.0
"""Degrees: the amplitude of a law that names none, and what it is at most times the driven gear's lobes: the
share of its mean by which the ratio swings."""

USUAL: dict[str, Any] = {
    "cosines": (),
    "window_ratio": 0.85,
    "window": 100.0,
    "blend": 90.0,
    "rod_ratio": 4.0,
    "stroke_start": 50.0,
    "stroke_end": 130.0,
    "slots": 4,
    "ramp": 0.145,
    "eccentricity": 0.2,
    "first_ratio": 0.7,
    "last_ratio": 1.4,
    "ring_addendum": 0.6,
    "ring_holes": HOLES,
    "ring_hole": HOLE,
}
"""Field of a law or of a ring to its value where it is left out."""

USUAL_OF = {("slider", "window"): 150.0, ("geneva", "window"): 180.0, ("geneva", "blend"): 60.0}
"""Law and field to a value of its own, degrees of the driver, where the design names none."""

SECTOR_LAWS = ("ratio", "angle", "table", "spiral")
"""Laws that need not close, and can be those of sectors."""

MOST_SECTOR = 330.0
"""Degrees of travel of either sector: some of the turn is left for its last teeth and its blank."""

RING_FIELDS = ("ring_addendum", "ring_outside", "ring_holes", "ring_hole")
"""Fields of a driven gear that is a ring."""

ALSO = {
    "number_of_teeth": "it is called teeth, of the driver",
    "z": "it is called teeth, of the driver",
    "z1": "it is called teeth",
    "z2": "it follows from teeth and the lobes of both gears",
    "e": "it is called eccentricity",
    "a": "it is called centre_distance",
    "distance": "it is called centre_distance",
    "mean_ratio": "it is lobes over mate_lobes",
    "transmission_ratio": "its mean is lobes over mate_lobes; ratio is a formula of what it is at phi",
    "formula": 'ratio and angle are formulas of phi, with law = "ratio" or "angle"',
    "backlash_per_flank": "backlash is that of all four flanks together",
    "travel": "sector is the travel of gears that swing",
}
"""What people look for under another name, and what to say of it."""
