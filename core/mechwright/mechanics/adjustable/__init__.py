"""Adjustable linkages: four-bars and geared five-bars that follow a path in each of several phases."""

from mechwright.mechanics.adjustable.counts import Moves, exact_number
from mechwright.mechanics.adjustable.fit import Fit, fit
from mechwright.mechanics.adjustable.mechanism import Pins, Unknowns, follow
from mechwright.mechanics.adjustable.search import Path, search
from mechwright.mechanics.adjustable.settings import Settings, settings_of
from mechwright.mechanics.adjustable.space import PlaneSpace, Points, Space
from mechwright.mechanics.adjustable.task import Limits, Task

__all__ = [
    "Fit",
    "Limits",
    "Moves",
    "Path",
    "Pins",
    "PlaneSpace",
    "Points",
    "Settings",
    "Space",
    "Task",
    "Unknowns",
    "exact_number",
    "fit",
    "follow",
    "search",
    "settings_of",
]
