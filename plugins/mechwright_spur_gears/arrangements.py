"""Arrangements of spur gears, and the keys that each of them uses."""

from collections.abc import Mapping
from typing import Literal

Arrangement = Literal["external", "internal", "planetary", "rack"]
"""Of the gears."""

ARRANGED: Mapping[str, tuple[Arrangement, ...]] = {
    "mate_teeth": ("external", "internal", "planetary"),
    "mate_shift": ("external", "internal", "planetary"),
    "load_torque": ("external", "internal", "planetary"),
    "shift_rule": ("external", "planetary"),
    "ring_addendum": ("internal", "planetary"),
    "ring_outside": ("internal", "planetary"),
    "ring_holes": ("internal", "planetary"),
    "ring_hole": ("internal", "planetary"),
    "ring_teeth": ("planetary",),
    "planets": ("planetary",),
    "planet_spacing": ("planetary",),
    "fixed_member": ("planetary",),
    "driving_member": ("planetary",),
    "pin_diameter": ("planetary",),
    "carrier_thickness": ("planetary",),
    "rack_teeth": ("rack",),
    "travel": ("rack",),
    "rack_addendum": ("rack",),
    "rack_height": ("rack",),
    "rack_holes": ("rack",),
    "rack_hole": ("rack",),
    "load_force": ("rack",),
}
"""Keys to the arrangements that use them; all arrangements use the others."""
