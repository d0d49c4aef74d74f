"""A sheet as PDF 1.4: lines, filled areas and text in Helvetica, or in a font that the file brings along.

Nothing in it depends on the day or the machine: the same sheet gives the same bytes, and its text
can be selected.
"""

from collections.abc import Iterable, Iterator

from mechwright.pipeline.result_store import stored
from mechwright_cad.sheet.fonts import ENCODING, Embedded, default_font, embedded, is_plain
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
    width_of,
)

_POINT = 72 / 25.4
"""Points in a millimetre."""


@stored
def pdf(sheet: Sheet, title: str = "", font: bytes = b"") -> bytes:
    """The whole file; texts with letters that Helvetica has not are written in the TrueType ``font``."""
    other = [text.text for text in _texts(sheet.items) if not is_plain(text.text)]
    own = embedded(font or default_font(), other, "drawings.font") if other else None
    content = "\n".join(
        [f"{_POINT:.6f} 0 0 {_POINT:.6f} 0 0 cm 1 J 1 j", *(_drawn(item, own) for item in sheet.items)]
    ).encode(ENCODING)
    box = f"0 0 {sheet.width * _POINT:.2f} {sheet.height * _POINT:.2f}"
    fonts = "/F 5 0 R" + (" /G 7 0 R" if own is not None else "")
    objects = [
        b"<< /Type /Catalog /Pages 2 0 R >>",
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        f"<< /Type /Page /Parent 2 0 R /MediaBox [{box}] /Contents 4 0 R "
        f"/Resources << /Font << {fonts} >> >> >>".encode(),
        _stream(content),
        b"<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>",
        f"<< /Title {_title(title)} /Producer (Mechwright) >>".encode(ENCODING),
        *(_font(own) if own is not None else ()),
    ]
    found, places = b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n", []
    for number, body in enumerate(objects, start=1):
        places.append(len(found))
        found += b"%d 0 obj\n%s\nendobj\n" % (number, body)
    table = "".join(f"{place:010} 00000 n \n" for place in places)
    start, count = len(found), len(objects) + 1
    end = (
        f"xref\n0 {count}\n0000000000 65535 f \n{table}"
        f"trailer\n<< /Size {count} /Root 1 0 R /Info 6 0 R >>\nstartxref\n{start}\n%%EOF\n"
    )
    return found + end.encode()


def _stream(content: bytes, more: str = "") -> bytes:
    return b"<< /Length %d%s >>\nstream\n%s\nendstream" % (len(content), more.encode(), content)


def _title(text: str) -> str:
    if is_plain(text):
        return f"({_escaped(text)})"
    return "<FEFF" + text.encode("utf-16-be").hex().upper() + ">"


def _font(own: Embedded) -> list[bytes]:
    """A font whose codes are the numbers of its glyphs, with their letters, so that text can be searched."""
    ordered = sorted((number, wide, letter) for letter, (number, wide) in own.glyphs.items())
    widths = " ".join(f"{number} [{wide}]" for number, wide, _ in ordered)
    meant = "\n".join(
        f"<{number:04X}> <{letter.encode('utf-16-be').hex().upper()}>" for number, _, letter in ordered
    )
    told = (
        "/CIDInit /ProcSet findresource begin 12 dict begin begincmap /CMapName /Own def /CMapType 2 def\n"
        f"1 begincodespacerange <0000> <FFFF> endcodespacerange\n{len(ordered)} beginbfchar\n{meant}\n"
        "endbfchar endcmap CMapName currentdict /CMap defineresource pop end end"
    )
    box = " ".join(map(str, own.box))
    return [
        b"<< /Type /Font /Subtype /Type0 /BaseFont /AAAAAA+Own /Encoding /Identity-H "
        b"/DescendantFonts [8 0 R] /ToUnicode 11 0 R >>",
        f"<< /Type /Font /Subtype /CIDFontType2 /BaseFont /AAAAAA+Own /CIDToGIDMap /Identity /W [{widths}] "
        "/CIDSystemInfo << /Registry (Adobe) /Ordering (Identity) /Supplement 0 >> "
        "/FontDescriptor 9 0 R >>".encode(),
        f"<< /Type /FontDescriptor /FontName /AAAAAA+Own /Flags 4 /FontBBox [{box}] /ItalicAngle 0 "
        f"/Ascent {own.ascent} /Descent {own.descent} /CapHeight {own.ascent} /StemV 80 "
        "/FontFile2 10 0 R >>".encode(),
        _stream(own.file, f" /Length1 {len(own.file)}"),
        _stream(told.encode()),
    ]


def _texts(items: Iterable[Item]) -> Iterator[Text]:
    for item in items:
        if isinstance(item, Text):
            yield item
        elif isinstance(item, Dimension):
            yield from _texts(item.pieces)


def _drawn(item: Item, own: Embedded | None) -> str:
    match item:
        case Stroke(points, layer):
            return f"{_pen(layer)} {_path(points)} S"
        case Fill(points, _):
            return f"{_path(points)} h f"
        case Text():
            x, y = item.left
            if own is not None and not is_plain(item.text):
                # As wide as the sheet takes it to be, whatever the font.
                size = item.height * SIZE
                share = 100 * width_of(item.text, item.height) / (own.width(item.text) * size)
                return (
                    f"BT /G {_n(size)} Tf {_n(share)} Tz {_n(x)} {_n(y)} Td <{own.hex(item.text)}> Tj "
                    "100 Tz ET"
                )
            return f"BT /F {_n(item.height * SIZE)} Tf {_n(x)} {_n(y)} Td ({_escaped(item.text)}) Tj ET"
        case Dimension():
            return "\n".join(_drawn(one, own) for one in item.pieces)


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
