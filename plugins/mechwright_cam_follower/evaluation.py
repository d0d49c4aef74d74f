"""Many cams at once: what forbids them, and their figures.

The formulas are those of one cam, asked for arrays. Segments, laws, kinds and a shaft with its key are what
all have in common.
"""

import math
from collections.abc import Collection
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, Stage
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.contracts.finding import errors
from mechwright.geometry.keyway import LEAST_WIDTH
from mechwright.mechanics.openings import keyed_findings
from mechwright.tolerances import TOLERANCES, falls_short
from mechwright_cam_follower.closure import FLATTEST, REACH, law_findings
from mechwright_cam_follower.columns import give_extremes, give_figures
from mechwright_cam_follower.extremes import regular_limit, regularity_of
from mechwright_cam_follower.geometry import Contact, prime_radius, start_of
from mechwright_cam_follower.many import Cams, Course, Measure, Seen
from mechwright_cam_follower.masses import give_masses
from mechwright_cam_follower.sizes import FREE
from mechwright_cam_follower.usual import DECIDES, fitted, left_out
from mechwright_cam_follower.walls import farthest_of

CHUNK = 2048
"""Designs that are sampled at once: enough that calls of numpy cost little."""

SURE = 0.9
"""Share of the bound up to which samples of it are trusted; it changes by far less between two of them."""

_OPENINGS = ("bore", "keyway_width", "keyway_relief", "screw_diameter", "guide_screw", "pin_diameter")
_KEYED = {"bore", "keyway_width", "keyway_depth", "keyway_relief"}


def covered(designs: Designs) -> bool:
    """Whether numbers alone are varied, and none of the opening for the shaft where that has a keyway."""
    numbers = all(values.dtype.kind in "if" for values in designs.varied.values())
    keyed = designs.common.keyway_width > 0 or "keyway_width" in designs.varied
    return numbers and not (keyed and _KEYED & set(designs.varied))


def answer(designs: Designs, columns: Collection[str], stage: Stage) -> Answer | None:
    """What is found of them; see :mod:`mechwright.contracts.by_arrays`."""
    if not covered(designs):
        return None
    designs = _fitted(designs)
    found, cams = Answer(len(designs)), Cams(designs)
    _closure(found, cams)
    left = found.left
    if not left.size:
        return found
    course = Course(cams.some(left))
    crowded, sure = course.greatest(_crowded)
    undercut = -crowded < _least_regular(course.cams)
    found.doubt(~sure, left)
    if stage is Stage.MOTION:
        found.doubt(undercut, left)  # peaks of what has edges
    else:
        found.forbid("follower.undercut", undercut, left)
        _openings(found, cams)
        _walls(found, course, left)
        give_masses(found, columns, course, left)
    give_figures(found, columns, course, left)
    give_extremes(found, columns, cams)
    return found


def _fitted(designs: Designs) -> Designs:
    """Designs of which each has the bore and the studs that it would have by itself."""
    common, varied = designs.common, dict(designs.varied)
    for name in left_out({*common.model_fields_set, *varied}, common.keyway_width > 0, common.contact):
        if DECIDES[name] & set(designs.varied):
            varied[name] = np.broadcast_to(fitted(Cams(designs), name)[:, 0], len(designs))
    return Designs(common, varied)


def _closure(found: Answer, cams: Cams) -> None:
    """What :func:`~mechwright_cam_follower.closure.closure_findings` says."""
    for fault in errors(tuple(law_findings(cams.common))):
        found.forbid(fault.code, np.ones(len(cams), dtype=bool))
    roller, prime = cams.contact == "roller", prime_radius(cams)
    if cams.translating:
        if roller:
            found.forbid("follower.offset", _all(np.abs(cams.value("offset")) >= prime * REACH, cams))
        return
    axis, start, swing = cams.value("centre_distance"), start_of(cams), math.radians(cams.stroke)
    if roller:
        arm = cams.value("arm_length")
        reaches = (np.abs(axis - arm) < prime) & (prime < axis + arm)
        found.forbid("follower.arm", ~_all(reaches, cams))
        found.forbid("follower.swing", _all((start < FLATTEST) | (start + swing > math.pi - FLATTEST), cams))
        return
    found.forbid("follower.axis", _all(prime + cams.face >= axis * math.cos(FLATTEST), cams))
    found.forbid("follower.swing", _all(start - swing < FLATTEST, cams))


def _all(values: Any, cams: Cams) -> NDArray[Any]:
    """(n,) of what is (n, 1) or one for all."""
    return np.broadcast_to(np.asarray(values).reshape(-1), len(cams))


def _crowded(seen: Seen) -> Array:
    """Least of the regularity, with its sign turned."""
    return np.asarray(-np.minimum.reduce([regularity_of(seen.cams, one) for one in seen.contacts]))


def _innermost(seen: Seen) -> Array:
    """Least radius of the cams, with its sign turned."""
    return np.asarray(-np.minimum.reduce([np.abs(one.point) for one in seen.contacts]))


def _outermost(seen: Seen) -> Array:
    return np.asarray(np.maximum.reduce([np.abs(one.point) for one in seen.contacts]))


