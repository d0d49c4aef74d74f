"""Recesses of a drawing: pockets with islands, round ones, steps in steps, open at the rim."""

from collections.abc import Sequence
from dataclasses import dataclass

import shapely

from mechwright.drawings.contours import Contour
from mechwright.drawings.fault import Told
from mechwright.drawings.meaning import Meaning
from mechwright.drawings.nesting import lies_in, place_of, share
from mechwright.tolerances import TOLERANCES


@dataclass
class Recess:
    """A contour with what stands in it, and how deep it goes."""

    outer: Contour
    islands: list[Contour]
    meant: Meaning
    top: float = 0.0

    @property
    def depth(self) -> float:
        """Of its floor below the top face, mm."""
        assert self.meant.depth is not None  # noqa: S101 - a pocket has one
        return self.meant.depth

    @property
    def shape(self) -> shapely.Polygon:
        """What it takes, seen from above."""
        return shapely.Polygon(self.outer.loop.flatten(), [one.loop.flatten() for one in self.islands])


def recesses(meant: Meaning, contours: Sequence[Contour], told: Told) -> list[Recess]:
    """The recesses of one layer: what lies in a contour is an island, what lies in that a recess again."""
    order = sorted(contours, key=lambda one: -one.loop.area)
    shapes = [one.shape for one in order]
    found: dict[int, Recess] = {}
    for k, one in enumerate(order):
        around = []
        for j in range(k):
            if lies_in(shapes[k], shapes[j]):
                around.append(j)
            elif share(shapes[k], shapes[j]):
                told.fault(
                    "contour",
                    f"the contours of {one.name} and {order[j].name} cross each other at "
                    f"{place_of(shapes[k], shapes[j])}",
                    "draw them as one recess",
                )
        if len(around) % 2 == 0:
            found[k] = Recess(one, [], meant)
        else:
            found[max(j for j in around if j in found)].islands.append(one)
    return list(found.values())


def stacked(found: Sequence[Recess], thickness: float, plate: Contour, told: Told) -> None:
    """Say where each recess begins: at the top face, in the recess around it, or where its layer says."""
    shapes = [one.shape for one in found]
    rim = plate.shape
    for k, one in enumerate(found):
        name = one.outer.name
        if one.depth >= thickness - TOLERANCES.closure and not one.meant.top:
            told.fault(
                "feature",
                f"the recess of {name} is {one.depth:g} mm deep, in a plate of {thickness:g} mm",
                "draw what goes through on a layer of openings, or make the plate thicker",
                "thickness",
            )
        if one.depth > thickness + TOLERANCES.closure:
            told.fault(
                "feature", f"the recess of {name} leaves the plate", "make the plate thicker", "thickness"
            )
        if not share(shapes[k], rim):
            told.fault("contour", f"the recess of {name} lies beside the plate", "draw it on the plate")
        if one.meant.top is not None:
            one.top = one.meant.top
            if one.top >= one.depth:
                told.fault(
                    "layer",
                    f"the recess of {name} begins {one.top:g} mm deep and ends {one.depth:g} mm deep",
                    "let its floor lie deeper",
                    "layers",
                )
            continue
        for j, other in enumerate(found):
            if j == k or other.meant.top or not share(shapes[k], shapes[j]):
                continue
            _against(one, other, shapes[k], shapes[j], told)


def _against(one: Recess, other: Recess, shape: shapely.Polygon, around: shapely.Polygon, told: Told) -> None:
    if lies_in(shape, around):
        if one.depth <= other.depth:
            told.fault(
                "feature",
                f"the recess of {one.outer.name}, {one.depth:g} mm deep, lies in one of {other.depth:g} mm",
                "delete it, or let its floor lie deeper",
            )
        one.top = max(one.top, other.depth)
    elif not lies_in(around, shape):
        told.fault(
            "contour",
            f"the recesses of {one.outer.name} and {other.outer.name} cross each other at "
            f"{place_of(shape, around)}",
            "draw one inside the other, or side by side",
        )
