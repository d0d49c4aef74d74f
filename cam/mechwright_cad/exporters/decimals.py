"""Decimals of the numbers in DXF and STEP files.

Last digits of sines, sums and solved equations differ from processor to processor, and so would files. What
is written has fewer decimals, and still more than any tolerance.
"""

import re

PLACES = 8
"""Of lengths and angles, mm and degrees: a tenth of what closes a wire for the kernel."""
SHARES = 12
"""Of numbers without a unit, such as directions and knots of a spline, and of radii."""

_DXF_PLACES = frozenset((*range(10, 40), 50, 51, *range(110, 140), *range(210, 240)))
"""Group codes of coordinates and angles."""
_DXF_SHARES = frozenset((*range(40, 50), *range(52, 60), *range(140, 150)))
"""Group codes of other numbers."""
_STATEMENT = re.compile(rb"#\d+ = [^;]*;\n")
_POINT = re.compile(rb"#\d+ = CARTESIAN_POINT\b")
_NAME = re.compile(rb"'[^']+'")
_LONG = re.compile(rb"-?\d+\.\d{%d,}(?:E[+-]?\d+)?|-?\d+\.\d*E-\d+" % (PLACES + 1))


def of_dxf(text: str) -> str:
    """A DXF file as text, whose numbers have no more decimals than they are good for."""
    lines = text.split("\n")
    for place in range(0, len(lines) - 1, 2):
        value = lines[place + 1]
        if not ("." in value or "e" in value):
            continue
        code = int(lines[place])
        if code in _DXF_PLACES:
            lines[place + 1] = repr(round(float(value), PLACES) + 0.0)
        elif code in _DXF_SHARES:
            lines[place + 1] = repr(round(float(value), SHARES) + 0.0)
    return "\n".join(lines)


def of_step(text: bytes) -> bytes:
    """A STEP file, the same."""
    return _STATEMENT.sub(_rounded, text)


def _rounded(statement: re.Match[bytes]) -> bytes:
    if _NAME.search(statement[0]):
        return statement[0]  # whose digits are none of ours
    decimals = PLACES if _POINT.match(statement[0]) else SHARES
    return _LONG.sub(lambda number: _written(float(number[0]), decimals), statement[0])


def _written(value: float, decimals: int) -> bytes:
    """A number as STEP has it: always with a point.

    >>> _written(64.828640838681, 8), _written(-1e-17, 8), _written(5.0, 8)
    (b'64.82864084', b'0.', b'5.')
    """
    text = f"{round(value, decimals) + 0.0:.{decimals}f}".rstrip("0")
    return text.encode()
