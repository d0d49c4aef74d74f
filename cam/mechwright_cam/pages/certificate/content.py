"""The content of a certificate: the job and its moves as plain numbers, lengths in µm."""

from collections.abc import Sequence
from itertools import groupby
from typing import Any

import numpy as np

from mechwright.contracts.part import Pocket
from mechwright.designs.files import digest_of
from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.reading import Kind, Run
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.machining import Machined
from mechwright_cam.pages.certificate.rings import MICRONS, rings
from mechwright_cam.proof.bands import bands
from mechwright_cam.proof.entry_rules import steepest
from mechwright_cam.proof.target_shape import TAB_SLACK, play
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.tool import MILLS, Tool

FORMAT = "mechwright certificate 1"
"""Its first line, with the number of its form."""
STILL = 0.5
"""Moves that go less far than this are none, µm."""


def certificate(
    item: Machined, control: str, suffix: str, bound: Sequence[tuple[str, str, str]] = ()
) -> dict[str, Any]:
    """What a certificate says of one program; ``bound`` is what else it is of: kind, name and SHA-256."""
    job = item.job
    return {
        "format": FORMAT,
        "name": item.program.name,
        "control": control,
        "files": [{"name": stem + suffix, "sha256": digest_of(text)} for stem, text in item.files.items()],
        "bound": [{"what": what, "name": name, "sha256": digest} for what, name, digest in bound],
        "unchecked": unchecked(job),
        "part": _part(job),
        "stock": [_um(edge) for edge in job.stock],
        "hold": _hold(job),
        "tools": {str(tool.number): _tool(tool, item) for tool in item.program.tools},
        "machine": _machine(job),
        "limits": _limits(job),
        "moves": _moves(item.scene.run),
    }


def unchecked(job: Job) -> list[str]:
    """What of a job a certificate does not hold, so that its checker cannot say anything."""
    settings = job.settings
    round_ = any(tool.nose > 0 for tool in job.tools if tool.kind in MILLS)
    fillets = any(isinstance(f, Pocket) and f.floor_radius > 0 for f in job.features)
    found = (
        (job.side == "underside", "a plate that has been turned over"),
        (bool(job.details), "broken edges, threads and marks"),
        (fillets, "fillets of floors"),
        (round_, "mills with a round end"),
        (settings.compensation != "computer", "cutter compensation (G41, G42)"),
        (bool(settings.more_offsets), "several work offsets"),
        (any(tab.ramped for tab in job.tabs), "ramped tabs"),
        (settings.hold.tab_places == "found" and settings.hold.method == "tabs", "tabs that are not planned"),
    )
    return [what for there, what in found if there]


def _um(value: float) -> float:
    """A length in µm, to a tenth."""
    return round(value * MICRONS, 1) + 0.0  # no zero has a sign


def _part(job: Job) -> dict[str, Any]:
    """Levels from the top down, each with the number of its cross-section, and the cross-sections."""
    found = bands(job, tuple(tab.top + TAB_SLACK for tab in job.tabs))
    shapes = {band.section: band.keep for band in found}
    numbers = {section: place for place, section in enumerate(shapes)}
    return {
        "name": job.part.name,
        "thickness": _um(job.thickness),
        "origin": [_um(value) for value in job.origin],
        "sections": [rings(shape) for shape in shapes.values()],
        "levels": [[_um(band.top), _um(band.bottom), numbers[band.section]] for band in found],
    }


def _hold(job: Job) -> dict[str, Any]:
    """What holds the part: its kind, tabs, and prisms that no tool may meet, each from a stop on."""
    prisms = [{"top": _um(jaw.top), "rings": rings(jaw.shape), "stop": 0} for jaw in job.jaws]
    prisms += [{"top": _um(toe.top), "rings": rings(toe.shape), "stop": 0} for toe in job.toes]
    if job.clamp is not None:
        centre, radius = [_um(value) for value in job.clamp.centre], _um(job.clamp.diameter / 2)
        ends = [[centre[0] + side * radius, centre[1], *centre, 1] for side in (1, -1)]
        prisms.append({"top": _um(job.clamp.top), "rings": [ends], "stop": 1})
    hold = job.settings.hold
    return {
        "method": hold.bed or hold.method,
        "tabs": [{"top": _um(tab.top), "rings": rings(tab.shape)} for tab in job.tabs],
        "prisms": prisms,
    }


