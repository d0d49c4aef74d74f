"""A drawing from its bytes to contours with their meanings."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from mechwright.drawings.asked import Asked, Meanings, sorted_out
from mechwright.drawings.fault import Told
from mechwright.drawings.meaning import Meaning
from mechwright.drawings.strokes import Stroke
from mechwright.errors import DesignError

if TYPE_CHECKING:
    from mechwright.drawings.contours import Contour


@dataclass
class Drawn:
    """What a drawing shows.

    Parameters
    ----------
    contours
        By what they mean.
    strokes
        Of engraved lines and of threads' circles, which need not be closed.
    told
        Faults, and what was mended or left out.
    """

    contours: "dict[Meaning, list[Contour]]" = field(default_factory=dict)
    strokes: dict[Meaning, list[Stroke]] = field(default_factory=dict)
    told: Told = field(default_factory=Told)


OPEN = frozenset({"engrave", "thread"})
"""Kinds whose curves need not be closed."""


def read(data: bytes, asked: Asked, others: Meaning | None = None) -> Drawn:
    """Contours of a drawing, mm; what keeps it from being a part stands in its faults.

    ``others`` is what layers are that nobody says the meaning of; by default one may be the plate, and more
    are faults.
    """
    from mechwright.drawings.contours import contours
    from mechwright.drawings.opened import opened
    from mechwright.drawings.shown import strokes
    from mechwright.drawings.units import unit_of

    found = Drawn()
    told = found.told
    try:
        document = opened(data)
    except DesignError as error:
        said, _, remedy = str(error).rpartition("; ")
        told.fault("file", f"the drawing {said or remedy}", remedy if said else "give a DXF drawing")
        return found
    unit = unit_of(document, asked.units, told)
    meanings = Meanings(asked, unit, told)
    if told.faults:
        return found
    shown = strokes(document, unit * asked.scale, meanings.named, meanings.ignored, told)
    _unknown_keys(asked, {(one.layer, one.colour) for one in shown}, document, told)
    by_meaning = sorted_out(shown, meanings, told, others)
    for meant, some in sorted(by_meaning.items(), key=lambda item: repr(item[0])):
        if meant.kind in OPEN:
            found.strokes[meant] = some
        else:
            found.contours[meant] = contours(some, asked.join, told)
    return found


def _unknown_keys(asked: Asked, seen: set[tuple[str, int]], document: object, told: Told) -> None:
    """Refuse a layer or colour that is named and is not there: a slip of the pen would cut it otherwise."""
    layers = {str(one.dxf.name) for one in document.layers} | {layer for layer, _ in seen}  # type: ignore[attr-defined]
    known = {name.lower() for name in layers}
    colours = {colour for _, colour in seen}
    for name, _ in asked.layers:
        word, _, number = name.rpartition(" ")
        if word.lower() in {"colour", "color"} and number.isdecimal():
            if int(number) not in colours:
                has = ", ".join(map(str, sorted(colours))) or "none"
                told.fault(
                    "layer", f"nothing is drawn in {name}; there is: {has}", "correct layers", "layers"
                )
        elif name.lower() not in known:
            told.fault(
                "layer",
                f"there is no layer {name!r}; it has: {', '.join(sorted(layers))}",
                "correct layers",
                "layers",
            )
