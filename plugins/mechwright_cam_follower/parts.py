"""The parts of a design, and the heights at which they stand.

From below: the cam, at z = 0; one axial gap above it the bar or lever, whose roller hangs down to it; of a
conjugate pair the second cam above, with a roller that stands up to it. A flat follower lies in the plane
of its cam, and so do its rails.
"""

import cmath
import math
from itertools import chain

import numpy as np

from mechwright import (
    Arc,
    Bore,
    Colour,
    Feature,
    FittingMark,
    Instance,
    Line,
    Loop,
    Outline,
    Part,
    Point,
    Profile,
    Segment,
    Step,
    Turned,
    circle,
    kept,
)
from mechwright.geometry.strip import strip
from mechwright.mechanics.linkage.outlines import Boss, hull_link, rectangle
from mechwright.mechanics.openings import opening_of
from mechwright_cam_follower.extremes import face_of
from mechwright_cam_follower.geometry import geometry_of
from mechwright_cam_follower.motion import CAM, FOLLOWER, RAILS, ROLLERS
from mechwright_cam_follower.outline import outline_of
from mechwright_cam_follower.params import CamParams
from mechwright_cam_follower.sizes import (
    CORNER,
    bar_width,
    rails_of,
    shaft_room,
    slide_height,
    slide_sides,
    studs_of,
    swing,
)

STEEL, BRONZE, BLUE, GREY = (0.68, 0.70, 0.74), (0.80, 0.62, 0.35), (0.42, 0.55, 0.72), (0.55, 0.56, 0.58)

BOSSES = 5
"""Along a curved slot, so that the lever goes round it."""


@kept
def parts_of(params: CamParams) -> tuple[Part, ...]:
    """All parts of a design without error findings."""
    found = [_cam(params, second=False)]
    if params.conjugate:
        found.append(_cam(params, second=True))
    found.append(_follower(params))
    if params.contact == "roller":
        found += _rollers(params)
    if params.translating:
        found.append(_rail(params))
    return tuple(found)


def follower_foot(params: CamParams) -> float:
    """Height of the underside of bar, lever and rails, mm."""
    return 0.0 if params.contact == "flat" else params.thickness + params.axial_gap


def follower_depth(params: CamParams) -> float:
    """Thickness of bar, lever and rails, mm."""
    return params.thickness if params.contact == "flat" else params.follower_thickness


def second_foot(params: CamParams) -> float:
    """Height of the underside of the second cam of a pair, mm."""
    return follower_foot(params) + follower_depth(params) + params.axial_gap


def _cam(params: CamParams, *, second: bool) -> Part:
    outer, deviation = outline_of(params, second)
    depth, opening = params.thickness, opening_of(params)
    inner: list[Loop] = []
    features: list[Feature] = []
    if opening is not None:
        inner.append(opening.loop())
        features.append(
            Profile("keyway", opening.loop(), "inside", 0, depth)
            if opening.has_keyway
            else Bore("bore", (0.0, 0.0), params.bore, 0, depth)
        )
    for number, place in enumerate(screw_places(params), start=1):
        inner.append(_hole(place, params.screw_diameter))
        features.append(Bore(f"screw-{number}", place, params.screw_diameter, 0, depth))
    features.append(Profile("outside", outer, "outside", 0, depth))
    z = second_foot(params) if second else 0.0
    marks = () if not params.conjugate else (FittingMark(_TOGETHER, (_mark(params),)),)
    return Part(
        "cam-2" if second else "cam",
        Outline(outer, tuple(inner), deviation),
        depth,
        params.material,
        (Instance(CAM, z),),
        BRONZE,
        tuple(features),
        marks=marks,
    )


_TOGETHER = "The dots of both cams stand over each other, on +x where the turn begins."


def _mark(params: CamParams) -> Point:
    opening = opening_of(params)
    out = 0.0 if opening is None else float(np.hypot(*opening.loop().flatten().T).max())
    return round(out + params.least_wall, 4), 0.0


def screw_places(params: CamParams) -> list[Point]:
    """Holes of a cam on its screw circle, the first half a step from +x, mm."""
    if params.screw_diameter == 0:
        return []
    step, radius = math.tau / params.screws, params.screw_circle / 2
    return [
        (radius * math.cos((k + 0.5) * step), radius * math.sin((k + 0.5) * step))
        for k in range(params.screws)
    ]


