"""The gallery of a synthesis: one page with a moving picture of each design and what it is compared by."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mechwright.contracts.finding import Finding
from mechwright.contracts.motion import Scalar
from mechwright.contracts.synthesis import Candidate, Reason
from mechwright.output.templates import templates
from mechwright.scripting.mechanism import Mechanism
from mechwright.scripting.merits import SENSES, best_of, in_words, merits
from mechwright.scripting.moving import SHOWING, for_script, moving


@dataclass(frozen=True)
class Shown:
    """A design of the gallery: its name, what it is compared by, and whether no other beats it."""

    name: str
    merits: Mapping[str, Scalar]
    best: bool
    picture: Mapping[str, Any] | None


def shown(
    candidates: Sequence[Candidate[Any]], mechanisms: Sequence[Mechanism], minutes: bool = False
) -> list[Shown]:
    """The designs with their figures and pictures; with ``minutes`` those on the mill as well."""
    rows = [merits(one, mechanism, minutes) for one, mechanism in zip(candidates, mechanisms, strict=True)]
    best = set(best_of(rows).tolist())
    return [
        Shown(mechanism.design.name, row, number in best, moving(mechanism))
        for number, (row, mechanism) in enumerate(zip(rows, mechanisms, strict=True))
    ]


def gallery(
    name: str,
    title: str,
    told: str,
    reasons: Sequence[Reason],
    notes: Sequence[Finding],
    designs: Sequence[Shown],
) -> str:
    """The page, one file that needs no other.

    Parameters
    ----------
    name, title
        Of the requirement, and of the family.
    told, reasons, notes
        How many designs were found, why others are not given, and what the search says of itself.
    designs
        Best first, as the synthesis ranks them.
    """
    columns = [one for one in SENSES if any(one in design.merits for design in designs)]
    cells = [
        [in_words(design.merits[column]) if column in design.merits else "" for column in columns]
        for design in designs
    ]
    pictured = [design for design in designs if design.picture is not None]
    return (
        templates(SHOWING)
        .get_template("gallery.html")
        .render(name=name, title=title, told=told, reasons=reasons, notes=[one.message for one in notes],
                columns=[column.replace("_", " ") for column in columns],
                rows=list(zip(designs, cells, strict=True)), pictured=pictured,
                labels={one.name: _label(columns, cell) for one, cell in zip(designs, cells, strict=True)},
                moving=for_script([design.picture for design in pictured]))
    )  # fmt: skip


LABELLED = 3
"""Figures below a picture; the table has all."""


def _label(columns: Sequence[str], cells: Sequence[str]) -> list[str]:
    """What stands below a picture."""
    told = [f"{column.split('_')[-1]} {cell}" for column, cell in zip(columns, cells, strict=True) if cell]
    return told[:LABELLED]
