"""Scalable pictures in millimetres: y points up, numbers are short, text is escaped."""

import math
from collections.abc import Iterable, Sequence
from html import escape

from mechwright.geometry.segments import Point

DIGITS = 2
"""Decimals of coordinates: a hundredth of a millimetre is below a printer's dot."""


def number(value: float) -> str:
    """A coordinate, short.

    >>> number(-0.001), number(12.5), number(3.0)
    ('0', '12.5', '3')
    """
    text = f"{value:.{DIGITS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def signed(value: float, digits: int = 2) -> str:
    """A coordinate for people, with a true minus sign.

    >>> signed(-10.3), signed(5), signed(-0.0001)
    ('−10.30', '+5.00', '0.00')
    """
    if abs(value) < 0.5 * 10**-digits:
        return f"{0:.{digits}f}"
    return f"{value:+.{digits}f}".replace("-", "−")


def place(x: float, y: float) -> str:
    """A point as SVG sees it, y pointing down."""
    return f"{number(x)},{number(-y)}"


def path(points: Iterable[Sequence[float]], *, close: bool = False) -> str:
    """Path data of a polyline.

    >>> path([(0, 0), (1, 2)], close=True)
    'M0,0L1,-2Z'
    """
    return "M" + "L".join(place(x, y) for x, y in points) + ("Z" if close else "")


def arc_to(start: Point, end: Point, centre: Point, *, ccw: bool) -> str:
    """Path data of an arc from the present point; an end equal to the start is a full turn."""
    radius = math.hypot(start[0] - centre[0], start[1] - centre[1])
    first = math.atan2(start[1] - centre[1], start[0] - centre[0])
    last = math.atan2(end[1] - centre[1], end[0] - centre[0])
    sweep = (last - first if ccw else first - last) % math.tau
    flag = 0 if ccw else 1  # y is mirrored, and with it the sense of turning
    if sweep < 1e-9:
        over = (2 * centre[0] - start[0], 2 * centre[1] - start[1])
        r = number(radius)
        return f"A{r} {r} 0 0 {flag} {place(*over)}A{r} {r} 0 0 {flag} {place(*end)}"
    r = number(radius)
    return f"A{r} {r} 0 {int(sweep > math.pi)} {flag} {place(*end)}"


def element(name: str, content: str = "", /, **attributes: object) -> str:
    """An element; attribute names take underscores for hyphens, values and nothing else are escaped.

    >>> element("line", x1=0, stroke_width="0.3")
    '<line x1="0" stroke-width="0.3"/>'
    """
    rows = "".join(
        f' {key.rstrip("_").replace("_", "-")}="{escape(value if isinstance(value, str) else _plain(value))}"'
        for key, value in attributes.items()
        if value is not None
    )
    return f"<{name}{rows}>{content}</{name}>" if content else f"<{name}{rows}/>"


def picture(
    content: str, box: Sequence[float], label: str, font_family: str | None = "Helvetica, Arial, sans-serif"
) -> str:
    """The whole picture: least x and y as SVG sees them, width and height, and what a screen reader says."""
    view = " ".join(map(number, box))
    look: dict[str, object] = {
        "viewBox": view,
        "font_family": font_family,
        "role": "img",
        "aria_label": label,
    }
    return element("svg", content, xmlns="http://www.w3.org/2000/svg", **look)


def text(x: float, y: float, words: str, size: float, /, **attributes: object) -> str:
    """Escaped text at a point."""
    return element("text", escape(words), x=number(x), y=number(-y), font_size=number(size), **attributes)


def _plain(value: object) -> str:
    return number(value) if isinstance(value, float) else str(value)
