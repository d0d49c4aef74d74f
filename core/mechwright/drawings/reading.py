"""A drawing from its bytes to contours with their meanings."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from mechwright.drawings.asked import Asked, Meanings, is_colour, sorted_out
from mechwright.drawings.fault import Told
from mechwright.drawings.meaning import Meaning
from mechwright.drawings.strokes import Stroke
from mechwright.errors import DesignError

if TYPE_CHECKING:
    from ezdxf.document import Drawing

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
    _unknown_layers(asked, document, told)
    if told.faults:
        return found
    shown = strokes(document, unit * asked.scale, meanings.named, meanings.ignored, told)
    if any(fault.code == "entity" for fault in told.faults):
        return found
    _unknown_colours(asked, shown, told)
    by_meaning = sorted_out(shown, meanings, told, others)
    for meant, some in sorted(by_meaning.items(), key=lambda item: repr(item[0])):
        if meant.kind in OPEN:
            found.strokes[meant] = some
        else:
            found.contours[meant] = contours(some, asked.join, told)
    return found


def layers_of(data: bytes) -> dict[str, str]:
    """Each layer of a drawing that has curves, with what it means by its name, or is likely to mean.

    Raises DesignError for what is no DXF drawing.
    """
    from mechwright.drawings.guess import guesses
    from mechwright.drawings.opened import opened
    from mechwright.drawings.shown import strokes
    from mechwright.drawings.units import unit_of

    told, asked = Told(), Asked()
    document = opened(data)
    meanings = Meanings(asked, unit_of(document, asked.units, told), told)
    by_layer: dict[str, list[Stroke]] = {}
    for stroke in strokes(document, 1.0, meanings.named, lambda *_: False, told):
        by_layer.setdefault(stroke.layer, []).append(stroke)
    known = {
        layer: meant
        for layer in by_layer
        if (meant := meanings.of(layer, by_layer[layer][0].colour)) is not None
    }
    rest = {layer: some for layer, some in by_layer.items() if layer not in known}
    words = guesses(rest, outlined=any(meant.kind == "outline" for meant in known.values())) if rest else {}
    return {layer: layer.replace("_", " ") if layer in known else words[layer] for layer in by_layer}


def _unknown_layers(asked: Asked, document: "Drawing", told: Told) -> None:
    """Refuse a layer that is named and is not there: a slip of the pen would cut it otherwise."""
    drawn = {str(one.dxf.layer) for one in document.entitydb.values() if one.dxf.hasattr("layer")}
    layers = drawn | {str(one.dxf.name) for one in document.layers}
    known = {name.lower() for name in layers}
    for name, _ in asked.layers:
        if not is_colour(name) and name.lower() not in known:
            said = f"there is no layer {name!r}; it has: {', '.join(sorted(layers))}"
            told.fault("layer", said, "correct layers", "layers")


def _unknown_colours(asked: Asked, shown: Sequence[Stroke], told: Told) -> None:
    colours = {stroke.colour for stroke in shown}
    for name, _ in asked.layers:
        if is_colour(name) and int(name.split()[-1]) not in colours:
            has = ", ".join(map(str, sorted(colours))) or "none"
            told.fault("layer", f"nothing is drawn in {name}; there is: {has}", "correct layers", "layers")
