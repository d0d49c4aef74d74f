"""Linkages as plates: outlines of links, turned parts, masses, and the layers they stand in.

Glossary
--------
boss
    The round end of a link about a bore.
web
    The part of a link between two bosses.
spindle
    A pin or shaft: a cylinder through the plates that it joins, fixed in one body.
layer
    A slice of the height that plates share, counted from the ground plate, which is layer 0.
"""

from mechwright.mechanics.linkage.bushings import bushing_findings, too_thin
from mechwright.mechanics.linkage.closeness import Closeness, Plate, Spindle
from mechwright.mechanics.linkage.mass import Mass, cylinder_mass, moving_figures, plate_mass, together
from mechwright.mechanics.linkage.outlines import (
    Boss,
    bent_link,
    disc,
    hull_link,
    rectangle,
    straight_link,
    web_link,
)
from mechwright.mechanics.linkage.stacking import Layer, Stack, stack
from mechwright.mechanics.linkage.turned import BUSHING_MATERIAL, PIN_MATERIAL, bushing_part, pin_part

__all__ = [
    "BUSHING_MATERIAL",
    "PIN_MATERIAL",
    "Boss",
    "Closeness",
    "Layer",
    "Mass",
    "Plate",
    "Spindle",
    "Stack",
    "bent_link",
    "bushing_findings",
    "bushing_part",
    "cylinder_mass",
    "disc",
    "hull_link",
    "moving_figures",
    "pin_part",
    "plate_mass",
    "rectangle",
    "stack",
    "straight_link",
    "together",
    "too_thin",
    "web_link",
]
