"""Round numbers along the axis of a plot."""

import math


def ticks(low: float, high: float, most: int = 6, *, inside: bool = False) -> list[float]:
    """Round numbers from low to high, beyond both unless ``inside``.

    >>> ticks(0.3, 7.2), ticks(0, 360, 7, inside=True)
    ([0.0, 2.0, 4.0, 6.0, 8.0], [0.0, 60.0, 120.0, 180.0, 240.0, 300.0, 360.0])
    """
    span = high - low
    if not span > 0:
        return [low - 1.0, low, low + 1.0]
    raw = span / most
    power = 10.0 ** math.floor(math.log10(raw))
    steps = (1, 2, 5, 10) if not inside else (1, 1.5, 2, 3, 4.5, 6, 9, 10)
    step = power * next(one for one in steps if one * power >= raw * (1 - 1e-9))
    first, last = low / step, high / step
    slack = 1e-9 * max(abs(first), abs(last), 1.0)
    start = math.ceil(first - slack) if inside else math.floor(first + slack)
    end = math.floor(last + slack) if inside else math.ceil(last - slack)
    return [round(number * step, 12) for number in range(start, end + 1)]
