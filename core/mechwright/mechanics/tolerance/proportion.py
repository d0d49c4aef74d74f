"""A share that was counted, with its confidence interval."""

import math
from dataclasses import dataclass

Z95 = 1.959963984540054
"""Of the normal distribution, for 95 % on both sides together."""


@dataclass(frozen=True, slots=True)
class Share:
    """``count`` of ``total``, and between what limits the true share lies with a confidence of 95 %."""

    count: int
    total: int
    value: float
    lower: float
    upper: float


def share_of(count: int, total: int) -> Share:
    """Wilson's interval; where none or all are counted, the rule of three: -ln 0.05 is 3.

    >>> round(share_of(868961, 1000000).lower, 5), share_of(1000, 1000).lower, share_of(1, 1).lower
    (0.8683, 0.997, 0.0)
    """
    y, z = count / total, Z95
    if count == total:
        return Share(count, total, 1.0, max(1 - 3 / total, 0.0), 1.0)
    if count == 0:
        return Share(count, total, 0.0, 0.0, min(3 / total, 1.0))
    middle = y + z * z / (2 * total)
    half = z * math.sqrt(y * (1 - y) / total + z * z / (4 * total * total))
    scale = 1 + z * z / total
    return Share(count, total, y, (middle - half) / scale, (middle + half) / scale)
