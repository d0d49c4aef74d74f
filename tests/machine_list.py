"""What a bill of materials says of a machine: each body once, with its mass, and how one gets it."""

import csv
import io
import re
from collections.abc import Iterator, Mapping, Sequence

from machine_solids import Solid

from mechwright.contracts.part import Part
from mechwright_cad.assembly_order.plan import Plan

CSV, HTML = "bill-of-materials.csv", "bill-of-materials.html"

DENSITIES = {"aluminium": 2.7, "steel": 7.85, "brass": 8.5, "pom": 1.41, "stainless": 7.9}
"""g/cm³, from handbooks; within ``SPREAD``."""

SPREAD = 0.03
"""Share by which densities of one metal differ from handbook to handbook."""

ROUNDED = 0.006
"""Of masses in the list, g."""


def rows_of(files: Mapping[str, bytes]) -> list[dict[str, str]]:
    """Lines of bodies."""
    rows = csv.DictReader(io.StringIO(files[CSV].decode()))
    return [row for row in rows if row["kind"] in {"made", "bought"}]


def list_faults(
    parts: Sequence[Part], plan: Plan, files: Mapping[str, bytes], solids: Mapping[str, Sequence[Solid]]
) -> Iterator[str]:
    """Bodies that are missing, counted or weighed wrongly, and such as nobody could get."""
    if CSV not in files:
        yield f"{CSV} is not there"
        return
    rows = rows_of(files)
    for part in parts:
        lines = [row for row in rows if part.name in row["name"].split(", ")]
        count = sum(body.part.name == part.name for body in plan.bodies)
        if count and len(lines) != 1:
            yield f"{CSV}: {part.name} stands in {len(lines)} lines"
        elif count:
            yield from _line(part, lines[0], files, solids)
    for row in rows:
        named = row["name"].split(", ")
        count = sum(body.part.name in named for body in plan.bodies)
        if count and int(row["qty"]) != count:
            yield f"{CSV}: {row['qty']} of {row['name']}, and the assembly has {count}"
        if (
            abs(int(row["qty"]) * float(row["mass_each_g"]) - float(row["mass_g"]))
            > int(row["qty"]) * ROUNDED
        ):
            yield f"{CSV}: {row['name']} weigh {row['mass_g']} g in all, and {row['mass_each_g']} g each"
    yield from _sums(rows, files)


def _sums(rows: Sequence[Mapping[str, str]], files: Mapping[str, bytes]) -> Iterator[str]:
    said = re.search(r"(\d+) parts, ([\d.]+) (k?g)", files[HTML].decode())
    if said is None:
        yield f"{HTML} has no sum"
        return
    count, mass = sum(int(row["qty"]) for row in rows), sum(float(row["mass_g"]) for row in rows)
    told = float(said[2]) * (1000 if said[3] == "kg" else 1)
    if int(said[1]) != count or abs(told - mass) > 0.6 + ROUNDED * len(rows):
        yield f"{HTML}: {said[0]}, and its lines are {count} parts of {mass:.0f} g"


def _line(
    part: Part, row: Mapping[str, str], files: Mapping[str, bytes], solids: Mapping[str, Sequence[Solid]]
) -> Iterator[str]:
    kind = "made" if part.bought is None else "bought"
    if row["kind"] != kind:
        yield f"{CSV}: {part.name} is {row['kind']}"
    if row["file"] not in files:
        yield f"{CSV}: {part.name} has the file {row['file']}, which is not there"
    for name in row["drawing"].split():
        if name not in files:
            yield f"{CSV}: {part.name} has the drawing {name}, which is not there"
    wanted = {"plate": (".dxf",), "turned": (".dxf", ".pdf")}.get(part.kind, ())
    if part.bought is not None and not row["order"]:
        yield f"{CSV}: {part.name} is bought, and nothing is said of its order"
    for end in wanted if part.bought is None else ():
        if part.name + end not in files:
            yield f"{part.name} is made, and {part.name}{end} is not there"
    volume = sum(one.volume for one in solids.get(part.name, ())) / 1000
    if part.bought is not None and part.bought.mass is not None:
        least = most = part.bought.mass
    else:
        middle = volume * DENSITIES.get(part.material, 0.0)
        least, most = middle * (1 - SPREAD), middle * (1 + SPREAD)
    if part.material in DENSITIES and not least - ROUNDED <= float(row["mass_each_g"]) <= most + ROUNDED:
        yield f"{CSV}: {part.name} weighs {row['mass_each_g']} g, and its solid {least:.2f} to {most:.2f} g"
