"""Reads a certificate, and holds it against the files that it names and the moves of its program."""

import hashlib
import json
from pathlib import Path
from typing import Any

import numpy as np

from mechwright_check import Refuted, Unknown, at
from mechwright_check.checks import GOUGE, LEFTOVER, Case
from mechwright_check.geometry import Cutter, polygons
from mechwright_check.reading import Reader

FORMAT = "mechwright certificate 1"
LARGEST = 200_000_000
"""Bytes of a file that is read."""
CLAIM = 1.001
"""Moves that are claimed agree within so much, µm."""
STILL = 0.0005
"""Moves that go less far are none, mm."""


def content(path: Path) -> bytes:
    """The bytes of a file."""
    try:
        if path.stat().st_size > LARGEST:
            raise Unknown(f"{path}: larger than {LARGEST // 1_000_000} MB")
        return path.read_bytes()
    except OSError as error:
        raise Unknown(f"{path}: {error.strerror or error}") from None


def load(path: Path) -> dict[str, Any]:
    """The certificate in a file, whole and of a form that is known."""
    text = content(path)
    try:
        found = json.loads(text, parse_constant=_refuse)
        form, seal = found["format"], found.pop("seal")
    except (ValueError, RecursionError, KeyError, TypeError, AttributeError):
        raise Refuted(f"{path.name} is no whole certificate") from None
    if form != FORMAT:
        raise Unknown(f"{path.name}: its form is {form!r:.40}; this is a checker of {FORMAT!r}")
    if seal != sealed(found):
        raise Refuted(f"{path.name} was changed after it was written: its seal is that of another text")
    return found


