"""Changes of the length that a finding has measured, where it knows no key for it.

Who judges a part knows how thick it is and not which key makes it so. A key that is about as large as what
was found is likely to be the one: it is changed by as much as there is too much, or too little. Where what is
too large is as large as the mechanism, it is made smaller as a whole: its lengths keep their ratios.
"""

import math
from collections.abc import Iterator, Mapping

from mechwright.contracts.finding import Change, Finding
from mechwright.remedies.bench import Bench
from mechwright.remedies.keys import Key
from mechwright.remedies.values import round_to, typed

_ALIKE = 0.1
"""Share by which a key may differ from what was measured: a cutter goes deeper than its part is thick."""

_DIGITS = 3
"""Of a value that is named."""

_OF_IT = 0.3
"""Share of what was measured from which the largest length says that it is the mechanism's size."""

_FAR = 0.1
"""Share of the largest length from which a length is one of the mechanism; less are plates and pins."""


def measured(bench: Bench, finding: Finding, decided: Change) -> Iterator[Change]:
    """What makes the keys that are as large as the finding's value keep its limit, the most alike first."""
    value, limit = finding.value, finding.limit
    if value is None or limit is None or value <= 0 or not finding.unit or value == limit:
        return
    near = []
    for key in bench.keys.values():
        now = bench.now(key, decided) if key.kind == "number" and key.unit == finding.unit else None
        if isinstance(now, int | float) and abs(now - value) <= _ALIKE * value:
            near.append((abs(now - value), key.path, float(now)))
    for _, path, now in sorted(near):
        key, wanted = bench.keys[path], now + limit - value
        if wanted <= 0:
            continue
        rounded = _rounded(wanted, up=limit > value)
        if key.low <= rounded <= key.high:
            yield {path: typed(key, rounded)}
    for whole in _whole(bench, value, limit, finding.unit, decided):
        if len(whole) > 1 or not near:
            yield whole


def _whole(bench: Bench, value: float, limit: float, unit: str, decided: Change) -> Iterator[Change]:
    """The mechanism in proportion: first the lengths that reach far, then all that the file says.

    What is measured is that of the mechanism where none of its lengths is much larger.
    """
    tables = tuple(f"{table}." for table in bench.design.own_tables)
    lengths = {
        key: float(bench.now(key, decided))
        for key in bench.keys.values()
        if key.path.startswith(tables) and key.kind == "number" and key.unit == unit
        if isinstance(bench.now(key, decided), int | float)
        and (key.stands_in(bench.design.content) or key.path in decided)
    }
    largest = max(map(abs, lengths.values()), default=0.0)
    if limit >= value or not value * _OF_IT < largest <= value * (1 + _ALIKE):
        return
    # What the largest length, once or as a radius twice, does not account for may not shrink with it.
    reach = min(largest * max(value // largest, 1.0), value)
    all_of_it, least_of_it = limit / value, (limit - (value - reach)) / reach
    proposed = list[Change]()
    for ratio in (all_of_it, (all_of_it + least_of_it) / 2, least_of_it):
        for least in (largest * _FAR, 0.0):
            lengths_now = {key: now for key, now in lengths.items() if abs(now) > least}
            scaled = _scaled(lengths_now, ratio) if ratio > 0 else None
            if scaled is not None and scaled not in proposed:
                proposed.append(scaled)
    yield from proposed


def _scaled(lengths: Mapping[Key, float], ratio: float) -> Change | None:
    """Lengths times a ratio, as far as their keys allow it; None where one does not."""
    scaled = {
        key: math.copysign(_rounded(abs(now) * ratio, up=False), now) if now else now
        for key, now in lengths.items()
    }
    if not all(key.low <= value <= key.high for key, value in scaled.items()):
        return None
    return {key.path: typed(key, value) for key, value in scaled.items() if value != lengths[key]}


def _rounded(wanted: float, *, up: bool) -> float:
    step = 10.0 ** (math.floor(math.log10(wanted)) - _DIGITS + 1)
    return round_to((math.ceil if up else math.floor)(wanted / step) * step)
