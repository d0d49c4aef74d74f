"""Which values of a key are worth trying, how far apart two of them are, and which is a round number."""

import math
from collections.abc import Callable, Iterator
from itertools import zip_longest
from typing import Any

from mechwright.remedies.keys import Key

_FACTORS = (1.03, 1.1, 1.25, 1.6, 2.5, 5.0, 12.0, 40.0, 150.0, 600.0, 1e4)
_DEGREES = (1.0, 3.0, 8.0, 20.0, 45.0, 90.0, 180.0, 360.0)
_SIZES = (0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0, 30.0, 50.0, 100.0)
"""Lengths in place of none, mm."""
_COUNTS = (1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144, 233)
_DIGITS = 4
"""Significant digits of a value that is tried."""
_ROUNDING = 0.02
"""Share by which a value goes further than it has to, to be a round number."""
_HALVINGS = 5
"""Times that the gap between a value that fails and one that passes is halved."""
_OTHER = 0.7
"""Distance of another choice, and of none from a value: as a number that doubles."""
_NEW = 1.4
"""Distance of a value from none, as a number that is four times as large: what is left out follows from other
sizes, and is in proportion to them."""


def round_to(value: float, digits: int = _DIGITS) -> float:
    """A number with so many significant digits."""
    return float(f"{value:.{digits}g}")


def ladder(key: Key, now: Any) -> list[Any]:
    """Other values of a key, the nearest first, up and down in turns; then its default.

    There are none of a list that people set first: to leave out what was asked for is no remedy.

    >>> ladder(Key("parameters.teeth", "integer", 6, 40, default=25), 9)
    [10, 8, 11, 7, 12, 6, 14, 17, 22, 30, 40, 25]
    """
    if key.kind == "other":
        return [] if key.first or isinstance(key.default, list | dict) else [key.default]
    if not key.numeric:
        values: list[Any] = [choice for choice in key.choices if choice is not None]
    elif now is None:
        values = list(_across(key))
    else:
        up, down = (list(_steps(key, float(now), sign)) for sign in (1, -1))
        values = [value for pair in zip_longest(up, down) for value in pair if value is not None]
    values = [
        typed(key, value) if key.numeric and value is not None else value for value in (*values, key.default)
    ]
    return [value for value in dict.fromkeys(values) if value != now]


def typed(key: Key, number: float) -> float:
    """A number as a person writes it for a key: without a point where it is whole.

    >>> typed(Key("parameters.ground", "number"), 11.0), typed(Key("parameters.teeth", "integer"), 25.4)
    (11, 25)
    """
    return round(number) if key.kind == "integer" or float(number).is_integer() else number


def _across(key: Key) -> Iterator[float]:
    """Values over all of the bounds, of a key that the file leaves out."""
    if not (math.isfinite(key.low) and math.isfinite(key.high)):
        return
    low, high = key.low, key.high
    for share in (0.5, 0.25, 0.75, 0.1, 0.9, 0.0, 1.0):
        if low >= 0:
            least = max(low, high * 1e-4)
            yield round_to(least * (high / least) ** share, 2)
        else:
            yield round_to(low + share * (high - low), 2)


def _steps(key: Key, now: float, sign: int) -> Iterator[float]:
    """Values above (1) or below (-1) the present one, further and further, up to the bound."""
    bound = key.high if sign > 0 else key.low
    passed = False
    for value in _raw(key, now, sign):
        if (value - bound) * sign >= 0:
            passed = True
            break
        yield round_to(value)
    if (passed or key.low == bound == 0) and math.isfinite(bound) and bound != now:
        yield bound


def _raw(key: Key, now: float, sign: int) -> Iterator[float]:
    if key.kind == "integer":
        yield from (now + sign * count for count in _COUNTS)
    elif key.unit == "deg":
        yield from (now + sign * step for step in _DEGREES)
    elif key.low >= 0 and now > 0:
        yield from (now * factor**sign for factor in _FACTORS)
    elif key.low == now == 0 and key.unit == "mm":
        yield from _SIZES
    elif now == 0:
        span = key.high - key.low
        scale = span * 1e-3 if math.isfinite(span) else 1.0
        yield from (sign * scale * (factor - 1) for factor in _FACTORS)
    elif now * sign > 0:
        yield from (now * factor for factor in _FACTORS)
    else:  # towards zero, and on to the other side
        yield from (now / factor for factor in _FACTORS)
        yield 0.0
        yield -now


def distance(key: Key, old: Any, new: Any) -> float:
    """How far a value is from another, as the logarithm of a ratio; 0 for the same."""
    if old == new:
        return 0.0
    if not key.numeric or old is None or new is None:
        return _NEW if key.numeric and old is None else _OTHER
    if old > 0 and new > 0:
        return abs(math.log(new / old))
    if key.unit == "deg":
        return float(abs(new - old)) / 45.0
    if old * new > 0:
        return abs(math.log(new / old))
    return _OTHER + abs(math.log(max(abs(new), 1e-6) / max(abs(old), 1e-6))) / 10


def closest(key: Key, now: float, good: float, passes: Callable[[float], bool]) -> float:
    """The value nearest to ``now`` that still passes, as round as there is one; ``good`` is known to.

    >>> closest(Key("parameters.ground", "number", 1, 5000), 9.0, 16.0, lambda ground: ground >= 10.93)
    11.0
    """
    bad, last = float(now), float(good)
    for _ in range(_HALVINGS):
        if abs(good - bad) <= max(0.01 * max(abs(good), abs(bad)), key.kind == "integer"):
            break
        between = (bad + good) / 2
        if bad * good > 0 and (key.low >= 0 or key.unit != "deg"):
            between = math.copysign(math.sqrt(bad * good), good)
        middle = float(round(between)) if key.kind == "integer" else round_to(between)
        if middle in {good, bad}:
            break
        if passes(middle):
            good = middle
        else:
            bad = middle
    if key.kind == "integer":
        return good
    for digits in range(1, _DIGITS):
        for candidate in (_between(bad, good, digits), _beyond(bad, good, digits)):
            if candidate is None or not key.low <= candidate <= key.high:
                continue
            if candidate in {good, last} or passes(candidate):
                return candidate
    return good


def _between(bad: float, good: float, digits: int) -> float | None:
    """The number of so many digits between both, ``good`` allowed, nearest to ``bad``; None without."""
    size = max(abs(bad), abs(good))
    if size == 0:
        return 0.0
    step = 10.0 ** (math.floor(math.log10(size)) - digits + 1)
    count = math.floor(bad / step) + 1 if good > bad else math.ceil(bad / step) - 1
    value = float(f"{count * step:.{digits + 2}g}")
    return value if (value - good) * (good - bad) <= 0 else None


def _beyond(bad: float, good: float, digits: int) -> float | None:
    """The next number of so many digits past ``good``, away from ``bad``; None where it is not near."""
    size = abs(good)
    if size == 0:
        return 0.0
    step = 10.0 ** (math.floor(math.log10(size)) - digits + 1)
    count = math.ceil(good / step) if good > bad else math.floor(good / step)
    value = float(f"{count * step:.{digits + 2}g}")
    return value if abs(value - good) <= _ROUNDING * size else None