def sealed(found: dict[str, Any]) -> str:
    """The seal of a certificate: the hash of all that it says otherwise."""
    text = json.dumps(found, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()


def _refuse(constant: str) -> None:
    raise ValueError(constant)


def texts_of(found: dict[str, Any], folder: Path, more: list[Path], notes: list[str]) -> dict[str, str]:
    """The program's files by name; all that the certificate names, beside it or of ``more``, have its hash."""
    texts, given = {}, {path.name: path for path in more}
    for file in found["files"]:
        said = content(folder / Path(file["name"]).name)
        if hashlib.sha256(said).hexdigest() != file["sha256"]:
            raise Refuted(f"{file['name']} is not the program that the certificate is of: its hash is another")
        try:
            texts[file["name"]] = said.decode("ascii")
        except UnicodeDecodeError:
            raise Unknown(f"{file['name']} has characters that are not ASCII") from None
    for file in found["bound"]:
        name, what = Path(file["name"]).name, file["what"]
        path = given.pop(name, folder / name)
        if not path.exists():
            notes.append(f"{name} ({what}) is not beside the certificate and was not compared")
        elif hashlib.sha256(content(path)).hexdigest() != file["sha256"]:
            raise Refuted(f"{name} is not the {what} that the certificate is of: its hash is another")
    if given:
        raise Refuted(f"the certificate says nothing of {', '.join(given)}")
    return texts


def case_of(found: dict[str, Any], texts: dict[str, str], notes: list[str]) -> Case:
    """The job of a certificate, with the moves that the words of the program give."""
    if found["unchecked"]:
        raise Unknown("the certificate does not hold " + ", ".join(found["unchecked"]))
    part, limits = found["part"], {key: value / 1000 for key, value in found["limits"].items()}
    if limits["gouge"] > GOUGE or limits["leftover"] > LEFTOVER or not 0 <= limits["play"] <= 0.05:
        raise Refuted("the certificate allows deeper cuts or thicker stock than the checker")
    shapes = [polygons(rings) for rings in part["sections"]]
    levels = [(top / 1000, bottom / 1000, shapes[number]) for top, bottom, number in part["levels"]]
    joined = all(one[1] == other[0] for one, other in zip(levels, levels[1:], strict=False))
    if not joined or levels[0][0] != 0 or abs(levels[-1][1] + part["thickness"] / 1000) > 1e-6:
        raise Refuted("the levels of the certificate do not fill the thickness of the part")
    if not -part["thickness"] / 1000 - 5.001 <= limits["lowest"] <= -part["thickness"] / 1000:
        raise Refuted("the lowest cut of the certificate is not just below its part")
    tools = {int(number): cutter(int(number), tool) for number, tool in found["tools"].items()}
    hold, machine = found["hold"], dict(found["machine"])
    prisms = [(one["top"] / 1000, polygons(one["rings"]), one["stop"]) for one in hold["prisms"]]
    tabs = [(tab["top"] / 1000, polygons(tab["rings"])) for tab in hold["tabs"]]
    for axis in "xyz":
        machine[axis] = [end / 1000 for end in machine[axis]]
    machine["travel"] = [one / 1000 for one in machine["travel"]]
    machine["zero"] = [None if one is None else one / 1000 for one in machine["zero"]]
    machine["retract"] /= 1000
    moves = read(found["control"], texts, machine, tools)
    if machine["work_offset"] not in {"G54", "G55", "G56", "G57", "G58", "G59"}:
        raise Unknown(f"the work offset {machine['work_offset']!r:.20}")
    stock = tuple(edge / 1000 for edge in found["stock"])
    held = {"method": hold["method"], "tabs": tabs, "prisms": prisms}
    return Case(moves, list(texts), tools, levels, stock, held, machine, limits, notes)


def cutter(number: int, tool: dict[str, Any]) -> Cutter:
    """A tool of a certificate."""
    radius, tip, slope = tool["radius"] / 1000, tool["tip"] / 1000, tool["slope"] or 0.0
    if not (0 < radius < 200 and 0 <= tip <= radius and slope >= 0 and (slope or tip == radius)):
        raise Refuted(f"T{number} of the certificate has no shape")
    return Cutter(number, tool["kind"], radius, tip, slope, tool["flute_length"] / 1000, tool)


def read(control: str, texts: dict[str, str], machine: dict[str, Any], tools: dict[int, Cutter]) -> np.ndarray:
    """The moves that the words of a program give."""
    reader = Reader(control, machine, tools)
    for number, (name, text) in enumerate(texts.items()):
        reader.read(text, number, name if len(texts) > 1 else "")
    moves = reader.moves.array()
    if not (moves[:, 1] == 1).any():
        raise Refuted("the program cuts nothing")
    return moves


def compare(case: Case, claimed: dict[str, Any]) -> None:
    """The moves of the program are those that the certificate claims, one by one."""
    moves, kind = case.moves, np.array(list(claimed["kind"]))
    goes = (np.abs(moves[:, 5:8] - moves[:, 2:5]).max(axis=1) > STILL) | (moves[:, 10] != 0)
    derived = moves[goes & (moves[:, 7] < 1000.0)]
    if len(derived) != len(kind):
        raise Refuted(f"the certificate claims {len(kind)} moves, and the program makes {len(derived)}")
    count = len(kind)
    bent = derived[:, 10] != 0
    own = np.where(derived[:, 1] == 0, "r", np.where(~bent, "l", np.where(derived[:, 10] > 0, "a", "c")))
    ends = np.column_stack([np.array(claimed[axis], dtype=np.float64) for axis in "xyz"])
    centres = np.array(claimed["centre"], dtype=np.float64).reshape(-1, 2)
    if len(ends) != count or len(claimed["line"]) != count or len(centres) != np.isin(kind, ["a", "c"]).sum():
        raise Refuted("the columns of moves in the certificate have different lengths")
    wrong = (own != kind) | (derived[:, 0] != np.cumsum(claimed["line"]))
    wrong |= np.abs(derived[:, 5:8] * 1000 - ends).max(axis=1) > CLAIM
    if not wrong.any():
        wrong[bent] |= np.abs(derived[bent, 8:10] * 1000 - centres).max(axis=1) > CLAIM
    for name, column, slack in (("file", 15, 0.0), ("tool", 11, 0.0), ("rpm", 12, 0.01), ("feed", 13, 0.01)):
        wrong |= np.abs(derived[:, column] - spread(claimed[name], count)) > slack
    if wrong.any():
        row = derived[int(np.argmax(wrong))]
        raise Refuted(at(int(row[0]), case.files[int(row[15])]) + "the certificate claims another move here")


def spread(changes: list[list[float]], count: int) -> np.ndarray:
    """Values (n,) of a list of changes."""
    places = np.array([place for place, _ in changes], dtype=np.int64)
    values = np.array([value for _, value in changes], dtype=np.float64)
    return values[np.searchsorted(places, np.arange(count), side="right") - 1]
