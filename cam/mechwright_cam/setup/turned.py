"""A plate that has been turned over: the part hangs in its middle by tabs, and the frame around it is scrap.

Its ``outline`` is that of the whole plate, for stock, travel and what must stay.
"""

from dataclasses import dataclass, field

import shapely

from mechwright.contracts.part import Part


@dataclass(frozen=True)
class Frame:
    """What tells the part from its frame, plan views, mm."""

    body: shapely.Geometry = field(default_factory=shapely.Polygon)
    """The part without its openings: what is cut lies in it."""
    part: shapely.Geometry = field(default_factory=shapely.Polygon)
    """The part with the openings that both setups leave, of features of constant section."""
    holds: shapely.Geometry = field(default_factory=shapely.Polygon)
    """Tabs, and the stock around dowels: they stay, whatever is drawn. Nothing of them lies in the body."""


@dataclass(frozen=True)
class TurnedOver(Part):
    """The plate of a second setup, with what lies in it; shapes in the part's coordinates."""

    frame: Frame = field(default_factory=Frame)
