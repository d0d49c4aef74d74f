"""The gallery of a synthesis: one page with a moving picture of each design and what it is compared by."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.finding import Finding
from mechwright.contracts.motion import Scalar
from mechwright.contracts.synthesis import Candidate, Reason
from mechwright.contracts.target import Target
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
    candidates: Sequence[Candidate[Any]],
    mechanisms: Sequence[Mechanism],
    minutes: bool = False,
    targets: Sequence[Target] = (),
) -> list[Shown]:
    """The designs with their figures and pictures; with ``minutes`` those on the mill as well.

    ``targets`` are the places that were asked for; the pictures show them.
    """
    rows = [merits(one, mechanism, minutes) for one, mechanism in zip(candidates, mechanisms, strict=True)]
    best = set(best_of(rows).tolist())
    return [
        Shown(mechanism.design.name, row, number in best, moving(mechanism, asked_of(one, targets)))
        for number, (row, one, mechanism) in enumerate(zip(rows, candidates, mechanisms, strict=True))
    ]


def asked_of(candidate: Candidate[Any], targets: Sequence[Target]) -> Array:
    """The places that were asked for, (k, 3) in the frame of a design, mm.

    A design with its pivot in the origin says by its figures ``pivot_x`` and ``pivot_y`` where that stands.
    """
    places = np.array([(*one.place, 0.0)[:3] for one in targets], dtype=float).reshape(-1, 3)
    pivot = [candidate.figures[name].value for name in ("pivot_x", "pivot_y") if name in candidate.figures]
    found: Array = places - (*pivot, 0.0) if len(pivot) == 2 else places
    return found


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
                dotted=any(design.picture.get("asked") for design in pictured if design.picture),
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
