"""A sheet as PDF 1.4: lines, filled areas and text in Helvetica, which every reader has.

Nothing in it depends on the day, the machine or its fonts: the same sheet gives the same bytes, and its text
can be selected.
"""

from mechwright_cad.sheet.sheet import (
    DASHES,
    SIZE,
    WIDTH,
    Dimension,
    Fill,
    Item,
    Layer,
    Sheet,
    Stroke,
    Text,
)

_POINT = 72 / 25.4
"""Points in a millimetre."""


def pdf(sheet: Sheet, title: str = "") -> bytes:
    """The whole file."""
    content = "\n".join(
        [f"{_POINT:.6f} 0 0 {_POINT:.6f} 0 0 cm 1 J 1 j", *(_drawn(item) for item in sheet.items)]
    ).encode("cp1252", "replace")
    box = f"0 0 {sheet.width * _POINT:.2f} {sheet.height * _POINT:.2f}"
    objects = [
        b"<< /Type /Catalog /Pages 2 0 R >>",
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        f"<< /Type /Page /Parent 2 0 R /MediaBox [{box}] /Contents 4 0 R "
        "/Resources << /Font << /F 5 0 R >> >> >>".encode(),
        b"<< /Length %d >>\nstream\n%s\nendstream" % (len(content), content),
        b"<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>",
        f"<< /Title ({_escaped(title)}) /Producer (Mechwright) >>".encode("cp1252", "replace"),
    ]
    found, places = b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n", []
    for number, body in enumerate(objects, start=1):
        places.append(len(found))
        found += b"%d 0 obj\n%s\nendobj\n" % (number, body)
    table = "".join(f"{place:010} 00000 n \n" for place in places)
    start = len(found)
    end = (
        f"xref\n0 {len(objects) + 1}\n0000000000 65535 f \n{table}"
        f"trailer\n<< /Size {len(objects) + 1} /Root 1 0 R /Info 6 0 R >>\nstartxref\n{start}\n%%EOF\n"
    )
    return found + end.encode()


def _drawn(item: Item) -> str:
    match item:
        case Stroke(points, layer):
            return f"{_pen(layer)} {_path(points)} S"
        case Fill(points, _):
            return f"{_path(points)} h f"
        case Text():
            x, y = item.left
            return f"BT /F {_n(item.height * SIZE)} Tf {_n(x)} {_n(y)} Td ({_escaped(item.text)}) Tj ET"
        case Dimension():
            return "\n".join(_drawn(one) for one in item.pieces)


def _pen(layer: Layer) -> str:
    dashes = " ".join(_n(one) for one in DASHES.get(layer, ()))
    return f"{_n(WIDTH[layer])} w [{dashes}] 0 d"


def _path(points: tuple[tuple[float, float], ...]) -> str:
    return " ".join(f"{_n(x)} {_n(y)} {'l' if k else 'm'}" for k, (x, y) in enumerate(points))


def _n(value: float) -> str:
    """A number to a thousandth of a millimetre, never -0."""
    return f"{round(value, 3) + 0.0:g}" if abs(value) < 1000 else f"{value:.3f}"


def _escaped(text: str) -> str:
    for letter in "\\()":
        text = text.replace(letter, f"\\{letter}")
    return text.replace("⌀", "Ø")