def _follower(params: CamParams) -> Part:
    outer = _slide_loop(params) if params.translating else _lever_loop(params)
    depth = follower_depth(params)
    holes = {} if params.translating else {"pivot": ((0.0, 0.0), params.pivot_bore)}
    if params.contact == "roller":
        for number, stud in enumerate(studs_of(params), start=1):
            holes[f"stud-{number}"] = ((stud.real, stud.imag), params.pin_diameter)
    features: list[Feature] = [Bore(name, place, size, 0, depth) for name, (place, size) in holes.items()]
    inner = [_hole(place, size) for place, size in holes.values()]
    if params.conjugate:
        slot = slot_of(params)
        inner.append(slot)
        features.append(Profile("slot", slot, "inside", 0, depth))
    features.append(Profile("outside", outer, "outside", 0, depth))
    return Part(
        "slide" if params.translating else "lever",
        Outline(outer, tuple(inner)),
        depth,
        params.material,
        (Instance(FOLLOWER, follower_foot(params)),),
        BLUE,
        tuple(features),
    )


def _slide_loop(params: CamParams) -> Loop:
    low, high = slide_sides(params)
    top = slide_height(params)
    if params.contact == "flat":
        corner = min(CORNER, params.value("face_margin"), (high - low) / 3)
        return rectangle(complex(low, 0.0), complex(high, top), corner).outer
    half = bar_width(params) / 2
    return hull_link([Boss(studs_of(params)[-1], half), Boss(1j * top, half)]).outer


def _lever_loop(params: CamParams) -> Loop:
    half = params.follower_width / 2
    if params.contact == "roller":
        bosses = [Boss(0j, half), *(Boss(stud, half) for stud in studs_of(params))]
        if params.conjugate:
            first, last = swing(params)
            axis, room = params.value("centre_distance"), shaft_room(params) + params.least_wall
            bosses += [
                Boss(cmath.rect(axis, turn), room) for turn in np.linspace(first, last, BOSSES).tolist()
            ]
        return hull_link(bosses).outer
    low, high = face_of(params)
    margin = params.value("face_margin")
    corner = min(CORNER, margin)
    # The face is the side at y = f; its corners begin where the margin ends.
    ends = [complex(low - margin + corner, 0.0), complex(high + margin - corner, 0.0)]
    face = [Boss(end + 1j * (params.face - corner), corner) for end in ends]
    back = [Boss(end + 1j * (params.face - params.follower_width + corner), corner) for end in ends]
    return hull_link([Boss(0j, half), *face, *back]).outer


def slot_of(params: CamParams) -> Loop:
    """The slot for the shaft of a pair, clockwise, in the follower's frame."""
    room = shaft_room(params)
    path: Segment
    if params.translating:
        at, start = -params.value("offset"), geometry_of(params).start
        path = Line((at, -start), (at, -start - params.stroke))
    else:
        first, last = swing(params)
        path = Arc((0.0, 0.0), params.value("centre_distance"), first, last - first)
    return strip((path,), room, room, "round").reversed()


def _rollers(params: CamParams) -> list[Part]:
    wide, stud = 2 * params.value("roller_radius"), params.axial_gap + params.follower_thickness
    steps = (Step(wide, params.thickness), Step(params.pin_diameter, stud))
    found = [_roller(params, ROLLERS[0], steps, 0.0)]
    if params.conjugate:
        found.append(_roller(params, ROLLERS[1], steps[::-1], follower_foot(params)))
    return found


def _roller(params: CamParams, name: str, steps: tuple[Step, ...], z: float) -> Part:
    return Part(name, None, 0, params.roller_material, (Instance(name, z),), STEEL, turned=Turned(steps))


def _rail(params: CamParams) -> Part:
    rails, depth = rails_of(params), follower_depth(params)
    inset = params.guide_screw + params.least_wall
    places = [(rails.width / 2, inset), (rails.width / 2, rails.length - inset)]
    outer = rectangle(0j, complex(rails.width, rails.length), CORNER).outer
    features: list[Feature] = [
        Bore(f"screw-{number}", place, params.guide_screw, 0, depth)
        for number, place in enumerate(places, start=1)
    ]
    colour: Colour = GREY
    return Part(
        "rail",
        Outline(outer, tuple(_hole(place, params.guide_screw) for place in places)),
        depth,
        params.material,
        tuple(Instance(body, follower_foot(params)) for body in RAILS),
        colour,
        tuple(chain(features, [Profile("outside", outer, "outside", 0, depth)])),
        play=params.guide_clearance,
    )


def _hole(place: Point, diameter: float) -> Loop:
    return Loop((circle(place, diameter / 2, clockwise=True, tag="hole"),))
