"""Proving a program against a drawing, without a design file."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from mechwright.contracts.materials import MATERIALS
from mechwright.designs.bounded_toml import DEEP, toml_of
from mechwright.errors import DesignError, PluginError, ToolError
from mechwright.plugins.host import Host
from mechwright_cam.commands.drawing import read_drawing
from mechwright_cam.controls.contract import Control
from mechwright_cam.proof.rules import Rule
from mechwright_cam.proof.scene import Scene
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.library import Library, load_library
from mechwright_cam.shop.table import CamTable
from mechwright_cam.shop.tool import Tool

HOLDS: dict[str, dict[str, Any]] = {
    "tabs": {"method": "tabs", "tab_places": "found"},
    "bore": {"method": "bore"},
    "vacuum": {"method": "none", "bed": "vacuum"},
    "tape": {"method": "none", "bed": "tape"},
    "vice": {"method": "vice"},
    "clamps": {"method": "none"},
}
"""What ``--hold`` may say, and the settings that it stands for."""
GRIPPED = ("front", "rear")
"""Edges of the stock that a vice grips, unless ``--set stock.finished`` names others."""
USUAL_MATERIAL, USUAL_HOLD = "aluminium", "tabs"
"""Where nothing is said."""
SETTINGS = Path("--set")
"""Where settings come from, for messages; files that they name lie in or below the folder at hand."""
SAID_ELSEWHERE = {
    "tools": "say the cutters with --tools",
    "tool_library": "say it with --library",
    "nest": "a drawing holds one part",
    "operations": "they plan programs, and none is planned here",
}
"""Keys of ``[cam]`` that would change nothing here, and what to do instead."""


def job_of(
    dxf: Path,
    thickness: float,
    tools: str,
    *,
    library: Path | None,
    control: str,
    material: str,
    hold: str,
    stock: str,
    units: str,
    layers: Sequence[str],
    changes: Sequence[str],
) -> Job:
    """The part of a drawing in its stock, held, with the tools that are in the machine.

    ``tools`` are named in ``library``, or in the built-in one. Raises DesignError or ToolError that names the
    option, OutputError where the library cannot be read.
    """
    material, hold = material or USUAL_MATERIAL, hold or USUAL_HOLD
    if not 0 < thickness <= 500:
        raise DesignError(f"--thickness: {thickness:g} mm is no plate; above 0, and 500 mm at most")
    if material not in MATERIALS:
        raise DesignError(f"--material: {material!r} is not known; one of: {', '.join(MATERIALS)}")
    if hold not in HOLDS:
        raise DesignError(f"--hold: {hold!r} is not known; one of: {', '.join(HOLDS)}")
    table: dict[str, Any] = {"hold": dict(HOLDS[hold])}
    if control:
        table["control"] = control
    if stock:
        table["stock"] = _size(stock)
    for change in changes:
        _set(table, change)
    if hold == "vice":
        table.setdefault("stock", {}).setdefault("finished", list(GRIPPED))
    if hold == "clamps" and not table["hold"].get("toe_clamps"):
        raise DesignError(
            "--hold: the places of clamps have to be known: add --set hold.toe_clamps=[[x0, y0, x1, y1, top]]"
        )
    cam = CamTable()
    said = cam.read(table, SETTINGS)
    (part,) = cam.parts(said, [read_drawing(dxf, thickness, material, units, layers)], SETTINGS)
    settings, shop = said.of(part.name), load_library(library)
    for key, names in (("cutting", [*settings.cutting]), ("measured.lengths", [*settings.measured.lengths])):
        for name in names:
            _named(shop, name, f"--set: {key}")
    cutters = _tools(tools, shop.cutting(settings.cutting).measured(settings.measured.lengths))
    if settings.hold.method != "tabs" or settings.hold.tab_places == "planned":
        return replace(make_job(part, settings, cutters), planned=False)
    # Tabs are found in the program: none are laid.
    free = settings.model_copy(update={"hold": settings.hold.model_copy(update={"method": "none"})})
    job = make_job(part, free, cutters)
    held = job.settings.hold.model_copy(update={"method": settings.hold.method})
    return replace(job, settings=job.settings.model_copy(update={"hold": held}), planned=False)


def drawn_scene(text: str | Mapping[str, str], job: Job, host: Host) -> tuple[Scene, list[Rule]]:
    """The program with its job and control, and the rules; raises PluginError for an unknown control."""
    try:
        reader = host.get(Control, job.settings.control)
    except PluginError:
        known = ", ".join(sorted(host.of(Control)))
        raise PluginError(f"--control: {job.settings.control!r} is not known; one of: {known}") from None
    return Scene(text, job, reader), host.all(Rule)


def _tools(text: str, library: Library) -> tuple[Tool, ...]:
    """The cutters of a list ``1=mill-6,2=drill-5``: T number and name in the library."""
    found: dict[int, Tool] = {}
    for item in text.split(","):
        number, sign, name = (word.strip() for word in item.partition("="))
        if not sign or not number.isascii() or not number.isdecimal() or not 1 <= int(number[:9]) <= 9999:
            raise ToolError(f"--tools: {item.strip()!r} is no tool; write T number and name, as in 1=mill-6")
        if int(number) in found:
            raise ToolError(f"--tools: T{int(number)} is named twice")
        found[int(number)] = _named(library, name, "--tools").model_copy(update={"number": int(number)})
    return tuple(found.values())


def _named(library: Library, name: str, where: str) -> Tool:
    """The cutter of a name; raises ToolError that begins with ``where``."""
    try:
        return library.get(name)
    except ToolError as error:
        raise ToolError(f"{where}: {error}") from error


def _size(text: str) -> dict[str, float]:
    """Length and width of the plate of a text ``120x80``, mm, or a margin."""
    try:
        numbers = [float(word) for word in text.lower().replace("×", "x").split("x")]
    except ValueError:
        numbers = []
    if len(numbers) == 1:
        return {"margin": numbers[0]}
    if len(numbers) == 2:
        return {"length": numbers[0], "width": numbers[1]}
    raise DesignError(f"--stock: {text!r} is no plate; write its size in X and Y, as in 120x80, or a margin")


def _set(table: dict[str, Any], change: str) -> None:
    """Lay one KEY=VALUE over a table; the value is one of TOML, or a word."""
    key, sign, value = change.partition("=")
    path = [word.strip() for word in key.split(".")]
    if not sign or not all(path):
        raise DesignError(f"--set: {change!r} is no setting; write KEY=VALUE, as in hold.tabs=3")
    if len(path) > DEEP:
        raise DesignError(f"--set: a key of {len(path):,} parts; a key has at most {DEEP}")
    setting = path[2] if path[0] == "part" and len(path) > 2 else path[0]
    if setting in SAID_ELSEWHERE:
        raise DesignError(f"--set: {setting}: {SAID_ELSEWHERE[setting]}")
    try:
        said: Any = toml_of(f"value = {value}", "--set")["value"]
    except DesignError:
        said = value.strip()
    for word in path[:-1]:
        inner = table.setdefault(word, {})
        if not isinstance(inner, dict):
            raise DesignError(f"--set: {change!r}: {word} is no table")
        table = inner
    table[path[-1]] = said
