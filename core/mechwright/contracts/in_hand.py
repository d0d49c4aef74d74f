"""What a shop has in hand for a new design."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class InHand:
    """What a lender says of plates in hand.

    Parameters
    ----------
    material, thickness
        Of the sheet, mm; empty and None where there is none, or several.
    fits
        Whether plates of these lengths and widths, mm, go on that sheet together; None where there is none.
    change
        Keys that put all parts on that sheet.
    """

    material: str = ""
    thickness: float | None = None
    fits: Callable[[Sequence[tuple[float, float]]], bool] | None = None
    change: Mapping[str, Any] = field(default_factory=dict)
