"""The lines of a bill of materials.

Glossary
--------
made, bought
    Bodies of the mechanism; their numbers are 1 and on, and 101 and on.
stock
    Raw material cut to size for what is made, 201 and on. It becomes bodies and is none itself.
supply
    What is used up in fitting, 301 and on; no bodies either.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields

from mechwright.build import Blank
from mechwright.contracts.part import Part
from mechwright_cad.bill.stock import count, finished, pieces

FIRST = {"made": 1, "bought": 101, "stock": 201, "supply": 301}
"""Kind of a line to the number of its first item."""

ABSENT = "not in the assembly that is shown"
"""Note of a part that is made and stands in no place: the other size of a link, a flat pattern."""

GREASE = "grease for plain bearings"


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
    stock: str = ""
    mass_each_g: float = 0.0
    mass_g: float = 0.0
    file: str = ""
    drawing: str = ""
    note: str = ""


COLUMNS = tuple(field.name for field in fields(Line))


def lines_of(
    parts: Sequence[Part],
    masses: Mapping[str, float],
    blanks: Sequence[Blank],
    drawings: Mapping[str, Sequence[str]],
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
    """
    order = sorted(parts, key=lambda part: min((i.z for i in part.instances), default=float("inf")))
    made = [
        Line(
            number,
            count(part),
            "pcs",
            part.name,
            "made",
            material=part.material,
            stock=finished(part),
            mass_each_g=masses[part.name],
            mass_g=masses[part.name] * count(part),
            file=f"{part.name}.step",
            drawing=" ".join(drawings.get(part.name, ())),
            note="" if part.instances else ABSENT,
        )
        for number, part in enumerate((p for p in order if p.bought is None), FIRST["made"])
    ]
    numbers = {line.name: line.item for line in made}
    return [
        *made,
        *_bought([part for part in order if part.bought is not None], masses),
        *_stock([part for part in order if part.bought is None], blanks, numbers),
        *_supply(parts),
    ]


def _bought(parts: Sequence[Part], masses: Mapping[str, float]) -> list[Line]:
    """One line for each designation, however many parts have it."""
    same: dict[str, list[Part]] = {}
    for part in parts:
        assert part.bought is not None  # noqa: S101 - asked of bought parts only
        same.setdefault(part.bought.designation, []).append(part)
    found = []
    for number, (designation, those) in enumerate(same.items(), FIRST["bought"]):
        first = those[0]
        bought = first.bought
        assert bought is not None  # noqa: S101 - as above
        qty = sum(count(part) for part in those)
        absent = [] if all(part.instances for part in those) else [ABSENT]
        found.append(
            Line(
                number,
                qty,
                "pcs",
                ", ".join(part.name for part in those),
                "bought",
                designation,
                bought.standard,
                first.material,
                mass_each_g=masses[first.name],
                mass_g=masses[first.name] * qty,
                file=f"{first.name}.step",
                note="; ".join([note for note in (bought.note,) if note] + absent),
            )
        )
    return found


def _stock(parts: Sequence[Part], blanks: Sequence[Blank], numbers: Mapping[str, int]) -> list[Line]:
    return [
        Line(
            number,
            piece.count,
            "pcs",
            f"stock for {', '.join(piece.parts)}",
            "stock",
            piece.designation,
            material=piece.material,
            mass_each_g=piece.mass,
            mass_g=piece.mass * piece.count,
            note=f"for item {', '.join(str(numbers[name]) for name in piece.parts)}; {piece.note}",
        )
        for number, piece in enumerate(pieces(parts, blanks), FIRST["stock"])
    ]


def _supply(parts: Sequence[Part]) -> list[Line]:
    runs = any(part.turned is not None or part.bought is not None for part in parts)
    note = "on every pin, shaft and bush that turns; not on parts of POM"
    return [Line(FIRST["supply"], 1, "as needed", GREASE, "supply", note=note)] if runs else []
