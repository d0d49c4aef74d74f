"""Raw stock of made parts: plates and round bars as dealers have them, filament, and what they weigh."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from mechwright.contracts.materials import material
from mechwright.contracts.part import Part
from mechwright.contracts.turned import Step, Turned
from mechwright.errors import DesignError
from mechwright.pipeline import Blank, Feedstock
from mechwright.standards.stock import (
    CLEAN_UP,
    bar_for,
    bar_stock,
    inch_size,
    is_sold,
    plate_for,
    plate_stock,
)

ALONG = 3.0
"""What a round bar is longer than the part at each end, mm."""

AROUND = 11.0
"""What a plate has more all round, mm, where no process says: a cutter of 8 mm, and 3 mm that hold."""

BY_RULE = "cut size with an allowance for cutting and holding"
BY_SHEET = "as the setup sheet has it"


@dataclass(frozen=True)
class Piece:
    """A piece of stock to saw off.

    Parameters
    ----------
    parts, count
        What is made of it, and how many pieces.
    designation
        Its form and size, mm.
    grade, finish
        Designation of the material, and the outside that it comes with.
    order, inch
        How it is ordered, and what is sold in the US.
    mass
        Of one, g.
    unit
        Of what ``count`` counts.
    """

    parts: tuple[str, ...]
    count: int
    material: str
    designation: str
    grade: str
    finish: str
    order: str
    inch: str
    mass: float
    note: str
    unit: str = "pcs"


def finished(part: Part) -> str:
    """The finished size of a made part in a few words; empty for one that is neither plate nor turned."""
    if part.turned is not None:
        return f"round {part.turned.greatest:.4g} x {part.turned.length:.4g}"
    if part.outline is None:
        return ""
    x0, y0, x1, y1 = part.outline.bounds
    return f"plate {x1 - x0:.1f} x {y1 - y0:.1f} x {part.thickness:g}"


def grade_of(part: Part) -> str:
    """The designation of what a made part is made of; empty for a solid of which nothing is said."""
    if part.turned is not None:
        return material(part.material).grades.bar
    known = part.outline is not None or part.free_form is not None
    return material(part.material).grades.plate if known else ""


def pieces(
    parts: Sequence[Part], blanks: Sequence[Blank], feedstock: Sequence[Feedstock] = ()
) -> Iterator[Piece]:
    """What is sawn off: plates as a process has them, then the rest of the parts in their order.

    A part that is neither turned nor a plate has no stock of its own: it may be printed or cast.
    """
    for blank in blanks:
        yield _plate(blank.parts, blank.count, blank.material, blank.size, BY_SHEET)
    done = {name for blank in blanks for name in blank.parts} | {
        name for one in feedstock for name in one.masses
    }
    for part in parts:
        if part.name not in done:
            piece = _piece(part)
            if piece is not None:
                yield piece


def built_up(parts: Sequence[Part], feedstock: Sequence[Feedstock]) -> Iterator[Piece]:
    """What is used up by mass for all copies of the parts that are built up."""
    for one in feedstock:
        those = [part for part in parts if part.name in one.masses]
        mass = sum(one.masses[part.name] * count(part) for part in those)
        names = tuple(part.name for part in those)
        designation, order = f"filament {one.material}", f"{one.order}, {math.ceil(mass)} g"
        yield Piece(
            names, 1, one.material, designation, one.material, "", order, "", mass, one.note, unit="as needed"
        )


def count(part: Part) -> int:
    """How many are made or bought: one of a part that stands in no place."""
    return max(1, len(part.instances))


def _piece(part: Part) -> Piece | None:
    if part.turned is not None:
        return _bar(part, part.turned)
    if part.outline is None:
        return None
    x0, y0, x1, y1 = part.outline.bounds
    size = (x1 - x0 + 2 * AROUND, y1 - y0 + 2 * AROUND, part.thickness)
    return _plate((part.name,), count(part), part.material, size, BY_RULE)


def _plate(
    names: tuple[str, ...], number: int, name: str, size: tuple[float, float, float], note: str
) -> Piece:
    """A piece of plate for parts of a thickness: of that one where it is sold, else of the next one."""
    x, y, z = size
    thick, facing = z, ""
    if not is_sold(z, name):
        try:
            thick = plate_for(z, name)
            facing = f"; face it to {z:g}: plates of {z:g} mm are not sold"
        except DesignError as error:
            facing = f"; {error}"
    grades = material(name).grades
    sawn = f"{math.ceil(x)} x {math.ceil(y)}"
    inch = inch_size(plate_stock(name).inch, z)
    return Piece(
        names,
        number,
        name,
        f"plate {x:.1f} x {y:.1f} x {thick:g}",
        grades.plate,
        f"{_SURFACES.get(name, 'as rolled')}, sawn",
        f"{grades.plate}, plate {thick:g}, sawn {sawn} mm",
        f"{grades.us_plate}, plate {_inches(inch.name, inch.size, z)}" if inch else "",
        _grams(x * y * thick, name),
        f"{note}{facing}",
    )


_SURFACES = {
    "pom": "as extruded", "polycarbonate": "as extruded", "hdpe": "as pressed", "acrylic": "as cast",
    "plywood": "sanded", "mdf": "sanded", "5083": "both sides milled",
}  # fmt: skip
"""Of plates that no mill has rolled."""


def _bar(part: Part, turned: Turned) -> Piece:
    """A piece of round bar; where the widest step of the part has no fit its outside stays as it is drawn."""
    name, widest = part.material, turned.greatest
    across = bar_for(widest, name, turned=not _as_bought(turned, bar_stock(name).drawn))
    kept = across == widest
    along = math.ceil(round(turned.length + 2 * ALONG, 3))
    stock, grades = bar_stock(name), material(name).grades
    drawn = f", drawn {stock.drawn}" if stock.drawn else ""
    inch = inch_size(stock.inch, widest + CLEAN_UP)
    return Piece(
        (part.name,),
        count(part),
        name,
        f"round bar {across:g} x {along}",
        grades.bar,
        f"drawn {stock.drawn}, sawn" if stock.drawn else "as extruded, sawn",
        f"{grades.bar}{drawn}, round {across:g}, sawn {along} mm",
        f"{grades.us_bar}, round {_inches(inch.name, inch.size, widest)}" if inch else "",
        _grams(math.pi / 4 * across**2 * along, name),
        f"{BY_RULE}; the outside of {widest:g} mm stays as drawn" if kept else BY_RULE,
    )


def _as_bought(turned: Turned, drawn: str) -> bool:
    """Whether the widest steps have no cone, and no fit but the class to which the bar is drawn."""
    widest: list[Step] = [one for one in turned.steps if max(one.foot, one.diameter) == turned.greatest]
    return all((one.fit is None or one.fit.name == drawn) and one.start is None for one in widest)


def _inches(name: str, size: float, wanted: float) -> str:
    """A size by the inch, with what is taken off."""
    return f"{name} in ({size:.4g} mm)" + ("" if abs(size - wanted) < 0.01 else f", cut down to {wanted:.4g}")


def _grams(volume: float, name: str) -> float:
    return volume * material(name).density / 1000
