"""The parts: plates, gears, shafts, pins, studs, bushings, clamps and posts, each where it stands.

The scales of the coupler's slots: angles of crank and rocker from X in the pose of setting.
"""

import cmath
import math
from collections.abc import Mapping
from dataclasses import replace

from mechwright import Colour, Engraving, FittingMark, Instance, Part, Step, Turned
from mechwright.contracts.holes import threaded
from mechwright.contracts.part import Bore
from mechwright.mechanics.gearing import gear_measures
from mechwright.mechanics.linkage import BUSHING_MATERIAL, PIN_MATERIAL, bushing_part, pin_part
from mechwright.mechanics.linkage.clamp import screw_parts, stud_part
from mechwright.mechanics.linkage.scale import scale
from mechwright.mechanics.linkage.turned import SHAFT, STEEL
from mechwright.standards.screws import washer
from mechwright_five_bar.kinematics.dimensions import bar_of
from mechwright_five_bar.kinematics.phases import pose_angles, settings_of
from mechwright_five_bar.kinematics.train import gear_teeth
from mechwright_five_bar.parameters import FiveBarParams
from mechwright_five_bar.parts.frames import fixed_frames
from mechwright_five_bar.parts.hardware import clamp_of_design, head_of, running_bore, turning_bore
from mechwright_five_bar.parts.hub import Hub, hub_of
from mechwright_five_bar.parts.joints import joints_of, slotted
from mechwright_five_bar.parts.layout import Layout, post_radius
from mechwright_five_bar.table import FiveBarTable


def scales(params: FiveBarParams) -> Mapping[str, tuple[Engraving, ...]]:
    """Plate to its engravings; ``params`` shows its first phase."""
    clamp = clamp_of_design(params)
    if not params.phases or clamp is None:
        return {}
    found = []
    for (one, places), first, name in zip(
        settings_of(params), pose_angles(params), ("crank_turn", "rocker_turn"), strict=True
    ):
        if one.slot is not None:
            turns = [0.0, *(float(getattr(row, name)) for row in params.phases)]
            angles = [math.remainder(first + turn, 360.0) for turn in turns]
            found.append(scale(f"scale-{one.name.lower()}", one.slot, places, angles, clamp.reach))
    return {"coupler": tuple(found)} if found else {}


BELOW = 2.0
"""Air between the lowest head and what the posts stand on, mm."""

COLOURS: Mapping[str, Colour] = {
    "ground": (0.62, 0.64, 0.66),
    "crank": (0.78, 0.36, 0.30),
    "arm": (0.80, 0.68, 0.42),
    "rocker": (0.42, 0.62, 0.45),
    "coupler": (0.45, 0.58, 0.70),
    "pinion": (0.72, 0.50, 0.44),
    "idler": (0.60, 0.58, 0.52),
    "wheel": (0.76, 0.68, 0.50),
    "clamp": (0.50, 0.47, 0.62),
}

BODIES = {"pinion": "crank", "clamp": "arm"}
"""Plates that belong to another body than their own."""


def parts_of(m: FiveBarTable) -> tuple[Part, ...]:
    """All parts of a design; raises as :attr:`FiveBarTable.layout`."""
    params, layout, hub = m.params, m.layout, hub_of(m.params)
    return (
        *_plates(params, layout, hub),
        *_pins(params, layout),
        *_bushings(m),
        *_clamps(m, hub),
        *_posts(m, hub),
    )


def phase_mark(params: FiveBarParams, *, clamped: bool) -> FittingMark:
    """How crank and arm stand to each other as the wheel is fastened: any tooth fits, one angle is right."""
    crank, arm = set_angles(params)
    how = (
        "Before these are tight, turn the wheel on its shaft until this is so; its threads have to show "
        "through the slots of the clamp, else put it on some teeth further."
        if clamped
        else "The wheel goes on, and its compound cures, as this is so."
    )
    return FittingMark(
        f"The crank stands at {crank:.1f}° and the arm at {arm:.1f}°, both counter-clockwise from the line "
        f"from A0 to B0, seen from above. {how}"
    )


def set_angles(params: FiveBarParams) -> tuple[float, float]:
    """Angles of crank and arm from the line A0 B0 in the pose of setting, degrees from 0 to 360.

    Without one it is the begin of the crank's swing, or a crank on the line. The gears alone tell the arm's.
    """
    crank = params.setting_angle
    if crank is None:
        crank = params.swing_from or 0.0
    _, b1 = bar_of(params).pivots(math.radians(crank))
    arm = math.degrees(cmath.phase(complex(b1) - params.ground))
    return crank % 360.0, arm % 360.0


