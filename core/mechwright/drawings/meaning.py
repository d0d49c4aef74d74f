"""What a layer says of its contours: by its name, or by the words of the design file.

Words are parted by spaces, ``_`` or ``-``; capitals do not matter. The first says what is cut, others how::

    OUTLINE             the outside of the plate, and openings that lie in it
    THROUGH             openings all through; circles are bores
    BORE_H7             circles to a fit; BORE_8, BORE_H7_8: 8 deep
    POCKET_3.5          a recess, its floor 3.5 below the top face; POCKET_3.5_R1: a fillet of 1 round it
    POCKET_10_FROM_7    one that begins 7 below the top face
    POCKET_3.5_OPEN     the same as POCKET_3.5: where its contour runs beyond the rim, and no wall is left
    SCREW_M6            holes for cylinder heads of ISO 4762; SUNK_M6: for countersunk ones of ISO 10642;
                        SCREW_1_4, SCREW_#10: for cylinder heads of ASME B18.3, of 1/4 and #10
    M5, M5X0.5_12       circles, threaded, 12 deep; also THREAD_M5; M5_LH: left-hand; 1_4-20_UNC: in inches
    ENGRAVE_0.2         lines engraved so deep; ENGRAVE_0.2_W0.5: at most 0.5 wide
    CHAMFER_0.5         edges broken so wide: the edge itself, or the line where the chamfer ends
    IGNORE              nothing, as CENTRE, TEXT, DIM, HIDDEN and other names of what is no edge

Numbers are in the unit of the drawing, or in the unit that follows them: ``POCKET_3.5mm``.
"""

import re
from dataclasses import dataclass
from typing import Any, Literal

from mechwright.contracts.limits import HOLE_CLASS
from mechwright.contracts.threads import named
from mechwright.errors import DesignError, GeometryError
from mechwright.standards.screw_holes import seat

Kind = Literal["outline", "through", "bore", "pocket", "thread", "engrave", "chamfer", "screw", "ignore"]

_SUNK = ("SUNK", "CSK", "CSINK", "COUNTERSINK")
"""Words for screws with countersunk heads."""
_WORDS: dict[str, Kind] = {
    **dict.fromkeys(("OUTLINE", "OUTSIDE", "PERIMETER"), "outline"),
    **dict.fromkeys(("THROUGH", "OPENING", "OPENINGS", "CUT", "CUTOUT", "CUTOUTS", "EDGE.CUTS"), "through"),
    **dict.fromkeys(("BORE", "BORES", "HOLE", "HOLES", "DRILL", "REAM"), "bore"),
    **dict.fromkeys(("POCKET", "POCKETS", "RECESS"), "pocket"),
    **dict.fromkeys(("THREAD", "TAP"), "thread"),
    **dict.fromkeys(("ENGRAVE", "ENGRAVING"), "engrave"),
    "CHAMFER": "chamfer",
    **dict.fromkeys(("SCREW", "SCREWS", "CBORE", "COUNTERBORE", *_SUNK), "screw"),
    **dict.fromkeys(
        ("IGNORE", "CENTRE", "CENTER", "TEXT", "NOTES", "DIM", "DIMS", "DIMENSION", "DIMENSIONS", "HIDDEN",
         "DEFPOINTS", "CONSTRUCTION", "FRAME", "BORDER", "TITLE", "HATCH"), "ignore",
    ),
}  # fmt: skip
_NAMES = {
    **dict.fromkeys(("IV OUTER PROFILE", "OUTER PROFILE", "OUTER PROFILES"), "OUTLINE"),
    **dict.fromkeys(("IV INTERIOR PROFILES", "INTERIOR PROFILES", "INNER PROFILES"), "THROUGH"),
    "IV ARC CENTERS": "IGNORE",
}
"""Whole names of layers of other programs."""
_FIT = re.compile(HOLE_CLASS)
_THREAD = re.compile(r"M\d+(?:\.\d+)?(?:X\d+(?:\.\d+)?)?")
_UNIFIED = re.compile(r"(?<![A-Z0-9#.])(#\d+|\d+[/_]\d+|\d)[\s_\-]+(\d+)[\s_\-]+(UNC|UNF)(?![A-Z0-9])")
"""A unified thread as layers have it: 1_4-20 UNC, for a name has no stroke."""
_INCH_THREAD = re.compile(r"(#\d+|\d+/\d+|\d)~(\d+)~(UNC|UNF)")
"""The same as one word."""
_FRACTION = re.compile(r"(?<![\w.])(\d) (\d+)$")
"""A fraction of an inch in the name of a layer, which has no stroke."""
_NUMBER = re.compile(r"(\d+(?:\.\d*)?|\.\d+)(MM|IN)?")

