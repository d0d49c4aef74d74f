"""How a drawing is to be read: what a design file says of it."""

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from mechwright.drawings.fault import Told
from mechwright.drawings.meaning import Meaning, meaning
from mechwright.drawings.strokes import Stroke
from mechwright.errors import DesignError

Origin = Literal["drawing", "corner", "centre"]
"""Where the part's origin lies: where the drawing has it, at its lower left corner, or in its middle."""

_COLOUR = re.compile(r"colou?r (\d{1,3})", re.IGNORECASE)
"""Keys of colours, by AutoCAD's numbers."""


def is_colour(name: str) -> bool:
    """Whether a key of the layers stands for a colour.

    >>> is_colour("colour 3"), is_colour("Layer 3")
    (True, False)
    """
    return _COLOUR.fullmatch(name) is not None


@dataclass(frozen=True)
class Asked:
    """What is asked of a reading.

    Parameters
    ----------
    units
        As of :data:`mechwright.drawings.units.UnitName`.
    scale
        Size of the part over that of the drawing.
    join
        Gaps up to this are closed, mm.
    origin
        Where the part's origin lies.
    layers
        Names of layers, or colours as ``colour 3``, and what they mean.
    only
        Whether nothing but those layers is read.
    holes
        Diameters of circles as they are drawn, mm, and what they mean: a fit, a thread, a bore, ignore.
    """

    units: str = "drawing"
    scale: float = 1.0
    join: float = 0.01
    origin: Origin = "drawing"
    layers: tuple[tuple[str, str], ...] = ()
    only: bool = False
    holes: tuple[tuple[float, str], ...] = ()

    def key(self, layer: str, colour: int) -> str | None:
        """The key of the layers that stands for a layer, or else for a colour; None where none does."""
        for name, _ in self.layers:
            if name.lower() == layer.lower():
                return name
        for name, _ in self.layers:
            number = _COLOUR.fullmatch(name)
            if number and int(number[1]) == colour:
                return name
        return None


class Meanings:
    """What layers and colours mean: as the design says, or by their names."""

    def __init__(self, asked: Asked, unit: float, told: Told) -> None:
        self._asked, self._unit, self._told = asked, unit, told
        self._said: dict[str, Meaning | None] = {}

    def named(self, layer: str, colour: int) -> str:
        """Who says what it means: the ``design``, its ``name``, or nobody."""
        if self._asked.key(layer, colour) is not None:
            return "design"
        return "" if self.of(layer, colour) is None else "name"

    def of(self, layer: str, colour: int) -> Meaning | None:
        """What contours on a layer, in a colour, are; None where nobody says it."""
        key = self._asked.key(layer, colour)
        if key is None and self._asked.only:
            return Meaning("ignore")
        text = layer if key is None else dict(self._asked.layers)[key]
        where = "" if key is None else f"{key} = "
        if (found := where + text) not in self._said:
            self._said[found] = self._read(key, text)
        return self._said[found]

    def ignored(self, layer: str, colour: int) -> bool:
        """Whether it means that nothing is cut."""
        found = self.of(layer, colour)
        return found is not None and found.kind == "ignore"

    def _read(self, key: str | None, text: str) -> Meaning | None:
        try:
            found = meaning(text, self._unit)
        except DesignError as error:
            who = "layer " if key is None else f"layers, {key}: "
            self._told.fault("layer", f"{who}{error}", _REMEDY.format(key or text), "layers")
            return Meaning("ignore")
        if found is None and key is not None:
            said = f"layers, {key}: {text!r} means nothing"
            self._told.fault("layer", said, _REMEDY.format(key), "layers")
            return Meaning("ignore")
        return found


_REMEDY = (
    'say what it is: layers = {{ "{0}" = "through" }}, or "outline", "bore H7", "pocket 3.5", "M5", '
    '"engrave 0.2", "chamfer 0.5", "ignore"'
)


def sorted_out(
    strokes: Sequence[Stroke], meanings: Meanings, told: Told, others: Meaning | None = None
) -> dict[Meaning, list[Stroke]]:
    """The strokes by what they mean.

    One layer that nobody says the meaning of is the plate, where no other is: its outline and its openings.
    More of them are faults, unless ``others`` says what they are where no layer is the outline.
    """
    found: dict[Meaning, list[Stroke]] = {}
    open_: dict[str, list[Stroke]] = {}
    for stroke in strokes:
        meant = meanings.of(stroke.layer, stroke.colour)
        if meant is None:
            open_.setdefault(stroke.layer, []).append(stroke)
        else:
            found.setdefault(meant, []).append(stroke)
    if others is not None:
        if any(meant.kind == "outline" for meant in found):
            told.notes += [f"left out: layer {layer}" for layer in open_]
            return found
        for rest in open_.values():
            found.setdefault(others, []).extend(rest)
        return found
    if len(open_) == 1 and not any(meant.kind in {"outline", "through"} for meant in found):
        ((layer, rest),) = open_.items()
        told.note(f"layer {layer}: the outline, and what lies in it goes through")
        found[Meaning("through")] = rest
        return found
    from mechwright.drawings.guess import guesses

    words = guesses(open_, outlined=any(meant.kind == "outline" for meant in found)) if open_ else {}
    told.likely |= words
    for layer, rest in open_.items():
        curves = "1 curve" if len(rest) == 1 else f"{len(rest)} curves"
        said = f"layer {layer} has {curves}, and nothing says what it means"
        remedy = (
            f'add to [parameters.layers]: {toml_key(layer)} = "{words[layer]}"; or another meaning: '
            '"through", "bore H7", "pocket 3.5", "M5", "engrave 0.2", "chamfer 0.5", "ignore"'
        )
        told.fault("layer", said, remedy, "layers")
    return found


def toml_key(layer: str) -> str:
    """The name of a layer as a key in quotes."""
    return json.dumps(layer, ensure_ascii=False)
