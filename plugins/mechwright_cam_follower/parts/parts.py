"""The parts of a design, and the heights at which they stand.

From below: the cam, at z = 0; one axial gap above it the bar or lever, whose roller hangs down to it; of a
conjugate pair the second cam above, with a roller that stands up to it. A flat follower lies in the plane
of its cam, and so do its rails.
"""

import cmath
import math
from itertools import chain
from typing import Any

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
from mechwright.contracts.fits import ROLLING, shaft_fit
from mechwright.geometry.strip import strip
from mechwright.mechanics.linkage.outlines import Boss, hull_link, rectangle
from mechwright.mechanics.openings import opening_of
from mechwright.standards.screws import screw_size
from mechwright_cam_follower.kinematics.extremes import face_ends
from mechwright_cam_follower.kinematics.mechanism import Mechanism, mechanism_of
from mechwright_cam_follower.kinematics.motion import CAM, FOLLOWER, RAILS, ROLLERS
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.parts.cam_outline import outline_of
from mechwright_cam_follower.parts.follower_dimensions import (
    CORNER,
    follower_depth,
    follower_foot,
    rails_of,
    slide_height,
    slide_sides,
    studs_of,
)
from mechwright_cam_follower.parts.gauging import edge_measures
from mechwright_cam_follower.parts.slide_dimensions import bar_width, carriage_place, shaft_room
from mechwright_cam_follower.parts.spring_parts import spring_parts, spring_pin
from mechwright_cam_follower.spring.choice import spring_tail

STEEL, BRONZE, BLUE, GREY = (0.68, 0.70, 0.74), (0.80, 0.62, 0.35), (0.42, 0.55, 0.72), (0.55, 0.56, 0.58)

BOSSES = 5
"""Along a curved slot, so that the lever goes round it."""


@kept
def parts_of(params: CamParams) -> tuple[Part, ...]:
    """All parts of a design without error findings."""
    m = mechanism_of(params)
    found = [*(_cam(m, cam) for cam in m.cams), _follower(m)]
    if not m.flat:
        found += _rollers(m)
    if m.railed:
        found.append(_rail(m))
    return (*found, *spring_parts(m))


def second_foot(m: Mechanism) -> float:
    """Height of the underside of the second cam of a pair, mm."""
    return follower_foot(m) + follower_depth(m) + m.given.axial_gap


def _cam(m: Mechanism, cam: int) -> Part:
    outer, deviation = outline_of(m, cam)
    depth, opening = m.given.thickness, opening_of(m.given)
    inner: list[Loop] = []
    features: list[Feature] = []
    if opening is not None:
        inner.append(opening.loop())
        features.append(Bore("bore", (0.0, 0.0), m.given.bore, 0, depth))
        if opening.has_keyway:
            features.append(Profile("keyway", opening.loop(), "inside", 0, depth))
    for number, place in enumerate(screw_places(m), start=1):
        inner.append(_hole(place, m.given.screw_diameter))
        features.append(Bore(f"screw-{number}", place, m.given.screw_diameter, 0, depth))
    features.append(Profile("outside", outer, "outside", 0, depth))
    z = second_foot(m) if cam else 0.0
    marks = () if not m.given.conjugate else (FittingMark(_TOGETHER, (_mark(m),)),)
    return Part(
        "cam-2" if cam else "cam",
        Outline(outer, tuple(inner), deviation),
        depth,
        m.given.material,
        (Instance(CAM, z),),
        BRONZE,
        tuple(features),
        marks=marks,
        measures=edge_measures(outer),
    )


_TOGETHER = "The dots of both cams stand over each other, on +x where the turn begins."


def _mark(m: Mechanism) -> Point:
    opening = opening_of(m.given)
    out = 0.0 if opening is None else float(np.hypot(*opening.loop().flatten().T).max())
    return round(out + m.given.least_wall, 4), 0.0


def screw_places(m: Mechanism) -> list[Point]:
    """Holes of a cam on its screw circle, the first half a step from +x, mm."""
    if m.given.screw_diameter == 0:
        return []
    step, radius = math.tau / m.given.screws, m.given.screw_circle / 2
    return [
        (radius * math.cos((k + 0.5) * step), radius * math.sin((k + 0.5) * step))
        for k in range(m.given.screws)
    ]


