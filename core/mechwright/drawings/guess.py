"""What layers without a meaning are likely to be, from their curves alone."""

from collections.abc import Mapping, Sequence

from mechwright.drawings.contours import Contour, contours
from mechwright.drawings.fault import Told
from mechwright.drawings.strokes import Stroke

JOIN = 0.01
"""Gaps up to this are closed while it is looked, mm."""


def guesses(layers: Mapping[str, Sequence[Stroke]], *, outlined: bool = False) -> dict[str, str]:
    """Layer to the word for it.

    The layer with the largest contour is the outline, unless another is (``outlined``); one of circles alone
    is of bores; other closed contours go through; curves that do not close are ignored.
    """
    found = {name: _closed(strokes) for name, strokes in layers.items()}
    sizes = {name: max((one.shape.area for one in some), default=0.0) for name, some in found.items()}
    largest = max(sizes, key=lambda name: sizes[name], default="")
    words = {}
    for name, some in found.items():
        if not some:
            words[name] = "ignore"
        elif name == largest and not outlined:
            words[name] = "outline"
        elif all(one.circle is not None for one in some):
            words[name] = "bore"
        else:
            words[name] = "through"
    return words


def _closed(strokes: Sequence[Stroke]) -> list[Contour]:
    """The contours of a layer; none where some of its curves do not close."""
    told = Told()
    found = contours(strokes, JOIN, told)
    return [] if told.faults else found