def thickness_of(params: FiveBarParams, name: str) -> float:
    """Of a plate, mm."""
    if name == "ground":
        return params.ground_thickness
    return params.gear_thickness if name in {"pinion", "idler", "wheel", "clamp"} else params.thickness


def _plates(params: FiveBarParams, layout: Layout, hub: Hub | None) -> list[Part]:
    marks, gears, found = scales(params), gear_teeth(params), []
    for name, colour in COLOURS.items():
        if name not in layout.outlines:
            continue
        thickness = thickness_of(params, name)
        part = Part(
            name,
            layout.outlines[name],
            thickness,
            params.material,
            (Instance(BODIES.get(name, name), layout.heights[name]),),
            colour,
            details=marks.get(name, ()),
            measures=gear_measures(gears[name]) if name in gears else (),
        )
        if name == "wheel" and hub is None:
            part = replace(part, marks=(phase_mark(params, clamped=False),))
        if name == "wheel" and hub is not None:
            for feature in part.features:
                if isinstance(feature, Bore) and abs(complex(*feature.centre)) > params.pin_diameter:
                    part = threaded(part, feature.name, f"M{hub.clamp.size.size:g}")
        found.append(part)
    return found


def spans_of(params: FiveBarParams, layout: Layout) -> dict[str, tuple[float, float]]:
    """Heights of the lower and the upper end of each pin, heads left out, mm."""
    found = dict(layout.stack.spans)
    low, high = found["shaft-a0"]
    found["shaft-a0"] = low - SHAFT * params.pin_diameter, high
    if "clamp" in layout.heights:
        found["shaft-b0"] = layout.heights["clamp"], found["shaft-b0"][1]
    height = head_of(params)[1]
    for name in ("pin-a", "pin-c"):
        if slotted(params, name[-1].upper()):
            found[name] = found[name][0] + height, layout.heights["coupler"]
    return found


def _pins(params: FiveBarParams, layout: Layout) -> list[Part]:
    spans, diameter, head = spans_of(params, layout), params.pin_diameter, head_of(params)
    frames = {"shaft-a0": "crank", "shaft-b0": "arm", "pin-b1": "arm-b1", "pin-idler": "ground-idler"}
    frames |= {"pin-a": "crank-a", "pin-c": "rocker-c"}
    parts = []
    for name, one in joints_of(params).items():
        low, high = spans[name]
        if name == "pin-idler":
            steps = (Step(head[0], head[1]), Step(diameter, high - low))
            at = Instance(frames[name], low - head[1])
            parts.append(Part(name, None, 0.0, PIN_MATERIAL, (at,), STEEL, turned=Turned(steps)))
        elif one.stud:
            clamp = clamp_of_design(params)
            assert clamp is not None  # noqa: S101 - a slot without a clamp is an error
            at = Instance("coupler" if name == "pin-a" else "coupler-c", low - head[1])
            parts.append(stud_part(name, diameter, high - low, head, clamp, at))
        else:
            on_top = head if one.head else (0.0, 0.0)
            parts.append(pin_part(name, diameter, high - low, (Instance(frames[name], low),), *on_top))
    return parts


def bushings_of(m: FiveBarTable) -> dict[str, tuple[str, ...]]:
    """Plate to the frames of the bores in which something turns on a bushing."""
    found: dict[str, tuple[str, ...]] = {"ground": ("ground", "ground-b0"), "rocker": ("rocker",)}
    coupler: list[str] = []
    for name, link, end, own in (
        ("A", "crank", "crank-a", "coupler"),
        ("C", "rocker", "rocker-c", "coupler-c"),
    ):
        if slotted(m.params, name):
            found[link] = (*found.get(link, ()), end)
        else:
            spare = [frame for frame in fixed_frames(m) if frame.startswith(f"coupler-{name.lower()}")]
            coupler += dict.fromkeys([own, *spare])
    if coupler:
        found["coupler"] = tuple(coupler)
    if m.params.idler_teeth:
        found["idler"] = ("idler",)
    return found


