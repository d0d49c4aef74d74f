"""What a print takes: filament by mass, metal rods, inserts, screws, reamers and taps."""

from collections import Counter
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


def bill_lines(job: PrintJob) -> list[BillLine]:
    """All lines: filament, rods, inserts, tools for what is done after printing, and bought parts."""
    total = sum(job.masses[one.part.name] * copies(one.part) for one in job.parts)
    lines = [
        BillLine(
            "filament",
            1,
            job.printer.material.title,
            total,
            f"{job.settings.walls} lines, {job.settings.skins} full layers, "
            f"infill {100 * job.settings.infill:g} %",
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
    inserts: Counter[str] = Counter()
    screws: Counter[str] = Counter()
    tools: dict[str, list[str]] = {}
    for one in job.parts:
        for hole in one.made.holes:
            if hole.insert is not None:
                inserts[hole.insert.name] += copies(one.part)
            elif hole.kind == "screw":
                screws["screw through, with nut"] += copies(one.part)
            elif hole.operation:
                tools.setdefault(hole.operation, []).append(f"{hole.part} {hole.name}")
    lines += [BillLine("insert", count, name) for name, count in inserts.items()]
    lines += [BillLine("screw", count, name) for name, count in screws.items()]
    lines += [BillLine("tool", 1, name, 0.0, ", ".join(where)) for name, where in tools.items()]
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
