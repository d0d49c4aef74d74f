"""A shop from a few words: a known machine, mills by their diameters, sheets by size and material."""

import re
from dataclasses import dataclass
from difflib import get_close_matches

from mechwright.contracts.materials import material
from mechwright.designs.tables import read_table, unknown
from mechwright.errors import DesignError
from mechwright.units import convert
from mechwright_cam.shop.estimates import rigidity_of
from mechwright_cam.shop.machine import Machine, Preset, known_machines
from mechwright_cam.shop.tool import GRIP, Tool

SHANKS = (3.175, 6.0, 6.35, 8.0, 10.0, 12.0)
"""Shanks that small mills have, mm: the least that is as thick as the mill."""
WHOLE = {3.175: 38.0, 6.0: 50.0, 6.35: 50.0, 8.0: 60.0, 10.0: 72.0, 12.0: 83.0}
"""Whole lengths that are usual for these, mm."""
FLUTES = 5.0
"""Usual length of the flutes in diameters."""
NUTS = ((3.175, 16.0), (7.0, 19.0), (10.0, 28.0), (13.0, 34.0))
"""Largest shank of a collet and the diameter of its nut, mm: router, ER11, ER16, ER20."""

_SIZE = re.compile(
    r"\s*(?P<x>[\d.]+)\s*x\s*(?P<y>[\d.]+)\s*x\s*(?P<z>[\d.]+)\s*(?P<unit>mm|in)?\s+(?P<name>\S+)\s*"
)


@dataclass(frozen=True)
class Sheet:
    """A sheet in hand: length, width and thickness, mm, and its material."""

    length: float
    width: float
    thickness: float
    material: str


@dataclass(frozen=True)
class Bench:
    """A machine with what belongs to it."""

    model: str
    changes: dict[str, object]
    """Figures over those of the known machine."""
    machine: Machine
    preset: Preset
    control: str


def sheet_of(text: str) -> Sheet:
    """A sheet from a text such as ``200x150x6 acrylic``, in mm or with ``in`` behind the sizes.

    >>> sheet_of("200x150x6 acrylic")
    Sheet(length=200.0, width=150.0, thickness=6.0, material='acrylic')
    """
    found = _SIZE.fullmatch(text)
    if found is None:
        raise DesignError(
            f"--sheet: {text!r} should be length x width x thickness and a material, such as "
            '"200x150x6 acrylic"'
        )
    unit = found["unit"] or "mm"
    try:
        x, y, z = (convert(f"{found[axis]} {unit}", "mm") for axis in "xyz")
        name = material(found["name"]).name
    except (DesignError, ValueError) as error:
        raise DesignError(f"--sheet: {text!r}: {error}") from error
    if min(x, y, z) <= 0:
        raise DesignError(f"--sheet: {text!r}: each size should be above 0")
    return Sheet(x, y, z, name)


def bench(
    model: str, control: str, *, homing: bool | None, spindle: str, gap: float | None, board: float | None
) -> Bench:
    """The machine of a shop.

    Parameters
    ----------
    model
        Its name.
    control
        The control that it has; by default that which comes with it.
    homing
        Whether it has switches; by default as it comes.
    spindle
        Slowest and fastest speed, rev/min, as ``8000-24000``; by default those of the spindle it comes with.
    gap
        From the table to the nose of the spindle, mm, if measured.
    board
        Thickness of its spoil board, mm.

    Raises DesignError that names the option which is wrong or missing.
    """
    machines = known_machines()
    if model not in machines:
        near = get_close_matches(model, machines, n=3) or [one for one in machines if model and model in one]
        said = unknown(model, tuple(machines), "machine")
        raise DesignError(
            f"--machine: {said if not near else f'unknown machine {model!r}; did you mean {near[0]!r}?'}"
        )
    figures, preset = machines[model]
    changes: dict[str, object] = {}
    if spindle:
        changes |= _speeds(spindle)
    elif "spindle" in preset.unknown:
        raise DesignError(
            f"--machine: {figures['name']} comes without a spindle; give the speeds of yours: "
            "--spindle 10000-30000"
        )
    if homing is not None:
        changes["homing"] = "switches" if homing else "none"
    if gap is not None:
        changes["nose_to_table"] = gap
    if board is not None:
        changes["spoil_board"] = board
    if not (control or preset.control):
        raise DesignError(
            f"--machine: {figures['name']} reads {preset.reads}, for which no program is written here; if "
            "yours has another control, name it: --control grbl"
        )
    machine = read_table(Machine, {**figures, **changes}, "--machine", model)
    return Bench(model, changes, machine, preset, control or preset.control)


