"""The independent check's numbers, and random four-bars, for the tests of the family."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from mechwright.mechanics.planar import acceleration_pole
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close

REFERENCE: dict[str, Any] = json.loads(
    (Path(__file__).parents[1] / "data" / "planar-linkages.json").read_text(encoding="utf-8")
)
FACTS = {fact["name"]: fact for fact in REFERENCE["facts"]}
SYNTHESIS = [case for case in REFERENCE["synthesis"] if case["kind"].startswith("fourbar")]
LOCI = {name: table for name, table in REFERENCE["locus_polynomials"].items() if "fourbar" in name}


def expected(name: str) -> Any:
    """A fact's value, complex where it is a pair."""
    value = FACTS[name]["expected"]
    return complex(*value) if isinstance(value, list) and len(value) == 2 else value


def random_bars(count: int, seed: int, turning: bool) -> tuple[FourBar, np.ndarray]:
    """Linkages with arrays of lengths (count,), and crank angles at which all of them close.

    Lengths are within a factor of ten of each other, and the dyad clears both ends of its reach by a fiftieth,
    so that the linkages are those that somebody would build.
    """
    rng = np.random.default_rng(seed)
    kept: list[np.ndarray] = []
    while sum(map(len, kept)) < count:
        lengths = 100 * np.exp(rng.uniform(-np.log(10), 0, (40 * count, 4)))
        phi, theta = rng.uniform(-10, 10, (2, len(lengths)))
        a, c, b, f = lengths.T
        diagonal = np.abs(f * np.exp(1j * theta) - a * np.exp(1j * phi))
        low, high = (np.abs(f - a), f + a) if turning else (diagonal, diagonal)
        room = np.minimum(b + c - high, low - np.abs(b - c))
        rows = np.column_stack((lengths, theta, rng.choice([-1.0, 1.0], len(lengths)), phi))
        kept.append(rows[room > 0.02 * lengths.max(axis=1)])
    a, c, b, f, theta, branch, phi = np.concatenate(kept)[:count].T
    return FourBar(a, c, b, f, theta, branch.astype(int)), phi  # type: ignore[arg-type]


def poles_of(bar: FourBar, phi: np.ndarray) -> np.ndarray:
    """Acceleration poles (n,) of the coupler in double precision, mm from A0."""
    return acceleration_pole(close(bar, phi).bodies(bar, 1.0)["coupler"]).fixed
