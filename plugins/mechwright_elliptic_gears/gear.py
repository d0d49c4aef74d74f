"""From the design table to the gear: sizes, teeth, outline and part."""

import math
from functools import lru_cache

import numpy as np

from mechwright.errors import GeometryError
from mechwright.geometry import Loop, Outline
from mechwright.geometry.keyway import Opening, key_of_width
from mechwright.geometry.segments import Point
from mechwright.part import Bore, Feature, Instance, Part, Profile
from mechwright_elliptic_gears.contour import gear_loop
from mechwright_elliptic_gears.ellipse import Ellipse
from mechwright_elliptic_gears.params import EllipticGearParams
from mechwright_elliptic_gears.rack import Rack
from mechwright_elliptic_gears.teeth import Teeth

PART = "gear"
"""Name of the part; both gears are this one."""

BODIES = {"gear-2": (0.45, 0.58, 0.70), "gear-4": (0.80, 0.68, 0.42)}
"""The driving and the driven gear in the motion, each with its colour."""

OFFSET_SLACK = 1e-6
"""Pitches by which a tooth offset may miss: a micrometre in a metre, far below any backlash."""

_CACHED = 16
"""Designs whose geometry is kept: check, parts and the judging of cuts ask for the same one."""


def ellipse_of(params: EllipticGearParams) -> Ellipse:
    """The pitch ellipse: its perimeter 4 a E is z pitches, so a = π m z / (4 E)."""
    if params.semi_major is not None:
        return Ellipse(params.semi_major, params.eccentricity)
    assert params.module is not None  # noqa: S101 - the table has exactly one of both
    quarter = Ellipse(1.0, params.eccentricity).complete_integral
    return Ellipse(math.pi * params.module * params.teeth / (4 * quarter), params.eccentricity)


def rack_of(params: EllipticGearParams) -> Rack:
    """The generating rack, in mm."""
    module = params.module
    if module is None:
        module = ellipse_of(params).perimeter / (math.pi * params.teeth)
    return Rack(
        module,
        math.radians(params.pressure_angle),
        params.addendum * module,
        params.dedendum * module,
        params.tip_radius * module,
        params.backlash,
    )


def offsets_that_mesh(teeth: int) -> tuple[float, float]:
    """The two tooth offsets, in pitches, with which two congruent gears mesh.

    Half a perimeter lies between the far vertex of one gear and the near vertex of the other, which meet: a
    tooth there must find a space, so 2 δ = (z - 1)/2 (mod 1).

    >>> offsets_that_mesh(39), offsets_that_mesh(40)
    ((0.0, 0.5), (0.25, 0.75))
    """
    return (0.0, 0.5) if teeth % 2 else (0.25, 0.75)


def offset_miss(offset: float, teeth: int) -> float:
    """Pitches by which a tooth offset misses the nearest one that meshes; 0 where it hardly does.

    >>> offset_miss(0.5, 39), offset_miss(0.5, 40)
    (0.0, 0.25)
    """
    # An offset of 1 is 0 again.
    miss = min(abs((offset - right + 0.5) % 1 - 0.5) for right in offsets_that_mesh(teeth))
    return 0.0 if miss <= OFFSET_SLACK else miss


@lru_cache(_CACHED)
def teeth_of(params: EllipticGearParams) -> Teeth:
    """The teeth, with the smaller offset that meshes if the table gives none."""
    offset = params.tooth_offset
    if offset is None:
        offset = offsets_that_mesh(params.teeth)[0]
    return Teeth(ellipse_of(params), rack_of(params), params.teeth, offset)


def opening_of(params: EllipticGearParams) -> Opening | None:
    """The shaft opening, None without a bore.

    Raises
    ------
    GeometryError
        The keyway's width is not standard and its depth is not given.
    """
    if params.bore == 0:
        return None
    if params.keyway_width == 0:
        return Opening(params.bore)
    depth = params.keyway_depth
    if depth is None:
        key = key_of_width(params.keyway_width)
        if key is None:
            raise GeometryError(
                f"keyway_depth: no standard key is {params.keyway_width:g} mm wide; give a depth"
            )
        depth = key.hub_depth
    return Opening(params.bore, params.keyway_width, depth, params.keyway_relief)


@lru_cache(_CACHED)
def outline_of(params: EllipticGearParams) -> Outline:
    """The outline in the part frame: origin on the axis of rotation, far vertex on +x.

    Raises
    ------
    GeometryError
        The curves do not close; :func:`mechwright_elliptic_gears.checks.findings` says which parameter is to
        blame, and is to be asked first.
    """
    outer, deviation = gear_loop(teeth_of(params))
    opening = opening_of(params)
    return Outline(outer, () if opening is None else (opening.loop(),), deviation)


def part_of(params: EllipticGearParams) -> Part:
    """The gear with its features: bore, keyway, then the outside, which tabs may hold at the tips."""
    outline = outline_of(params)
    depth = params.thickness
    features: list[Feature] = []
    if params.bore > 0:
        features.append(Bore("bore", (0.0, 0.0), params.bore, 0, depth))
    if params.keyway_width > 0:
        features.append(Profile("keyway", outline.inner[0], "inside", 0, depth))
    features.append(Profile("outside", outline.outer, "outside", 0, depth, _tab_sites(outline.outer)))
    return Part(
        PART,
        outline,
        params.thickness,
        params.material,
        instances=tuple(Instance(body, colour=colour) for body, colour in BODIES.items()),
        machined=tuple(features),
    )


def _tab_sites(loop: Loop) -> tuple[tuple[Point, float], ...]:
    """The middle of every tip, where a tab's mark touches no flank, and the tip's chord as its limit."""
    sites = []
    for segment in loop.segments:
        if segment.tag == "tip":
            x, y = segment.at(0.5)[0].tolist()
            width = float(np.hypot(segment.end[0] - segment.start[0], segment.end[1] - segment.start[1]))
            sites.append(((x, y), width))
    return tuple(sites)
