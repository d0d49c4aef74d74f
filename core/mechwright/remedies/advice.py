"""Values that the words of a finding advise for keys of the design file.

Whoever refuses a design often knows the number. Said in a sentence it is worth as much as a proposal: it is
tried before it is told.
"""

import re
from collections.abc import Iterator, Mapping

from mechwright.contracts.finding import Change
from mechwright.remedies.keys import Key
from mechwright.remedies.values import round_to, typed

_NUMBER = re.compile(
    r"(?:use|set it to|make it)(?: (at most|at least|less than|more than))? (-?\d+(?:\.\d+)?)"
)
_OWN = re.compile(r'(?:use|take) "([\w.-]+)"')
_OTHER = re.compile(r'([\w.]+) = "([\w.-]+)"')
_FURTHER = {"at most": -1, "less than": -1, "at least": 1, "more than": 1}
_STEP = 0.01
"""Share by which a number is tried further on: limits are not always meant, and are rounded in print."""


def advised(words: str, own: Key | None, keys: Mapping[str, Key]) -> Iterator[Change]:
    """Changes that the words advise; ``own`` is the key that the finding is about.

    Examples
    --------
    >>> width = Key("cam.hold.tab_width", "number", 1.0, 50.0)
    >>> list(advised("use at most 3.20 mm, or fewer tabs", width, {width.path: width}))
    [{'cam.hold.tab_width': 3.2}, {'cam.hold.tab_width': 3.168}]
    """
    if own is not None and own.numeric:
        for side, number in _NUMBER.findall(words):
            value, further = float(number), _FURTHER.get(side, 0)
            for tried in dict.fromkeys((value, value + further * _STEP * abs(value))):
                if own.low <= tried <= own.high:
                    yield {own.path: typed(own, round_to(tried))}
    if own is not None and own.kind == "choice":
        yield from ({own.path: choice} for choice in _OWN.findall(words) if choice in own.choices)
    for name, choice in _OTHER.findall(words):
        meant = [
            key for key in keys.values() if f".{key.path}".endswith(f".{name}") and choice in key.choices
        ]
        yield from ({key.path: choice} for key in meant)