PRESSED = {
    "shaft-a0": "crank",
    "shaft-b0": "arm",
    "pin-a": "crank",
    "pin-b1": "arm",
    "pin-c": "rocker",
    "pin-idler": "ground",
}
"""Pins to the plate that each is pressed into, or hangs by, on which the others' bushings lie."""


def protrusion(params: FiveBarParams, layout: Layout, plate: str, frame: str) -> tuple[float, float]:
    """How far a plate's bushing stands out below and above it, mm: to the plate next to it on its pin."""
    joint = _joint_of(plate, frame)
    if joint is None or joints_of(params)[joint].stud:
        return 0.0, 0.0
    other, heights = PRESSED[joint], layout.heights
    low, bottom = heights[plate], heights[other]
    high, top = low + thickness_of(params, plate), bottom + thickness_of(params, other)
    if math.isclose(low - top, params.washer, abs_tol=NEXT):
        return params.washer, 0.0
    if math.isclose(bottom - high, params.washer, abs_tol=NEXT):
        return 0.0, params.washer
    return 0.0, 0.0


NEXT = 1e-6
"""Plates are next to each other where the gap between them, mm, is that of all layers within this."""


def _joint_of(plate: str, frame: str) -> str | None:
    """The pin or shaft on which a bushing turns; None of a stud's."""
    if plate == "coupler":
        return "pin-c" if frame.startswith("coupler-c") else "pin-a"
    known = {"ground": "shaft-a0", "ground-b0": "shaft-b0", "rocker": "pin-b1", "idler": "pin-idler"}
    return known.get(frame)


def _bushings(m: FiveBarTable) -> list[Part]:
    params, layout = m.params, m.layout
    if params.bushing_wall == 0:
        return []
    by_length: dict[float, list[Instance]] = {}
    out: dict[float, float] = {}
    for plate, frames in bushings_of(m).items():
        for frame in frames:
            below, above = protrusion(params, layout, plate, frame)
            length = round(thickness_of(params, plate) + below + above, 6)
            by_length.setdefault(length, []).append(Instance(frame, layout.heights[plate] - below))
            out[length] = max(below + above, out.get(length, 0.0))
    spare = ("bore",) if params.phases else ()  # those of other phases have no pin
    return [
        replace(
            bushing_part(
                "bushing" if number == 0 else f"bushing-{number + 1}",
                running_bore(params),
                turning_bore(params),
                length,
                instances,
                BUSHING_MATERIAL,
                spaces=out[length],
            ),
            vacant=spare,
        )
        for number, (length, instances) in enumerate(by_length.items())
    ]


def _clamps(m: FiveBarTable, hub: Hub | None) -> list[Part]:
    """Screws and washers on the coupler, and under the disc that clamps the arm's gear."""
    params, layout = m.params, m.layout
    found: list[Part] = []
    top = layout.heights["coupler"] + params.thickness
    frames = [frame for name, frame in (("A", "coupler"), ("C", "coupler-c")) if slotted(params, name)]
    clamp = clamp_of_design(params)
    if frames and clamp is not None:
        found += screw_parts("clamp", clamp, [Instance(frame, top) for frame in frames])
    if hub is not None:
        names = [name for name in fixed_frames(m) if name.startswith("wheel-screw")]
        seats = [Instance(name, layout.heights["clamp"]) for name in names]
        screws = screw_parts("hub", hub.clamp, seats, upwards=True)
        found += [
            replace(one, marks=(phase_mark(params, clamped=True),)) if one.name == "hub-screw" else one
            for one in screws
        ]
    return found


def _posts(m: FiveBarTable, hub: Hub | None) -> list[Part]:
    """Feet pressed into the ground plate from below, long enough for what hangs under it; or none."""
    params, layout = m.params, m.layout
    if params.screw_hole is not None:
        return []
    low = layout.heights["pinion"] - head_of(params)[1]
    if hub is not None:
        low = layout.heights["clamp"] - washer(hub.clamp.size.size).height - hub.clamp.size.head_height
    foot = low - BELOW
    steps = (
        Step(2 * post_radius(params), layout.heights["ground"] - foot),
        Step(params.pin_diameter, params.ground_thickness),
    )
    frames = [name for name in fixed_frames(m) if name.startswith("ground-post")]
    instances = tuple(Instance(frame, foot) for frame in frames)
    return [Part("post", None, 0.0, params.material, instances, COLOURS["ground"], turned=Turned(steps))]
