"""What a print takes: filament by mass, metal rods, inserts, screws, reamers and taps."""

from collections.abc import Sequence
from dataclasses import dataclass

from mechwright.output.csv_text import csv_text
from mechwright_print.job.print_job import PrintJob, copies


@dataclass(frozen=True)
class BillLine:
    """A line of the bill: what kind of thing, how many, its name, its mass in g (0 where it is not known)."""

    kind: str
    qty: int
    name: str
    mass_g: float = 0.0
    note: str = ""


@dataclass(frozen=True)
class Fitting:
    """What a printed hole takes later: its kind, how it is ordered, how many, and in which parts."""

    kind: str
    name: str
    qty: int
    unit: str
    parts: tuple[str, ...]
    where: tuple[str, ...]


def fittings(job: PrintJob) -> list[Fitting]:
    """Inserts, bushes, screws with nuts, then tools, each kind once."""
    found: dict[tuple[str, str], list[tuple[str, str, int]]] = {}
    for one in job.parts:
        for hole in one.made.holes:
            if hole.insert is not None:
                key = ("insert", hole.insert.name)
            elif hole.bush is not None:
                key = ("bush", hole.bush.bought.designation)
            elif hole.kind == "screw":
                key = ("screw", "screw through, with nut")
            elif hole.operation:
                key = ("tool", hole.operation)
            else:
                continue
            found.setdefault(key, []).append((hole.part, hole.name, copies(one.part)))
    return [
        Fitting(
            kind,
            name,
            1 if kind == "tool" else sum(count for _, _, count in where),
            "tool" if kind == "tool" else "pcs",
            tuple(dict.fromkeys(part for part, _, _ in where)),
            tuple(f"{part} {hole}" for part, hole, _ in where),
        )
        for (kind, name), where in sorted(found.items(), key=lambda one: _ORDER.index(one[0][0]))
    ]


_ORDER = ("insert", "bush", "screw", "tool")
"""Of the kinds on the bill."""


def laid_down(job: PrintJob) -> str:
    """How the filament is laid down, in a few words."""
    settings = job.settings
    return f"{settings.walls} lines, {settings.skins} full layers, infill {100 * settings.infill:g} %"


def bill_lines(job: PrintJob) -> list[BillLine]:
    """All lines: filament, rods, inserts, tools for what is done after printing, and bought parts."""
    total = sum(job.masses[one.part.name] * copies(one.part) for one in job.parts)
    lines = [
        BillLine(
            "filament",
            1,
            job.printer.material.title,
            total,
            laid_down(job),
        )
    ]
    lines += [
        BillLine(
            "printed",
            copies(one.part),
            one.part.name,
            job.masses[one.part.name] * copies(one.part),
            "on its top face" if one.on_top else "",
        )
        for one in job.parts
    ]
    for part in job.metal:
        assert part.turned is not None  # noqa: S101 - metal parts are turned
        lines.append(
            BillLine(
                "rod",
                len(part.instances),
                part.name,
                0.0,
                f"{part.material} rod ⌀{part.turned.greatest:g} x {part.turned.length:g} mm",
            )
        )
    lines += [BillLine(one.kind, one.qty, one.name, 0.0, ", ".join(one.where)) for one in fittings(job)]
    lines += [
        BillLine("bought", len(part.instances), part.bought.designation or part.name)
        for part in job.bought
        if part.bought is not None
    ]
    return lines


def bill_csv(lines: Sequence[BillLine]) -> str:
    """The lines under the names of their columns; masses to a hundredth of a gram."""
    rows = ([one.kind, one.qty, one.name, f"{one.mass_g:.2f}", one.note] for one in lines)
    return csv_text([("kind", "qty", "name", "mass_g", "note"), *rows])
