"""Openings and slots that are narrower than the kerf: where, and the widest kerf that goes into them."""

import math
from collections.abc import Iterator

import shapely

from mechwright.contracts.finding import Finding, Stage
from mechwright.contracts.part import Part
from mechwright.errors import GeometryError
from mechwright.geometry import Loop
from mechwright.geometry.segments import Point
from mechwright_cut.jobs import CutPart
from mechwright_cut.paths.parallels import beam_ring
from mechwright_cut.paths.wire import LEAST_DRILL, NARROW, widest_circle
from mechwright_cut.settings.cut_settings import LASER, WIRE, CutSettings
from mechwright_cut.settings.figures import Process, able, kerf_of
from mechwright_plane.offsets import grow

HALVINGS = 12
"""The widest kerf is found to a four-thousandth of the one that is too wide."""
LEAST = 0.02
"""No beam or wire leaves a narrower kerf, mm."""


def slot_findings(cut: CutPart, process: Process, kerf: float, settings: CutSettings) -> Iterator[Finding]:
    """An error for the narrowest opening or slot of a part, if the beam or the wire does not go into it.

    A wire has to be threaded first: an opening without room for its start hole is told alone.
    """
    wide = 2 * settings.registers(kerf)[0] if process.name == WIRE else kerf
    if process.name == WIRE and (found := [*start_hole_findings(cut, settings)]):
        yield from found
        return
    narrow = [(_widest(loop, wide), loop) for loop in cut.outline.loops if not _opens(loop, wide)]
    if not narrow:
        return
    widest, loop = min(narrow, key=lambda one: one[0])
    x, y = _place(loop, wide)
    what = f"the kerf of {kerf:g} mm" if wide == kerf else f"{wide:g} mm, which the wire takes with D1,"
    yield Finding.error(
        "cut.path",
        "cut.kerf",
        f"{cut.part.name}: {what} is wider than the slot at ({x:.2f}, {y:.2f})",
        remedy=_remedy(cut.part, process, widest, wide, kerf, settings),
        stage=Stage.MACHINING,
    )


def start_hole_findings(cut: CutPart, settings: CutSettings) -> Iterator[Finding]:
    """An error for the narrowest opening, if a start hole for the wire has no room in it."""
    able = [(widest_circle(loop), loop) for loop in cut.outline.inner]
    middle, loop = min(able, key=lambda one: one[0].length, default=(None, None))
    if middle is None or loop is None or middle.length >= settings.start_hole / 2 + NARROW:
        return
    x, y = shapely.get_coordinates(middle)[0]
    smaller = math.floor(20 * (middle.length - NARROW)) / 10
    drilled = smaller >= LEAST_DRILL
    yield Finding.error(
        "cut.start-hole",
        "cut.start_hole",
        f"{cut.part.name}: a start hole of {settings.start_hole:g} mm needs "
        f"{settings.start_hole + 2 * NARROW:g} mm across, and the opening at ({x:.2f}, {y:.2f}) has "
        f"{2 * middle.length:.2f}",
        remedy=f"set cut.start_hole = {smaller:g}"
        if drilled
        else f"draw it {LEAST_DRILL + 2 * NARROW:g} mm wide for a start hole of {LEAST_DRILL:g} mm",
        stage=Stage.MACHINING,
        proposed=({"cut.start_hole": smaller},) if drilled else (),
    )


def _opens(loop: Loop, width: float) -> bool:
    """Whether a beam of this width runs along a whole loop."""
    if loop.is_circle:  # a matter of least holes
        return True
    try:
        beam_ring(loop, width, loop.area > 0, "")
    except GeometryError:
        return False
    return True


def _widest(loop: Loop, wide: float) -> float:
    """The widest kerf that goes into a loop, mm, by halving; 0 where none does."""
    low, high = 0.0, wide
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if _opens(loop, middle) else (low, middle)
    return low


def _place(loop: Loop, width: float) -> Point:
    """The middle of the largest place that a beam does not come to."""
    half = width / 2 if loop.area > 0 else -width / 2
    shape = shapely.Polygon(loop.flatten())
    rest = shapely.symmetric_difference(grow(grow(shape, half), -half), shape)
    largest = max(shapely.get_parts(rest), key=lambda one: one.area)
    x, y = shapely.get_coordinates(largest.representative_point())[0]
    return float(x), float(y)


def _remedy(
    part: Part, process: Process, widest: float, wide: float, kerf: float, settings: CutSettings
) -> str:
    """To widen it, to measure, or to take the process that is wide enough by least."""
    found = [f"draw it {math.ceil(1000 * wide + 1) / 1000:g} mm wide"]
    own = math.floor(1000 * (widest - (wide - kerf))) / 1000
    if own >= LEAST and not (process.name == WIRE and settings.offsets):
        found.append(f"set cut.kerf = {own:g} if a test cut shows that")
    others = [
        (other.width, name)
        for name in able(part.material, part.thickness)
        if name != process.name
        and (other := kerf_of(name, part.material, part.thickness, settings.kerfs))
        and other.width <= widest
    ]
    if others:
        _, name = max(others)
        kind = name.removesuffix(f"-{LASER}")
        if kind == name:
            found.append(f'set process = "{name}"')
        elif process.name.endswith(LASER):
            found.append(f'set cut.laser = "{kind}"')
        else:
            found.append(f'set process = "{LASER}", with cut.laser {kind}')
    return ", or ".join(found)
