"""The lines of a bill of materials.

Glossary
--------
made, bought
    Bodies of the mechanism; their numbers are 1 and on, and 101 and on.
stock
    Raw material cut to size for what is made, 201 and on. It becomes bodies and is none itself.
supply
    What is used up in fitting, and small parts that are not drawn, 301 and on; no bodies either.
electrical
    What the motor takes beside itself, 401 and on.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from types import MappingProxyType

from mechwright.contracts.part import Part
from mechwright.pipeline import Blank, Feedstock
from mechwright.standards.ordering import Order, order_of
from mechwright.standards.supply import Supply
from mechwright_cad.bill.items import FIRST, items
from mechwright_cad.bill.stock import Piece, built_up, count, finished, grade_of, pieces

ABSENT = "not in the assembly that is shown"
"""Note of a part that is made and stands in no place: the other size of a link, a flat pattern."""


@dataclass(frozen=True)
class Line:
    """A line of the bill; masses in g. Its fields are the columns, in their order."""

    item: int
    qty: int
    unit: str
    name: str
    kind: str
    designation: str = ""
    standard: str = ""
    material: str = ""
    grade: str = ""
    finish: str = ""
    stock: str = ""
    mass_each_g: float = 0.0
    mass_g: float = 0.0
    order: str = ""
    inch: str = ""
    file: str = ""
    drawing: str = ""
    note: str = ""


COLUMNS = tuple(field.name for field in fields(Line))


def lines_of(
    parts: Sequence[Part],
    masses: Mapping[str, float],
    blanks: Sequence[Blank],
    drawings: Mapping[str, Sequence[str]],
    order: Sequence[str] = (),
    notes: Mapping[str, str] = MappingProxyType({}),
    supplies: Sequence[Supply] = (),
    electrics: Sequence[Supply] = (),
    feedstock: Sequence[Feedstock] = (),
) -> list[Line]:
    """The whole bill.

    Parameters
    ----------
    parts
        Of the mechanism.
    masses
        Of one of each part by its name, g.
    blanks
        Plates as the process that cuts them has them; for the rest there is an allowance.
    drawings
        Names of files by name of part.
    order
        Names of parts in the order of assembly, in which items are counted.
    notes
        What there is to say of a part besides, by its name: the torque of a screw.
    supplies, electrics
        What is no body.
    feedstock
        What parts are built up from; they have its material, and the mass that it says.
    """
    numbered = items(parts, order)
    numbers = {part.name: number for number, those in numbered.items() for part in those}
    made = [part for those in numbered.values() for part in those if part.bought is None]
    return [
        *(_body(number, those, masses, drawings, notes, feedstock) for number, those in numbered.items()),
        *_stock([*pieces(made, blanks, feedstock), *built_up(made, feedstock)], numbers),
        *(_no_body("supply", number, one) for number, one in enumerate(supplies, FIRST["supply"])),
        *(_no_body("electrical", number, one) for number, one in enumerate(electrics, FIRST["electrical"])),
    ]


def _body(
    number: int,
    those: Sequence[Part],
    masses: Mapping[str, float],
    drawings: Mapping[str, Sequence[str]],
    more: Mapping[str, str],
    feedstock: Sequence[Feedstock],
) -> Line:
    """One line for equal parts, whatever they are called."""
    first = those[0]
    fed = next((one for one in feedstock if first.name in one.masses), None)
    mass = masses[first.name] if fed is None else fed.masses[first.name]
    qty = sum(count(part) for part in those)
    bought = first.bought
    notes = [bought.note] if bought is not None and bought.note else []
    notes += dict.fromkeys(more[part.name] for part in those if part.name in more)
    if fed is not None:
        notes.append(fed.note)
    elif first.free_form is not None:
        notes.append(f"process: {first.free_form.process}")
    if not all(part.instances for part in those):
        notes.append(ABSENT)
    order = Order("") if bought is None else order_of(bought)
    return Line(
        number,
        qty,
        "pcs",
        ", ".join(part.name for part in those),
        "made" if bought is None else "bought",
        "" if bought is None else bought.designation,
        "" if bought is None else bought.standard,
        first.material if fed is None else fed.material,
        fed.material if fed is not None else grade_of(first) if bought is None else order.grade,
        order.finish,
        finished(first) if bought is None else "",
        mass,
        mass * qty,
        order.text,
        order.inch,
        f"{first.name}.step",
        " ".join(name for part in those for name in drawings.get(part.name, ())) if bought is None else "",
        "; ".join(notes),
    )


def _stock(found: Sequence[Piece], numbers: Mapping[str, int]) -> list[Line]:
    return [
        Line(
            number,
            piece.count,
            piece.unit,
            f"stock for {', '.join(piece.parts)}",
            "stock",
            piece.designation,
            material=piece.material,
            grade=piece.grade,
            finish=piece.finish,
            mass_each_g=piece.mass,
            mass_g=piece.mass * piece.count,
            order=piece.order,
            inch=piece.inch,
            note=f"for item {_listed(numbers, piece.parts)}; {piece.note}",
        )
        for number, piece in enumerate(found, FIRST["stock"])
    ]


def _listed(numbers: Mapping[str, int], names: Sequence[str]) -> str:
    return ", ".join(str(number) for number in dict.fromkeys(numbers[name] for name in names))


def _no_body(kind: str, number: int, one: Supply) -> Line:
    """What is bought and is no body of the assembly."""
    return Line(
        number,
        one.qty,
        one.unit,
        one.name,
        kind,
        one.designation,
        one.standard,
        order=one.order,
        inch=one.inch,
        note=one.note,
    )
