"""Letters that Helvetica has not: the part of a TrueType font that a PDF carries along."""

import io
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path

from mechwright.errors import DesignError, MechwrightError
from mechwright.reading import read_bytes

ENCODING = "cp1252"
"""Letters that a PDF shows in Helvetica, which every reader has."""

KEPT = frozenset(["cmap", "glyf", "head", "hhea", "hmtx", "loca", "maxp", "name", "OS/2", "post"])
"""Tables of a font that a PDF needs, or its subset; all others, such as kerning, are left out."""

_EM = 1000
"""Units of widths in a PDF."""


def is_plain(text: str) -> bool:
    """Whether Helvetica has all letters of a text."""
    try:
        text.replace("⌀", "Ø").encode(ENCODING)
    except UnicodeEncodeError:
        return False
    return True


@dataclass(frozen=True)
class Embedded:
    """A subset of a font: its file, measures in thousandths of its size, glyph and width of each letter."""

    file: bytes
    box: tuple[int, ...]
    ascent: int
    descent: int
    glyphs: dict[str, tuple[int, int]]

    def width(self, text: str) -> float:
        """Advance of a text, in sizes of the font."""
        return sum(self.glyphs[letter][1] for letter in text) / _EM

    def hex(self, text: str) -> str:
        """A text as the numbers of its glyphs."""
        return "".join(f"{self.glyphs[letter][0]:04X}" for letter in text)


def default_font() -> bytes:
    """DejaVu Sans as Matplotlib brings it along, which has Latin, Greek and Cyrillic; empty without it."""
    found = find_spec("matplotlib")
    for folder in (found.submodule_search_locations if found else None) or ():
        path = Path(folder) / "mpl-data" / "fonts" / "ttf" / "DejaVuSans.ttf"
        if path.is_file():
            return read_bytes(path)
    return b""


def embedded(data: bytes, texts: Iterable[str], name: str) -> Embedded:
    """What a font has of the letters of some texts; raises DesignError with ``name`` where one is missing."""
    return _embedded(data, "".join(sorted({*"".join(texts), "?"})), name)


@lru_cache(maxsize=16)
def _embedded(data: bytes, letters: str, name: str) -> Embedded:
    try:
        return _subset(data, letters, name)
    except MechwrightError:
        raise
    except Exception as error:  # whatever the reader of fonts meets in a file that is none
        raise DesignError(f"{name} is no TrueType font that can be read; take another .ttf") from error


def _subset(data: bytes, letters: str, name: str) -> Embedded:
    from fontTools import subset
    from fontTools.ttLib import TTFont

    font = TTFont(io.BytesIO(data), recalcTimestamp=False)
    known = font.getBestCmap() or {}
    if "glyf" not in font:
        raise DesignError(f"{name} has no TrueType outlines; take a file that ends in .ttf")
    missing = [letter for letter in letters if ord(letter) not in known]
    if missing:
        raise DesignError(f"{name} has no letter {missing[0]!r}; set drawings.font to a .ttf that has it")
    for table in set(font.keys()) - KEPT - {"GlyphOrder"}:
        del font[table]
    options = subset.Options(hinting=False, layout_features=[], name_IDs=[], recalc_timestamp=False)
    cutter = subset.Subsetter(options)
    cutter.populate(unicodes=[ord(letter) for letter in letters])
    cutter.subset(font)
    file = io.BytesIO()
    font.save(file)
    unit, names = _EM / font["head"].unitsPerEm, font.getBestCmap()
    glyphs = {
        letter: (font.getGlyphID(names[ord(letter)]), round(unit * font["hmtx"][names[ord(letter)]][0]))
        for letter in letters
    }
    head, line = font["head"], font["hhea"]
    box = tuple(round(unit * value) for value in (head.xMin, head.yMin, head.xMax, head.yMax))
    return Embedded(file.getvalue(), box, round(unit * line.ascent), round(unit * line.descent), glyphs)