def _follower(m: Mechanism) -> Part:
    outer = _slide_loop(m) if m.slides else _lever_loop(m)
    depth = follower_depth(m)
    holes = {} if m.slides else {"pivot": ((0.0, 0.0), m.given.pivot_bore)}
    if not m.flat:
        for number, stud in enumerate(studs_of(m), start=1):
            holes[f"stud-{number}"] = ((stud.real, stud.imag), m.given.pin_diameter)
    holes |= {**spring_pin(m), **carriage_holes(m)}
    features: list[Feature] = [Bore(name, place, size, 0, depth) for name, (place, size) in holes.items()]
    inner = [_hole(place, size) for place, size in holes.values()]
    if m.given.conjugate:
        slot = slot_of(m)
        inner.append(slot)
        features.append(Profile("slot", slot, "inside", 0, depth))
    features.append(Profile("outside", outer, "outside", 0, depth))
    return Part(
        "slide" if m.slides else "lever",
        Outline(outer, tuple(inner)),
        depth,
        m.given.material,
        (Instance(FOLLOWER, follower_foot(m)),),
        BLUE,
        tuple(features),
    )


def carriage_holes(m: Mechanism) -> dict[str, tuple[Point, Any]]:
    """Place and diameter of the holes for the screws of a carriage, by name, mm; empty without one."""
    guide = m.given.linear_guide
    if guide is None:
        return {}
    middle, size = carriage_place(m), screw_size(guide.thread).clearance()
    return {
        f"carriage-{number}": ((-across, middle + along), size)
        for number, (along, across) in enumerate(guide.carriage_holes, start=1)
    }


def _slide_loop(m: Mechanism) -> Loop:
    low, high = slide_sides(m)
    top = slide_height(m)
    if m.flat:
        corner = min(CORNER, m.value("face_margin"), (high - low) / 3)
        return rectangle(complex(low, 0.0), complex(high, top), corner).outer
    half = bar_width(m) / 2
    return hull_link([Boss(studs_of(m)[-1], half), Boss(1j * top, half)]).outer


def _lever_loop(m: Mechanism) -> Loop:
    half, tail = m.given.follower_width / 2, complex(-spring_tail(m))
    if not m.flat:
        bosses = [Boss(tail, half), Boss(0j, half), *(Boss(stud, half) for stud in studs_of(m))]
        if m.given.conjugate:
            room = shaft_room(m) + m.given.least_wall
            turns = np.linspace(m.start, m.start + m.stroke, BOSSES).tolist()
            bosses += [Boss(cmath.rect(m.axis, turn), room) for turn in turns]
        return hull_link(bosses).outer
    low, high = face_ends(m)
    margin = m.value("face_margin")
    corner = min(CORNER, margin)
    # The face is the side at y = f; its corners begin where the margin ends.
    ends = [complex(low - margin + corner, 0.0), complex(high + margin - corner, 0.0)]
    face = [Boss(end + 1j * (m.face - corner), corner) for end in ends]
    back = [Boss(end + 1j * (m.face - m.given.follower_width + corner), corner) for end in ends]
    return hull_link([Boss(tail, half), Boss(0j, half), *face, *back]).outer


def slot_of(m: Mechanism) -> Loop:
    """The slot for the shaft of a pair, clockwise, in the follower's frame."""
    room = shaft_room(m)
    path: Segment
    if m.slides:
        at, start = -m.offset, m.start
        path = Line((at, -start), (at, -start - m.stroke))
    else:
        path = Arc((0.0, 0.0), m.axis, m.start, m.stroke)
    return strip((path,), room, room, "round").reversed()


def _rollers(m: Mechanism) -> list[Part]:
    wide, stud = 2 * m.roller, m.given.axial_gap + m.given.follower_thickness
    steps = (Step(wide, m.given.thickness, shaft_fit(wide, ROLLING)), Step(m.given.pin_diameter, stud))
    found = [_roller(m, ROLLERS[0], steps, 0.0)]
    if m.given.conjugate:
        found.append(_roller(m, ROLLERS[1], steps[::-1], follower_foot(m)))
    return found


def _roller(m: Mechanism, name: str, steps: tuple[Step, ...], z: float) -> Part:
    return Part(name, None, 0, m.given.roller_material, (Instance(name, z),), STEEL, turned=Turned(steps))


def _rail(m: Mechanism) -> Part:
    rails, depth = rails_of(m), follower_depth(m)
    inset = m.given.guide_screw + m.given.least_wall
    places = [(rails.width / 2, inset), (rails.width / 2, rails.length - inset)]
    outer = rectangle(0j, complex(rails.width, rails.length), CORNER).outer
    features: list[Feature] = [
        Bore(f"screw-{number}", place, m.given.guide_screw, 0, depth)
        for number, place in enumerate(places, start=1)
    ]
    colour: Colour = GREY
    return Part(
        "rail",
        Outline(outer, tuple(_hole(place, m.given.guide_screw) for place in places)),
        depth,
        m.given.material,
        tuple(Instance(body, follower_foot(m)) for body in RAILS),
        colour,
        tuple(chain(features, [Profile("outside", outer, "outside", 0, depth)])),
        play=m.given.guide_clearance,
    )


def _hole(place: Point, diameter: float) -> Loop:
    return Loop((circle(place, diameter / 2, clockwise=True, tag="hole"),))