def _least_regular(cams: Cams) -> Array:
    return _all(regular_limit(cams), cams)


def _openings(found: Answer, cams: Cams) -> None:
    for name in _OPENINGS:
        size = _all(getattr(cams, name), cams)
        found.forbid("bore.size", (size > 0) & (size < LEAST_WIDTH))
    if cams.common.keyway_width > 0:
        for fault in errors(tuple(keyed_findings(cams.common))):
            found.forbid(fault.code, np.ones(len(cams), dtype=bool))
    if cams.conjugate:
        found.forbid("follower.shaft", _all(cams.bore, cams) == 0)


def _walls(found: Answer, course: Course, left: NDArray[np.intp]) -> None:
    """What :func:`~mechwright_cam_follower.walls.wall_findings` says, in its order."""
    cams = course.cams
    wall, bore = _all(cams.least_wall, cams), _all(cams.bore, cams)
    out = bore / 2 if cams.common.keyway_width == 0 or not found.left.size else farthest_of(cams.common)
    inner = _sought(found, course, left, _innermost, -1.0)

    def thin(width: Any, asked: Any = True) -> None:
        found.forbid("follower.wall", _all(_short(width, wall) & asked, cams), left)

    thin(inner - out, bore > 0)
    hole, ring, screws = (
        _all(getattr(cams, name), cams) for name in ("screw_diameter", "screw_circle", "screws")
    )
    thin(ring / 2 - hole / 2 - out, hole > 0)
    thin(inner - ring / 2 - hole / 2, hole > 0)
    thin(ring * np.sin(math.pi / screws) - hole, hole > 0)
    width, pin = _all(cams.follower_width, cams), _all(cams.pin_diameter, cams)
    if cams.contact == "roller":
        most = np.floor(2 * (_all(cams.value("roller_radius"), cams) - wall / 2) * 10) / 10
        found.forbid("follower.stud", pin > most, left)
        thin((width - pin) / 2)
    if cams.translating:
        need = 4 * _all(cams.guide_screw, cams) + 2 * wall
        found.forbid("follower.guide", _all(cams.guide_length, cams) < need, left)
    else:
        pivot = _all(cams.pivot_bore, cams)
        thin((width - pivot) / 2)
        if cams.contact == "roller":
            thin(_all(cams.value("arm_length"), cams) - (pivot + pin) / 2)
        if cams.contact == "flat":
            found.forbid("follower.face-offset", _all(cams.face, cams) < width / 2, left)
        reach = _sought(found, course, left, _outermost)
        need = reach + (width if cams.contact == "flat" else pivot) / 2 + FREE
        found.forbid("follower.room", _all(cams.value("centre_distance"), cams) < need, left)
    if cams.conjugate:
        slot = _all(_beside_slot(cams), cams)
        found.doubt(np.abs(slot - wall) < 2 * TOLERANCES.flatten, left)  # the check has a polygon
        thin(slot)
    if cams.contact == "roller":
        found.doubt(~_clear(course), left)


def _beside_slot(cams: Cams) -> Array:
    """Least wall (n, 1) between the slot for the shaft of a pair and the holes of studs and pivot, mm.

    Each end of the shaft's way is as far from the stud beside it as it is where the follower is lowest.
    """
    start, room, stud = start_of(cams), cams.bore / 2 + FREE, cams.pin_diameter / 2
    if cams.translating:
        return np.asarray(np.maximum(np.hypot(cams.value("offset"), start) - room, 0.0) - stud)
    axis = cams.value("centre_distance")
    away = np.abs(axis * np.exp(1j * start) - cams.value("arm_length"))
    beside = np.maximum(away - room, 0.0) - stud
    return np.asarray(np.minimum(beside, np.maximum(axis - room, 0.0) - cams.pivot_bore / 2))


def _short(value: Any, limit: Any) -> NDArray[np.bool_]:
    return np.asarray(falls_short(value, limit))


def _sought(
    found: Answer, course: Course, left: NDArray[np.intp], measure: Measure, sign: float = 1.0
) -> Array:
    """The greatest of a measure, times a sign; where it is not sure, the design is undecided."""
    most, sure = course.greatest(measure)
    found.doubt(~sure, left)
    return sign * most


def _clear(course: Course) -> NDArray[np.bool_]:
    """Whether a roller meets no other place of its cam for sure.

    It would where a chord of the pitch curve, shorter than 2 R, is normal to the curve at both of its ends.
    With all places at least r off the axis, and all normals within δ of the way from the axis, such a chord
    has a length of 2 r cos δ or more.
    """
    clear = np.ones(len(course.cams), dtype=bool)
    radius = _all(course.cams.value("roller_radius"), course.cams)
    for contacts in zip(*(seen.contacts for seen in course.seen), strict=True):
        away = np.min([np.abs(one.centre).min(axis=1) for one in contacts], axis=0)
        upright = np.min([_upright(one).min(axis=1) for one in contacts], axis=0)
        clear &= radius < SURE * away * upright
    return clear


def _upright(contact: Contact) -> Array:
    """Cosine of δ, between the normal and the way from the axis to the roller's centre."""
    return np.asarray((contact.outward * np.conj(contact.centre)).real / np.abs(contact.centre))
