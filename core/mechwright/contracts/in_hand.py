"""What a shop has in hand for a new design."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class InHand:
    """What a lender says of plates in hand.

    Parameters
    ----------
    material, thickness
        Of the sheet, mm; empty and None where there is none, or several.
    sheet
        Length and width of a ready blank, mm; None where pieces are sawn off.
    gap
        Stock to keep around each part, mm.
    change
        Keys that put all parts on that sheet.
    """

    material: str = ""
    thickness: float | None = None
    sheet: tuple[float, float] | None = None
    gap: float = 0.0
    change: Mapping[str, Any] = field(default_factory=dict)
