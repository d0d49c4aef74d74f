"""Reads a certificate, and holds it against the files that it names and the moves of its program."""

import hashlib
import json
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import shapely

from mechwright_check import RefutedError, UnknownError
from mechwright_check.checks import GOUGE, LEFTOVER, Case
from mechwright_check.geometry import Cutter, polygons
from mechwright_check.reading import CENTRE, END, FEED, FILE, KIND, LINE, RPM, START, SWEEP, TOOL, TOP, read

FORMAT = "mechwright certificate 1"
LARGEST = 100_000_000
"""Bytes of a file that is read."""
CLAIM, STILL = 1.001, 0.0005
"""Moves that are claimed agree within so many µm; moves that go less far are none, mm."""


def content(path: Path) -> bytes:
    """The bytes of a file."""
    try:
        if path.stat().st_size > LARGEST:
            raise UnknownError(f"{path}: larger than {LARGEST // 1_000_000} MB")
        return path.read_bytes()
    except (OSError, ValueError) as error:
        raise UnknownError(f"{path}: {error}") from None


def program(path: Path) -> str:
    """The text of a program."""
    try:
        return content(path).decode("ascii")
    except UnicodeDecodeError:
        raise UnknownError(f"{path.name} has characters that are not ASCII") from None


def load(path: Path) -> dict[str, Any]:
    """The certificate in a file, whole and of a form that is known."""
    try:
        found = json.loads(content(path), parse_constant=float.fromhex)
        form, seal = found["format"], found.pop("seal")
        plain = json.dumps(found, sort_keys=True, separators=(",", ":"))
    except (ValueError, RecursionError, KeyError, TypeError, AttributeError):
        raise RefutedError(f"{path.name} is no whole certificate") from None
    if form != FORMAT:
        raise UnknownError(f"{path.name}: its form is {form!r:.40}; this is a checker of {FORMAT!r}")
    if seal != hashlib.sha256(plain.encode()).hexdigest():
        raise RefutedError(f"{path.name} was changed after it was written: its seal is that of another text")
    return dict(found)


def texts_of(found: dict[str, Any], folder: Path, more: list[Path], notes: list[str]) -> dict[str, str]:
    """The program's files by name; all that the certificate names, beside it or in ``more``, has its hash."""
    given = {path.name: path for path in more}
    bound = [{"what": "program", **one} for one in found["files"]] + found["bound"]
    for file in bound:
        name = Path(file["name"]).name
        # A drawing that is an input may have the name of the one that is written: it is either of them.
        others = bound[len(found["files"]) :] if file["what"] != "program" else [file]
        known = {one["sha256"] for one in others if Path(one["name"]).name == name}
        path = given.pop(name, folder / name)
        if file["what"] != "program" and not path.exists():
            notes.append(f"{name} ({file['what']}) is not beside the certificate and was not compared")
        elif hashlib.sha256(content(path)).hexdigest() not in known:
            raise RefutedError(
                f"{name} is not the {file['what']} that the certificate is of: its hash is another"
            )
    if given:
        raise RefutedError(f"the certificate says nothing of {', '.join(given)}")
    return {file["name"]: program(folder / Path(file["name"]).name) for file in found["files"]}


def case_of(found: dict[str, Any], texts: dict[str, str], notes: list[str]) -> Case:
    """The job of a certificate, with the moves that the words of the program give."""
    if found["unchecked"]:
        raise UnknownError("the certificate does not hold " + ", ".join(found["unchecked"]))
    part, hold, limits = (
        found["part"],
        found["hold"],
        {key: value / 1000 for key, value in found["limits"].items()},
    )
    if limits["gouge"] > GOUGE or limits["leftover"] > LEFTOVER or not 0 <= limits["play"] <= 0.05:
        raise RefutedError("the certificate allows deeper cuts or thicker stock than the checker")
    shapes, thickness = [polygons(rings) for rings in part["sections"]], part["thickness"] / 1000
    levels = [(top / 1000, bottom / 1000, shapes[number]) for top, bottom, number in part["levels"]]
    heights = [0.0, *(bottom for _, bottom, _ in levels)]
    joined = all(level[0] == height > level[1] for level, height in zip(levels, heights, strict=False))
    if not joined or heights[-1] != -thickness or not 0 <= -thickness - limits["lowest"] <= 5.001:
        raise RefutedError("the levels of the certificate do not fill the thickness of its part")
    undercut = any(
        not shapely.is_empty(a.difference(b).buffer(-GOUGE)) for (*_, a), (*_, b) in pairwise(levels)
    )
    if undercut or levels[-1][2].is_empty:
        raise RefutedError("a level of the certificate has nothing below it")
    machine = {
        **found["machine"],
        "zero": [None if z is None else z / 1000 for z in found["machine"]["zero"]],
    }
    machine |= {axis: [end / 1000 for end in machine[axis]] for axis in "xyz"} | {
        "retract": machine["retract"] / 1000
    }
    tools = {int(number): cutter(tool) for number, tool in found["tools"].items()}
    held = {
        "method": hold["method"],
        "tabs": [(tab["top"] / 1000, polygons(tab["rings"])) for tab in hold["tabs"]],
        "prisms": [(one["top"] / 1000, polygons(one["rings"]), one["stop"]) for one in hold["prisms"]],
    }
    moves = read(found["control"], texts, machine, tools)
    plate = shapely.box(*(edge / 1000 for edge in found["stock"]))
    return Case(moves, list(texts), tools, levels, plate, held, machine, limits, notes)


def cutter(tool: dict[str, Any]) -> Cutter:
    """A tool of a certificate."""
    radius, tip, slope = tool["radius"] / 1000, tool["tip"] / 1000, tool["slope"] or 0.0
    if not (0 < radius < 200 and 0 <= tip <= radius and slope >= 0 and (slope or tip == radius)):
        raise RefutedError("a tool of the certificate has no shape")
    return Cutter(tool["kind"], radius, tip, slope, tool["flute_length"] / 1000, tool)


def compare(case: Case, claimed: dict[str, Any]) -> None:
    """The moves of the program are those that the certificate claims, one by one."""
    every, kind = case.moves, np.array(list(claimed["kind"]))
    goes = (np.abs(every[:, END] - every[:, START]).max(axis=1) > STILL) | (every[:, SWEEP] != 0)
    index = np.flatnonzero(goes & (every[:, END][:, 2] < TOP))
    moves = every[index]
    if len(moves) != len(kind):
        raise RefutedError(f"the certificate claims {len(kind)} moves, and the program makes {len(moves)}")
    bent, turn = moves[:, SWEEP] != 0, np.where(moves[:, SWEEP] > 0, "a", "c")
    wrong = np.where(bent, turn, np.where(moves[:, KIND] == 0, "r", "l")) != kind
    wrong |= moves[:, LINE] != np.cumsum(claimed["line"])
    wrong |= (np.abs(moves[:, END] * 1000 - np.transpose([claimed[axis] for axis in "xyz"])) > CLAIM).any(
        axis=1
    )
    if not wrong.any():
        wrong[bent] |= (
            np.abs(moves[bent, CENTRE] * 1000 - np.reshape(claimed["centre"], (-1, 2))) > CLAIM
        ).any(axis=1)
    for name, column in (("file", FILE), ("tool", TOOL), ("rpm", RPM), ("feed", FEED)):
        places, values = np.transpose(claimed[name])
        wrong |= (
            np.abs(moves[:, column] - values[np.searchsorted(places, np.arange(len(kind)), "right") - 1])
            > 0.01
        )
    case.bad(wrong, "the certificate claims another move here", index)
