"""Sizes that can be bought: what a design leaves open and what a synthesis looks for comes from these lists.

Nobody grinds a roller of 9.37 mm: rollers come as needle rollers and as cam followers, and a hole for a pin
or a shaft is bored to the pin and shaft that are in the drawer.
"""

from bisect import bisect_right
from collections.abc import Sequence

ROLLERS: tuple[float, ...] = (
    *(1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0),
    *(8.0, 10.0, 12.0, 13.0, 16.0, 19.0, 22.0, 26.0, 30.0, 35.0, 40.0, 52.0, 62.0, 80.0, 90.0),
)
"""Diameters, mm: needle rollers (ISO 3096), then cam followers from the miniature ones up (ISO 7063)."""

PINS: tuple[float, ...] = (
    *(0.6, 0.8, 1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0),
    *(12.0, 16.0, 20.0, 25.0, 30.0, 40.0, 50.0),
)
"""Diameters of parallel pins (ISO 2338), mm; plain shafts of these diameters are in stock as well."""

SLACK = 1e-9
"""Share by which a bound may be off by rounding."""


def up_to(sizes: Sequence[float], most: float) -> Sequence[float]:
    """The sizes that are not above ``most``, the largest first.

    >>> list(up_to(PINS, 1.3))
    [1.2, 1.0, 0.8, 0.6]
    """
    return sizes[: bisect_right(sizes, most * (1 + SLACK))][::-1]


def largest(sizes: Sequence[float], most: float) -> float:
    """The largest size that is not above ``most``, or the smallest of all.

    >>> largest(ROLLERS, 9.9)
    8.0
    """
    return next(iter(up_to(sizes, most)), sizes[0])
