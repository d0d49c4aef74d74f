"""Numbers of items: equal parts share one, and they count up in the order of assembly."""

from collections.abc import Hashable, Sequence

from mechwright.contracts.part import Part

FIRST = {"made": 1, "bought": 101, "stock": 201, "supply": 301, "electrical": 401}
"""Kind of a line to the number of its first item."""


def items(parts: Sequence[Part], order: Sequence[str]) -> dict[int, tuple[Part, ...]]:
    """Number to its parts, made ones first.

    Parameters
    ----------
    parts
        Of the mechanism.
    order
        Names of parts in the order of assembly; the rest come after them.
    """
    place = {name: number for number, name in reversed(list(enumerate(order)))}
    found: dict[int, tuple[Part, ...]] = {}
    for kind in ("made", "bought"):
        same: dict[Hashable, list[Part]] = {}
        for part in sorted(parts, key=lambda one: place.get(one.name, len(order))):
            if (part.bought is not None) == (kind == "bought"):
                same.setdefault((_form(part), bool(part.instances)), []).append(part)
        found |= {number: tuple(those) for number, those in enumerate(same.values(), FIRST[kind])}
    return found


def numbers_of(parts: Sequence[Part], order: Sequence[str]) -> dict[str, int]:
    """Name of a part to the number of its item."""
    return {part.name: number for number, those in items(parts, order).items() for part in those}


def _form(part: Part) -> Hashable:
    """What is equal of parts that are one item. A mirror image is none; a solid is equal to itself alone."""
    if part.bought is not None:
        return part.bought.designation
    if part.turned is not None:
        return part.turned, part.material
    if part.outline is None:
        return part.name
    return part.outline, part.thickness, part.material, part.features, part.details
