"""What processes can do, kerfs by material and thickness, and materials that a process must not cut."""

import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Literal, Protocol

import numpy as np

from mechwright.contracts.materials import MATERIALS, material

ProcessName = Literal["co2-laser", "diode-laser", "fibre-laser", "waterjet", "plasma", "wire"]
ANY = "any"
"""The material of kerfs that hold for every material."""
_HERE = Path(__file__).parent


@dataclass(frozen=True, slots=True)
class Process:
    """A way to cut through a sheet; lengths in mm.

    Parameters
    ----------
    words
        What people call it.
    size, holes
        Half of the width of the tolerance of a length, and of the diameter of a hole.
    grade
        Number of the IT grade (ISO 286-1) that this is like, from 6 to 10 mm.
    hole, hole_share
        Least hole, in mm and in thicknesses.
    web, web_share
        Least material between two cuts, in mm and in thicknesses.
    corner
        Least radius of an inside corner; never below half the kerf.
    taper
        Largest difference in size between the faces.
    pilot
        By how much a hole that is reamed afterwards is cut too small.
    joints, engraves
        Whether the beam can be switched off in motion, and cut into the surface alone.
    backlash
        Least backlash of gears; 0 where gears are not made so.
    control
        Control of its programs by default.
    source
        Where the figures are from.
    thickest
        Material or group to its greatest thickness.
    no_common
        Why one cut does not serve two parts; empty where it does.
    """

    name: str
    words: str
    size: float
    holes: float
    grade: int
    hole: float
    hole_share: float
    web: float
    web_share: float
    corner: float
    taper: float
    pilot: float
    joints: bool
    engraves: bool
    backlash: float
    control: str
    source: str
    thickest: Mapping[str, float]
    no_common: str = ""

    def least_hole(self, thickness: float) -> float:
        """The least hole in a sheet, mm."""
        return max(self.hole, self.hole_share * thickness)

    def least_web(self, thickness: float) -> float:
        """The least material between two cuts, mm."""
        return max(self.web, self.web_share * thickness)


class KerfRow(Protocol):
    """A kerf that was measured."""

    @property
    def process(self) -> str:
        """Kind of the process, such as ``"co2-laser"``."""

    @property
    def material(self) -> str:
        """Material or group, or any."""

    @property
    def thickness(self) -> float:
        """Of the sheet, mm."""

    @property
    def kerf(self) -> float:
        """Width of the slot, mm."""


@dataclass(frozen=True, slots=True)
class Kerf:
    """A kerf, mm, by how much it may be wrong either way, and where it is from."""

    width: float
    spread: float
    source: str
    measured: bool = False


def _toml(name: str) -> dict[str, Any]:
    return tomllib.loads((_HERE / name).read_text(encoding="utf-8"))


@cache
def processes() -> Mapping[str, Process]:
    """All processes by name."""
    return {name: Process(name, **table) for name, table in _toml("processes.toml").items()}


@cache
def _rows() -> Sequence[dict[str, Any]]:
    rows: list[dict[str, Any]] = _toml("kerfs.toml")["kerf"]
    return rows


def _names(name: str) -> tuple[str, str]:
    """A material's name and that of its group."""
    return name, material(name).group if name in MATERIALS else name


def kerf_of(process: str, name: str, thickness: float, measured: Sequence[KerfRow] = ()) -> Kerf | None:
    """The kerf of a process in a material; None where no table has one.

    Measured ones go before the built-in ones, a material's own before those of its group and of any material.
    Between two thicknesses it is in proportion; beyond the last one it stays.

    >>> kerf_of("co2-laser", "plywood", 4.5).width
    0.225
    """
    for wanted in (*_names(name), ANY):
        own = sorted(
            {(r.thickness, r.kerf) for r in measured if (r.process, r.material) == (process, wanted)}
        )
        if own:
            at, widths = zip(*own, strict=True)
            return Kerf(round(float(np.interp(thickness, at, widths)), 3), 0.0, "measured", measured=True)
    for wanted in (*_names(name), ANY):
        rows = [r for r in _rows() if (r["process"], r["material"]) == (process, wanted)]
        if rows:
            steps = [r.get("thickness", thickness) for r in rows]
            low, high = (float(np.interp(thickness, steps, [r["kerf"][end] for r in rows])) for end in (0, 1))
            near = min(rows, key=lambda r: abs(r.get("thickness", thickness) - thickness))
            return Kerf(
                round((low + high) / 2, 3),
                round((high - low) / 2, 3),
                f"{near['source']}, {near['confidence']}",
            )
    return None


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why a process does not cut a material, and the key of ``[cut]`` that lifts this; empty if none does."""

    why: str
    unless: str = ""


def refusal(process: str, name: str) -> Refusal | None:
    """Why a process must not cut a material, or cannot; None where it may.

    >>> refusal("co2-laser", "hdpe").why
    'it melts and burns'
    >>> refusal("wire", "steel")
    """
    ordered = material(name).grades.plate if name in MATERIALS else ""
    # "PMMA, cast" is clear or not: only a name that says so is.
    words = {*re.split(r"[^a-z0-9]+", f"{name} {ordered}".lower()), *_names(name), name.casefold()}
    for row in _toml_refused():
        if process in row["processes"] and words & set(row["words"]):
            return Refusal(row["why"], row.get("unless", ""))
    return None


@cache
def _toml_refused() -> Sequence[dict[str, Any]]:
    rows: list[dict[str, Any]] = _toml("refused.toml")["refused"]
    return rows


@dataclass(frozen=True, slots=True)
class Heat:
    """What heat does to an edge, and the step that comes before what suffers from it."""

    why: str
    step: str


def heat_of(process: str, name: str, finishing: Sequence[str]) -> Heat | None:
    """What the heat of a process means for what is done afterwards; None where it means nothing.

    >>> heat_of("co2-laser", "acrylic", ["bond a bush of 8 x 5 H7"]).step
    'anneal at 70 °C for 2 to 4 h before bonding'
    >>> heat_of("waterjet", "acrylic", ["bond a bush of 8 x 5 H7"])
    """
    for row in _toml_heat():
        of_it = process in row["processes"] and {*_names(name)} & set(row["words"])
        if of_it and any(one.startswith(tuple(row["before"])) for one in finishing):
            return Heat(row["why"], row["step"])
    return None


@cache
def _toml_heat() -> Sequence[dict[str, Any]]:
    rows: list[dict[str, Any]] = _toml("heat.toml")["heat"]
    return rows


def greatest_thickness(process: Process, name: str) -> float | None:
    """The thickest sheet of a material that a process cuts, mm; None where nothing is known."""
    return next((process.thickest[one] for one in _names(name) if one in process.thickest), None)


def able(name: str, thickness: float) -> list[str]:
    """Processes that cut a material of a thickness, mm."""
    found = []
    for process in processes().values():
        most = greatest_thickness(process, name)
        if refusal(process.name, name) is None and most is not None and thickness <= most:
            found.append(process.name)
    return found
