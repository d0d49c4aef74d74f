"""Changes of the length that a finding has measured, where it knows no key for it.

Who judges a part knows how thick it is and not which key makes it so. A key that is about as large as what
was found is likely to be the one: it is changed by as much as there is too much, or too little.
"""

import math
from collections.abc import Iterator

from mechwright.contracts.finding import Change, Finding
from mechwright.remedies.bench import Bench
from mechwright.remedies.values import round_to, typed

_ALIKE = 0.1
"""Share by which a key may differ from what was measured: a cutter goes deeper than its part is thick."""

_DIGITS = 3
"""Of a value that is named."""


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
        step = 10.0 ** (math.floor(math.log10(wanted)) - _DIGITS + 1)
        rounded = round_to((math.floor if limit < value else math.ceil)(wanted / step) * step)
        if key.low <= rounded <= key.high:
            yield {path: typed(key, rounded)}
