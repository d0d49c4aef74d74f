"""A new design that is made of what a shop has in hand, as large as a sheet allows."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from mechwright.contracts.in_hand import InHand
from mechwright.contracts.part import Part
from mechwright.designs.change import changed, found_at
from mechwright.designs.design import Design, design_of
from mechwright.errors import DesignError, MechwrightError
from mechwright.plugins.host import Host
from mechwright.remedies.keys import Key, keys_of

STEPS = 24
"""Sizes that are tried between the least and the greatest factor."""
LEAST, MOST = 0.05, 20.0
"""Factors between which the size of a design is sought."""
NICE = 0.5
"""Lengths are multiples of this, mm; a module of a fifth of it."""


def fit_of(text: str) -> tuple[float, float]:
    """Length and width, mm, from a text such as ``120x80``; raises DesignError.

    >>> fit_of("120x80")
    (120.0, 80.0)
    """
    words = text.lower().split("x")
    try:
        x, y = (float(word) for word in words)
    except ValueError:
        raise DesignError(f"--fit: {text!r} should be length x width in mm, such as 120x80") from None
    if not (0 < x < math.inf and 0 < y < math.inf):
        raise DesignError(f"--fit: {text!r}: both should be above 0")
    return x, y


def started(
    content: dict[str, Any], path: Path, host: Host, fit: tuple[float, float] | None
) -> dict[str, Any]:
    """The keys that make a new design of the sheet in hand, and as large as it may be."""
    change: dict[str, Any] = {}

    def design() -> Design:
        return design_of(changed(content, change), path, "", host)

    first = design()
    hand = (
        next((one.in_hand(first.tables[one.name]) for one in first.readers if one.lender), None) or InHand()
    )
    if hand.material and "parameters.material" in keys_of(first):
        change["parameters.material"] = hand.material
    if hand.thickness is not None:
        change |= _thicknesses(design(), hand.thickness, host)
    rooms: dict[str, Callable[[Sequence[tuple[float, float]]], bool]] = {}
    if fit is not None:
        rooms[f"--fit: {fit[0]:g} x {fit[1]:g} mm"] = lambda boxes: all(_one(box, fit) for box in boxes)
    if hand.fits is not None:
        rooms["--shop: the sheet in hand"] = hand.fits
    if rooms:
        change |= _size(
            design(), " and ".join(rooms), host, lambda boxes: all(f(boxes) for f in rooms.values())
        )
    if hand.fits is not None and len(_boxes(_plates(design()))) > 1:
        change |= hand.change
    return change


def _plates(design: Design) -> list[Part]:
    """The plates of a design; none where it has an error."""
    try:
        parts = design.family.parts(design.params)
    except MechwrightError:
        return []
    return [part for part in parts if part.outline is not None and part.bought is None]


def _thicknesses(design: Design, thickness: float, host: Host) -> dict[str, Any]:
    """The keys after which plates are as thick as asked, each tried by itself."""
    found: dict[str, Any] = {}
    alike = _alike(design, thickness)
    for key in _numbers(design):
        if "thickness" not in key.name or not key.low <= thickness <= key.high:
            continue
        trial = _tried(design, {**found, key.path: thickness}, host)
        if trial is not None and (count := _alike(trial, thickness)) > alike:
            found[key.path], alike = thickness, count
    return found


def _alike(design: Design, thickness: float) -> int:
    return sum(abs(part.thickness - thickness) < 1e-6 for part in _plates(design))


def _numbers(design: Design) -> Iterator[Key]:
    return (key for key in keys_of(design).values() if key.numeric and key.path.startswith("parameters."))


def _tried(design: Design, change: Mapping[str, Any], host: Host) -> Design | None:
    try:
        return design_of(changed(design.content, change), design.path, "", host)
    except MechwrightError:
        return None


def _size(
    design: Design, size: str, host: Host, fits: Callable[[Sequence[tuple[float, float]]], bool]
) -> dict[str, Any]:
    """The lengths that make a design as large as its plates fit; ``size`` is the option and the room."""
    sizes = design.family.size_keys
    if not sizes:
        return {}
    now = {}
    for name, usual in sizes.items():
        stands, value = found_at(design.content, f"parameters.{name}")
        now[f"parameters.{name}"] = float(value) if stands and isinstance(value, int | float) else usual
    low, high, best = math.log(LEAST), math.log(MOST), None
    for _ in range(STEPS):
        middle = (low + high) / 2
        change = {path: _nice(path, value * math.exp(middle)) for path, value in now.items()}
        trial = _tried(design, change, host)
        plates = [] if trial is None else _plates(trial)
        if plates and not fits(_boxes(plates)):
            high = middle
        elif plates:
            low, best = middle, change
        elif best is None:  # too small for its own walls, or beyond a bound
            low = middle
        else:
            high = middle
    if best is None:
        raise DesignError(f"{size} is too small for any design of {design.family.name}; give a larger one")
    return best


def _nice(path: str, value: float) -> float:
    step = NICE / 5 if path.endswith("module") else NICE
    return round(max(math.floor(value / step + 1e-9), 1) * step, 6)


def _boxes(plates: Sequence[Part]) -> list[tuple[float, float]]:
    """Length and width of each copy of each plate, mm."""
    found = []
    for part in plates:
        x0, y0, x1, y1 = part.outline.polygon().bounds  # type: ignore[union-attr]
        found += [(x1 - x0, y1 - y0)] * max(1, len(part.instances))
    return found


def _one(box: tuple[float, float], sheet: tuple[float, float]) -> bool:
    return any(x <= sheet[0] and y <= sheet[1] for x, y in (box, box[::-1]))
