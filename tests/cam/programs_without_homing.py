"""Programs of a Grbl machine without switches, and faults in what only they have: a zero that nobody knows."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

import golden_cases
import mutants
import numpy as np
from by_control import BY_NAME
from golden_case import MORE
from mutants import Mutant

from mechwright_cam.machining import machine
from mechwright_cam.planning.setups import lay_out_setups
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.settings import CamSettings

GRBL = BY_NAME["grbl"]
MACHINE = {"homing": "none", "travel_z": 60}
PARTS = ("profile-outside", "pocket-contour", "bore-helix", "slot", "tabs", "chip-break")
"""Kept parts that one tool cuts."""
MORE_PARTS = ("profile-inside", "pocket-island", "pocket-adaptive", "ramp", "helix", "peel", "groove", "face")


@dataclass(frozen=True)
class HandZeroed:
    """A proven program of one file."""

    name: str
    job: Job
    text: str


@cache
def program(operation: str) -> HandZeroed:
    """The program of a kept part, on a machine without switches."""
    case = golden_cases.CASES[operation]
    settings = {"control": "grbl", "tools": case.tools, "floor_to_leave": 0, **case.settings}
    cam = CamSettings.model_validate({**settings, "machine": MACHINE})
    (job, *_), _ = lay_out_setups(case.part(operation), cam, MORE)
    (text,) = machine(job, GRBL).files.values()
    return HandZeroed(operation, job, text)


def _without(text: str, line: str) -> str:
    lines = text.splitlines(keepends=True)
    lines.remove(line + "\n")
    return "".join(lines)


FAULTS: dict[str, Callable[[str], str]] = {
    "machine Z before all": lambda text: text.replace("G0 Z5", "G53 G0 Z-2\nG0 Z5", 1),
    "machine Z at the end": lambda text: text.replace("X0 Y0", "G53 G0 Z-2\nX0 Y0"),
    "machine Z in the middle": lambda text: re.sub(r"(G0 Z5\n)(?=\(operation)", r"G53 G0 Z-2\n\1", text),
    "machine X at the end": lambda text: text.replace("M30", "G53 G0 X0\nM30"),
    "reference point": lambda text: text.replace("G0 Z5", "G91 G28 Z0\nG90\nG0 Z5", 1),
    "second reference point": lambda text: text.replace("X0 Y0", "G91 G30 Z0\nG90\nX0 Y0"),
    "reference point set": lambda text: text.replace("G0 Z5", "G28.1\nG0 Z5", 1),
    "zero shifted": lambda text: text.replace("G0 Z5", "G92 Z0\nG0 Z5", 1),
    "zero shifted sideways": lambda text: text.replace("M30", "G92 X0\nM30"),
    "zero set": lambda text: text.replace("G0 Z5", "G10 L20 P1 Z0\nG0 Z5", 1),
    "no way up first": lambda text: _without(text, "G0 Z5"),
    "sideways first": lambda text: text.replace("G0 Z5", "G0 X0 Y0 Z5", 1),
    "down first": lambda text: text.replace("G0 Z5", "G0 Z-1", 1),
    "low first": lambda text: text.replace("G0 Z5", "G0 Z0.2", 1),
    "fed first": lambda text: text.replace("G0 Z5", "G1 Z5 F100", 1),
    "by a distance first": lambda text: text.replace("G0 Z5", "G91 G0 Z5\nG90", 1),
    "left low": lambda text: text.replace("G0 Z5\nX0 Y0", "G0 Z0.1\nX0 Y0"),
    "no work offset": lambda text: text.replace("G54\n", "").replace("G54 ", ""),
    "another work offset": lambda text: text.replace("G54", "G55"),
    "another work offset at the end": lambda text: text.replace("M5\n", "M5\nG55\n", 1),
    "Z beyond the travel": lambda text: text.replace("G0 Z5\nX0 Y0", "G0 Z90\nX0 Y0"),
    "X beyond the travel": lambda text: text.replace("X0 Y0", "X900 Y0"),
    "no end": lambda text: text.replace("M30\n", ""),
    "no tool": lambda text: re.sub(r"^T\d+\n", "", text, flags=re.M),
    "another tool": lambda text: re.sub(r"^T\d+$", "T77", text, flags=re.M),
    "modes left out": lambda text: text.replace("G17 G21 G40 G49 G80 G90 G91.1 G94\n", ""),
    "a tool change": lambda text: re.sub(r"^(T\d+)$", r"\1 M6", text, flags=re.M),
    "a length": lambda text: text.replace("G49\n", "G43.1 Z3\n", 1),
    "inches": lambda text: text.replace("G21", "G20"),
    "spindle off": lambda text: re.sub(r" S\d+ M3", "", text),
    "spindle backwards": lambda text: re.sub(r"(S\d+) M3", r"\1 M4", text),
}
"""Each takes a program, and gives it back as it is where it has no place for the fault."""


KINDS = (*FAULTS, *mutants.FAULTS)


def _of(fault: Callable[[str], str], text: str) -> str:
    """The text with a fault, whatever its clear height."""
    clear = re.search(r"^G0 Z[\d.]+\n", text, flags=re.M)
    assert clear is not None
    return fault(text.replace(clear[0], "G0 Z5\n")).replace("G0 Z5\n", clear[0])


def faulty(
    count: int, seed: int, names: Sequence[str], kinds: Sequence[str] = KINDS
) -> list[tuple[HandZeroed, Mutant]]:
    """So many programs with one fault each: in turn of each kind, in a part drawn at random."""
    rng = np.random.default_rng(seed)
    found: list[tuple[HandZeroed, Mutant]] = []
    seen: set[str] = set()
    tries = 0
    while len(found) < count and tries < 20 * count:
        kind = kinds[tries % len(kinds)]
        one = program(names[int(rng.integers(len(names)))])
        tries += 1
        if kind in FAULTS:
            text = _of(FAULTS[kind], one.text)
            made = None if text == one.text else Mutant(kind, 1, kind, text)
        else:
            made = mutants.mutant(one.text, kind, rng)
        if made is not None and made.text not in seen:
            seen.add(made.text)
            found.append((one, made))
    return found
