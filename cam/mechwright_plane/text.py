"""Numbers and comments as controls read them."""

import math
import textwrap
import unicodedata
from functools import lru_cache

from mechwright_plane.path import DECIMALS, NOISE

COMMENT_WIDTH = 70
"""Longest comment text: Grbl's line buffer of 80 characters is the shortest of the common controls."""

LINUXCNC_ACTIVE = (
    *("MSG", "DEBUG", "PRINT", "LOG", "LOGOPEN", "LOGAPPEND", "LOGCLOSE"),
    *("PROBEOPEN", "PROBECLOSE", "PY", "PYRUN", "PYRELOAD", "ABORT"),
)
"""Words that LinuxCNC obeys at the start of a comment."""
GRBL_REALTIME = "?!~"
"""Grbl takes these out of the stream wherever they stand: ``!`` is a feed hold."""
GRBL_COMMENT_WIDTH = 58
"""Senders and pendants for Grbl show, or take, lines of 60 characters."""

_SPELLED = str.maketrans(
    {"(": "[", ")": "]", "×": "x", "·": ".", "°": " deg", "ø": "D", "Ø": "D", "⌀": "D", "µ": "u", "μ": "u"}
    | {"–": "-", "—": "-", "−": "-", "±": "+-", "≤": "<=", "≥": ">=", "²": "2", "³": "3", "ß": "ss"}
)


@lru_cache(maxsize=65536)
def number(value: float, decimals: int = DECIMALS, point: bool = False) -> str:
    """Write a number without needless zeros; passes at many depths ask for the same ones.

    With ``point`` it has a decimal point in any case: Fanuc and Haas read X10 as ten thousandths.

    >>> number(12.30000), number(-0.00001), number(5.0), number(5.0, point=True)
    ('12.3', '0', '5', '5.')
    """
    text = f"{value:.{decimals}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    text = "0" if text == "-0" else text
    return text + "." if point and "." not in text else text


def floored(value: float, decimals: int) -> float:
    """The next value at or below, of so many decimals: what is to be cut through is cut through.

    >>> floored(-6.33333, 3), floored(-6.3, 3), floored(2.0004, 3)
    (-6.334, -6.3, 2.0)
    """
    scale = 10.0**decimals
    return math.floor(value * scale + NOISE) / scale


def comment_lines(
    text: str,
    active: tuple[str, ...] = (),
    forbidden: str = "",
    upper: bool = False,
    width: int = COMMENT_WIDTH,
) -> list[str]:
    r"""Make any text safe inside parentheses: ASCII, no parentheses of its own, short lines.

    A line is quoted that starts with an ``active`` word, one that the control obeys at the start of a comment
    (LinuxCNC's ``LOGOPEN`` opens a file). Characters that the control would obey or choke on even in a
    comment, ``forbidden``, become spaces. With ``upper`` the control shows capitals only. A line has
    fewer than ``width`` characters.

    Examples
    --------
    >>> comment_lines("bore Ø8 (H7)\nM30")
    ['bore D8 [H7] M30']
    >>> comment_lines("logopen,/etc/passwd", active=("LOGOPEN",))
    ["'logopen,/etc/passwd"]
    """
    # Once more after the decomposition: it makes plain parentheses of full-width ones.
    plain = unicodedata.normalize("NFKD", text.translate(_SPELLED)).translate(_SPELLED)
    ascii_text = "".join(c for c in plain if not unicodedata.combining(c)).encode("ascii", "replace").decode()
    printable = "".join(c if c.isprintable() and c not in forbidden else " " for c in ascii_text)
    printable = printable.upper() if upper else printable
    lines = textwrap.wrap(" ".join(printable.split()), width - 1)
    return [f"'{line}" if line.upper().startswith(active) else line for line in lines] if active else lines