ENGRAVED, LINE = 0.2, 0.6
"""Depth and greatest width of engraved lines where nothing is said, mm: as of marks."""


@dataclass(frozen=True)
class Meaning:
    """What becomes of contours; lengths in mm, None where nothing is said.

    ``depth`` is that of the floor below the top face, ``top`` where the recess begins.
    """

    kind: Kind
    depth: float | None = None
    top: float | None = None
    fit: str = ""
    thread: str = ""
    floor_radius: float = 0.0
    width: float | None = None
    screw: str = ""

    @property
    def text(self) -> str:
        """In words, for people."""
        deep = "" if self.depth is None else f" {self.depth:g} mm deep"
        match self.kind:
            case "bore":
                return f"bores{' ' + self.fit if self.fit else ''}{deep or ' all through'}"
            case "thread":
                return f"threads {self.thread}{deep or ' all through'}"
            case "screw":
                return f"holes for screws {self.screw}"
            case "pocket":
                start = f" from {self.top:g} mm on" if self.top else ""
                return f"recesses{deep}{start}" + (
                    f", floor R{self.floor_radius:g}" if self.floor_radius else ""
                )
            case "engrave":
                return f"engraved lines{deep}"
            case "chamfer":
                return f"edges broken {self.width:g} mm wide"
        return {"outline": "the outline", "through": "openings", "ignore": "left out"}[self.kind]


def meaning(text: str, unit: float) -> Meaning | None:
    """What a text means, numbers in a unit of so many mm; None for one that means nothing here.

    Raises DesignError for one that begins with a known word and goes on with what cannot be understood.

    >>> meaning("POCKET_3.5", 1.0).kind, meaning("POCKET_3.5", 1.0).depth, meaning("Layer 1", 1.0)
    ('pocket', 3.5, None)
    """
    plain = text.upper().replace(",", ".").replace("×", "X").replace("_UN", " UN")
    plain = _UNIFIED.sub(lambda of: f"{of[1].replace('_', '/')}~{of[2]}~{of[3]}", plain)
    words = [word for word in re.split(r"[\s_\-]+", plain) if word]
    words = [_NAMES[" ".join(words)]] if " ".join(words) in _NAMES else words
    if not words:
        return None
    if words[0] in _WORDS:
        kind, words = _WORDS[words[0]], words[1:]
    elif _THREAD.fullmatch(words[0]) or _INCH_THREAD.fullmatch(words[0]):
        kind = "thread"
    elif _FIT.fullmatch(words[0]):
        kind = "bore"
    else:
        return None
    if kind == "ignore":
        return Meaning("ignore")
    if kind == "screw":
        return Meaning("screw", screw=_screw(text, words, sunk=_first(text) in _SUNK))
    return _said(text, kind, words, unit)


def _first(text: str) -> str:
    return re.split(r"[\s_\-]+", text.strip().upper())[0]