def _speeds(text: str) -> dict[str, object]:
    found = re.fullmatch(r"\s*(\d+)\s*-\s*(\d+)\s*", text)
    if found is None or int(found[1]) >= int(found[2]):
        raise DesignError(f"--spindle: {text!r} should be slowest and fastest speed in rev/min: 8000-24000")
    return {"spindle_min": int(found[1]), "spindle_max": int(found[2])}


def mills_of(text: str, of: Bench, sheets: list[Sheet]) -> tuple[Tool, ...]:
    """Mills from a text such as ``3.175,2,1``: diameters in mm, with flutes and their length if known.

    ``3.175:1:17`` has one flute 17 mm long. By default one flute, two where all sheets are of wood.
    """
    flutes = 2 if sheets and all(material(one.material).kind == "wood" for one in sheets) else 1
    found: dict[str, Tool] = {}
    for number, word in enumerate(filter(None, (one.strip() for one in text.split(","))), start=1):
        match = re.fullmatch(r"(?P<d>[\d.]+(?: ?in)?)(?::(?P<z>\d+))?(?::(?P<l>[\d.]+))?", word)
        if match is None:
            raise DesignError(
                f"--mills: {word!r} should be a diameter, such as 3.175, or 3.175:1:17 with flutes and "
                "their length"
            )
        try:
            size = convert(match["d"] if "in" in match["d"] else f"{match['d']} mm", "mm")
        except ValueError as error:
            raise DesignError(f"--mills: {word!r}: {error}") from error
        name = f"mill-{size:g}"
        if name in found:
            raise DesignError(f"--mills: {size:g} stands there twice; name it once")
        shank = next((one for one in SHANKS if one >= size - 1e-6), size)
        collet = of.machine.collet
        if collet is not None and shank > collet:
            raise DesignError(
                f"--mills: {size:g} has a shank of {shank:g} mm, and the collet of {of.machine.name} holds "
                f"{collet:g} at most; take a thinner mill, or give a larger collet in the machine's table"
            )
        whole = WHOLE.get(shank)
        long = float(match["l"]) if match["l"] else float(round(FLUTES * size))
        nut = next((nut for most, nut in NUTS if collet is not None and collet <= most), None)
        found[name] = read_table(
            Tool,
            {
                "name": name,
                "number": number,
                "kind": "end-mill",
                "diameter": size,
                "flutes": int(match["z"] or flutes),
                "flute_length": long,
                "shank_diameter": shank,
                **({} if whole is None or whole - GRIP < long else {"overall": whole}),
                **({} if nut is None else {"holder_diameter": nut}),
            },
            "--mills",
            name,
        )
    if not found:
        raise DesignError("--mills: names no mill; give diameters in mm, such as --mills 3.175,2,1")
    return tuple(found.values())


ZERO = {"switches": "homes by switches", "marks": "is homed by hand at marks", "none": "has no switches"}
"""How a machine finds its zero, in words."""


def remarks(of: Bench, tools: tuple[Tool, ...]) -> list[str]:
    """What to measure, and what is not known."""
    said = [f"class {rigidity_of(of.machine)}, {of.control}, {ZERO[of.machine.homing]}"]
    if of.machine.nose_to_table is None:
        said.append(
            "measure with Z fully up from the table to the nose of the spindle, and give it as "
            "nose_to_table: without it nobody can say whether the tools reach"
        )
    names = {"spindle": "speeds and power of the spindle", "homing": "whether it has switches"}
    unknown_ = [
        names.get(one, one)
        for one in of.preset.unknown
        if one != "spindle" or not of.changes.get("spindle_max")
    ]
    if unknown_:
        said.append(f"not published, and estimated here: {', '.join(unknown_)}")
    if of.preset.doubtful:
        said.append(
            f"of one owner or from memory: {', '.join(names.get(one, one) for one in of.preset.doubtful)}"
        )
    if tools:
        said.append("flutes and lengths of the mills are usual ones: correct them to yours")
    return said