def _tool(tool: Tool, item: Machined) -> dict[str, Any]:
    """A tool as a profile: its cone and holder, with what its edges may bear."""
    job = item.job
    shape, data = cutter(tool), tool.cutting.get(job.part.material)
    cone = float(shape.slope)
    coolants = {section.tool.number: section.coolant for section in item.program.sections}
    return {
        "name": tool.name,
        "kind": str(tool.kind),
        "radius": _um(tool.radius),
        "tip": _um(float(shape.tip)) if np.isfinite(cone) else _um(tool.radius),
        "slope": round(cone, 9) if np.isfinite(cone) else None,
        "flutes": tool.flutes,
        "flute_length": _um(tool.flute_length),
        "stick_out": None if tool.stick_out is None else _um(tool.stick_out),
        "holder": _um(tool.holder_diameter / 2),
        "centre_cutting": tool.centre_cutting,
        "speed": None if data is None else data.cutting_speed,
        "chip": None if data is None else _um(data.chip_load),
        "step_down": None if data is None else data.step_down,
        "plunge": None if data is None else data.plunge,
        "ramp": steepest(tool, job.settings.ramp_angle),
        "coolant": coolants[tool.number],
    }


def _machine(job: Job) -> dict[str, Any]:
    """Both ends of each axis in machine coordinates, and where the work offset stands, if known."""
    machine = job.settings.machine
    return {
        **{axis: [_um(end) for end in machine.ends(axis)] for axis in "xyz"},
        "zero": [_zero(job, axis) for axis in "xyz"],
        "retract": _um(machine.retract_z),
        "max_feed": machine.max_feed,
        "spindle": [machine.spindle_min, machine.spindle_max],
        "work_offset": job.settings.work_offset,
    }


def _zero(job: Job, axis: str) -> float | None:
    """Where the work offset stands in an axis, if both are known, µm."""
    place, low = getattr(job.settings.measured, axis), getattr(job.settings.machine, f"low_{axis}")
    return None if place is None or low is None else _um(place)


def _limits(job: Job) -> dict[str, float]:
    return {
        "gouge": _um(TOLERANCES.gouge),
        "leftover": _um(TOLERANCES.leftover),
        "play": _um(play(job)),
        "clearance": _um(job.settings.clearance),
        "lowest": _um(job.floor),
        "tab_slack": _um(TAB_SLACK),
    }


def moved(run: Run) -> Ints:
    """The steps of a run that go from or to a place in the work."""
    steps = np.flatnonzero(run.moving & np.isfinite(run.end).all(axis=1))
    start, end = run.start[steps], run.end[steps]
    with np.errstate(invalid="ignore"):
        still = np.abs(end - start).max(axis=1) * MICRONS < STILL
    found: Ints = steps[~still | (run.sweep[steps] != 0)]
    return found


def _moves(run: Run) -> dict[str, Any]:
    """The moves by columns: kind, line, end and centre; what seldom changes as pairs: move, value."""
    steps = moved(run)
    kind, sweep = run.kind[steps], run.sweep[steps]
    letters = np.where(
        kind == Kind.RAPID, "r", np.where(kind == Kind.FEED, "l", np.where(sweep > 0, "a", "c"))
    )
    end = np.round(run.end[steps] * MICRONS).astype(np.int64)
    arcs = run.kind[steps] == Kind.ARC
    centre = np.round(run.centre[steps][arcs] * MICRONS).astype(np.int64)
    states = [run.states[index] for index in run.state[steps].tolist()]
    files = run.file[steps].tolist() if run.file.size else [0] * steps.size
    return {
        "kind": "".join(letters.tolist()),
        "line": np.diff(run.line[steps], prepend=0).tolist(),
        **{axis: end[:, place].tolist() for place, axis in enumerate("xyz")},
        "centre": centre.ravel().tolist(),
        "turns": _changes((np.abs(sweep) / (2 * np.pi) > 1 + 1e-9).astype(int).tolist()),
        "file": _changes(files),
        "tool": _changes([state.tool for state in states]),
        "rpm": _changes([round(state.spindle * state.rpm, 3) for state in states]),
        "feed": _changes(np.round(np.where(kind == Kind.RAPID, 0.0, run.feed[steps]), 3).tolist()),
    }


def _changes(values: list[Any]) -> list[list[Any]]:
    """Place and value wherever a list changes.

    >>> _changes([1, 1, 2, 2, 1])
    [[0, 1], [2, 2], [4, 1]]
    """
    found, place = [], 0
    for value, group in groupby(values):
        found.append([place, value])
        place += len(list(group))
    return found