def _screw(text: str, words: list[str], *, sunk: bool) -> str:
    """The screw that a layer names: its thread alone, or with the standard before it."""
    said = (
        _FRACTION.sub(r"\1/\2", " ".join(words))
        .replace("ISO4762", "ISO 4762")
        .replace("ISO10642", "ISO 10642")
    )
    if sunk and not said.startswith(("ISO", "ASME")):
        said = f"ISO 10642 {said}" if said.startswith("M") else f"ASME B18.3.5 {said}"
    try:
        return seat(said).name
    except DesignError as error:
        raise DesignError(f"{text!r}: {error}") from error


def _said(text: str, kind: Kind, words: list[str], unit: float) -> Meaning:
    said: dict[str, float | str] = {}
    waiting = ""
    for word in words:
        number = _NUMBER.fullmatch(word)
        key, rest = ("", word) if number else (word[:1], word[1:])
        if word in {"FROM", "R", "W"}:
            waiting = {"FROM": "top", "R": "floor_radius", "W": "width"}[word]
            continue
        if kind == "bore" and _FIT.fullmatch(word):
            _set(text, said, "fit", word)
        elif kind == "thread" and _THREAD.fullmatch(word):
            _set(text, said, "thread", "M" + word[1:].replace("X", "x"))
        elif kind == "thread" and (inch := _INCH_THREAD.fullmatch(word)):
            _set(text, said, "thread", f"{inch[1]}-{inch[2]} {inch[3]}")
        elif kind == "thread" and word == "LH" and "thread" in said:
            said["thread"] = f"{said['thread']} LH"
        elif number:
            _set(text, said, waiting or ("width" if kind == "chamfer" else "depth"), _length(word, unit))
            waiting = ""
        elif key in {"R", "W"} and _NUMBER.fullmatch(rest):
            _set(text, said, {"R": "floor_radius", "W": "width"}[key], _length(rest, unit))
        elif word not in {"DEEP", "THROUGH", "OPEN"} and not (kind in {"outline", "through"} and not said):
            raise DesignError(f"{text!r}: {word!r} is not understood after {kind}")
    if waiting:
        raise DesignError(f"{text!r}: a number is missing after {words[-1]}")
    return _checked(text, kind, said)


def _set(text: str, said: dict[str, float | str], key: str, value: float | str) -> None:
    if key in said:
        raise DesignError(f"{text!r}: says two values of {key.replace('_', ' ')}")
    said[key] = value


def _length(word: str, unit: float) -> float:
    found = _NUMBER.fullmatch(word)
    assert found is not None  # noqa: S101 - callers have matched it
    return round(float(found[1]) * {"MM": 1.0, "IN": 25.4, None: unit}[found[2]], 6)


_MAY: dict[Kind, set[str]] = {
    "screw": set(),
    "outline": set(),
    "through": set(),
    "bore": {"depth", "fit", "top"},
    "pocket": {"depth", "top", "floor_radius"},
    "thread": {"depth", "thread"},
    "engrave": {"depth", "width"},
    "chamfer": {"width"},
}
_HAS: dict[Kind, tuple[str, str]] = {
    "pocket": ("depth", "3.5"),
    "thread": ("thread", "M5"),
    "chamfer": ("width", "0.5"),
}
"""What a kind cannot do without, and an example of it."""


def _checked(text: str, kind: Kind, said: dict[str, float | str]) -> Meaning:
    for key, value in said.items():
        if key not in _MAY[kind]:
            raise DesignError(f"{text!r}: {kind} has no {key.replace('_', ' ')}")
        if isinstance(value, float) and not (value > 0 or key == "top"):
            raise DesignError(f"{text!r}: the {key.replace('_', ' ')} is 0")
    if kind in _HAS and _HAS[kind][0] not in said:
        key, example = _HAS[kind]
        raise DesignError(f"{text!r}: {kind} without its {key}; say it, as {kind.upper()}_{example}")
    if "thread" in said:
        try:
            named(str(said["thread"]))
        except GeometryError as error:
            raise DesignError(f"{text!r}: {error}") from error
    found: dict[str, Any] = dict(said)
    return Meaning(kind, **found)
