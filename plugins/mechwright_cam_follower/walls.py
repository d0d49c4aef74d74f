"""Walls and room: errors of the parts that need no load."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import TOLERANCES, Finding, until_error
from mechwright.contracts.finding import Change
from mechwright.geometry.keyway import LEAST_WIDTH
from mechwright.mechanics.openings import keyed_findings, opening_of, too_small
from mechwright.tolerances import falls_short
from mechwright_cam_follower.cycle import cycle_of
from mechwright_cam_follower.extremes import cams_of, extremes_of
from mechwright_cam_follower.geometry import geometry_of
from mechwright_cam_follower.outline import outline_of
from mechwright_cam_follower.params import CamParams
from mechwright_cam_follower.sizes import FREE, shaft_room, studs_of

_STATIONS = 721
"""Places of a turn at which a roller is held against the whole cam."""


def wall_findings(params: CamParams) -> tuple[Finding, ...]:
    """Openings, walls, studs, and the room that rollers, levers and shafts need."""
    follower = _slide if params.translating else _lever
    return until_error(params, _openings, _cam_walls, _stud, follower, _pair, _whole)


def _openings(params: CamParams) -> Iterator[Finding]:
    names = ("bore", "keyway_width", "keyway_relief", "screw_diameter", "guide_screw", "pin_diameter")
    yield from too_small({name: getattr(params, name) for name in names})
    if params.keyway_width > 0:
        yield from keyed_findings(params)
    if params.conjugate and params.bore == 0:
        yield Finding.error(
            "follower.shaft", "bore", "two cams on one shaft need a bore", 0.0, 0.0, "mm", "set bore = 15",
            proposed=({"parameters.bore": 15.0},),
        )  # fmt: skip


def _thin(
    name: str, what: str, wall: float, params: CamParams, remedy: str, *changes: Change
) -> Iterator[Finding]:
    if falls_short(wall, params.least_wall):
        yield Finding.error(
            "follower.wall",
            name,
            f"{what} leaves {wall:.3g} mm of wall, below least_wall",
            wall,
            params.least_wall,
            "mm",
            remedy,
            proposed=changes,
        )


def farthest_of(params: CamParams) -> float:
    """How far the opening for the shaft reaches from the axis, mm."""
    opening = opening_of(params)
    return 0.0 if opening is None else float(np.hypot(*opening.loop().flatten().T).max())


def _largest_bore(params: CamParams, inner: float) -> float | None:
    """The largest bore, mm, at most the present one, that leaves the wall within a radius; None if none."""
    bore = params.bore
    while True:
        # A keyway's corners stand out of a smaller bore farther than of a larger one.
        beyond = farthest_of(params.model_copy(update={"bore": bore})) - bore / 2
        most = math.floor(20 * (inner - params.least_wall - beyond)) / 10
        if most >= bore:
            return bore
        if most < max(LEAST_WIDTH, params.keyway_width):
            return None
        bore = most


def _cam_walls(params: CamParams) -> Iterator[Finding]:
    out = farthest_of(params)
    inner = min(extremes_of(params, second).innermost.value for second in cams_of(params))
    if params.bore > 0 and falls_short(inner - out, params.least_wall):
        most = _largest_bore(params, inner)
        remedy = "make base_radius larger"
        changes: tuple[Change, ...] = ()
        if most is not None:
            remedy = f"make bore at most {most:g}, or base_radius larger"
            changes = ({"parameters.bore": most},)
        yield from _thin("bore", "the opening for the shaft", inner - out, params, remedy, *changes)
    if params.screw_diameter == 0:
        return
    ring, hole = params.screw_circle / 2, params.screw_diameter / 2
    between = 2 * ring * math.sin(math.pi / params.screws) - 2 * hole
    wanted = round(out + inner, 2)
    walls = (
        ("the screw circle, towards the shaft,", ring - hole - out),
        ("the screw circle, towards the edge,", inner - ring - hole),
    )
    for what, wall in walls:
        yield from _thin(
            "screw_circle", what, wall, params, f"make it {wanted:g}, or the holes smaller",
            {"parameters.screw_circle": wanted},
        )  # fmt: skip
    yield from _thin(
        "screws",
        "the row of screws",
        between,
        params,
        "use fewer",
        {"parameters.screws": max(2, params.screws - 1)},
    )


def _stud(params: CamParams) -> Iterator[Finding]:
    if params.contact == "flat":
        return
    most = math.floor(2 * (params.value("roller_radius") - params.least_wall / 2) * 10) / 10
    if params.pin_diameter > most:
        yield Finding.error(
            "follower.stud",
            "pin_diameter",
            f"a stud of {params.pin_diameter:g} mm is no smaller than its roller",
            params.pin_diameter,
            most,
            "mm",
            f"make it at most {most:g}, or roller_radius larger",
            proposed=({"parameters.pin_diameter": most},),
        )
        return
    wide = params.pin_diameter + 2 * params.least_wall
    yield from _thin(
        "follower_width", "the hole for the stud", (params.follower_width - params.pin_diameter) / 2, params,
        f"make follower_width {wide:g}", {"parameters.follower_width": wide},
    )  # fmt: skip


def _slide(params: CamParams) -> Iterator[Finding]:
    need = 4 * params.guide_screw + 2 * params.least_wall
    if params.guide_length < need:
        yield Finding.error(
            "follower.guide",
            "guide_length",
            f"rails of {params.guide_length:g} mm have no room for two screws of {params.guide_screw:g}",
            params.guide_length,
            need,
            "mm",
            f"make guide_length {need:g}",
            proposed=({"parameters.guide_length": need},),
        )


def _lever(params: CamParams) -> Iterator[Finding]:
    wide = params.pivot_bore + 2 * params.least_wall
    yield from _thin(
        "follower_width", "the bore of the lever", (params.follower_width - params.pivot_bore) / 2, params,
        f"make follower_width {wide:g}", {"parameters.follower_width": wide},
    )  # fmt: skip
    if params.contact == "roller":
        arm, holes = params.value("arm_length"), (params.pivot_bore + params.pin_diameter) / 2
        long = holes + params.least_wall
        yield from _thin(
            "arm_length", "the hole for the stud beside the lever's bore", arm - holes, params,
            f"make arm_length {long:g}", {"parameters.arm_length": long},
        )  # fmt: skip
    if params.contact == "flat" and params.face < params.follower_width / 2:
        yield Finding.error(
            "follower.face-offset",
            "face_offset",
            f"the lever's boss of {params.follower_width:g} mm stands out over its face",
            params.face,
            params.follower_width / 2,
            "mm",
            f"make it {params.follower_width / 2:g}, or leave it out",
            proposed=({"parameters.face_offset": None},),
        )
    reach = max(extremes_of(params, second).outermost.value for second in cams_of(params))
    boss = params.follower_width if params.contact == "flat" else params.pivot_bore
    need = math.ceil(reach + boss / 2 + FREE)
    if params.value("centre_distance") < reach + boss / 2 + FREE:
        yield Finding.error(
            "follower.room",
            "centre_distance",
            f"the cam reaches {reach:.4g} mm, up to the lever's axis",
            params.value("centre_distance"),
            reach + boss / 2 + FREE,
            "mm",
            f"make it {need:g} with a longer arm, or the cam smaller",
            proposed=({"parameters.centre_distance": float(need)},),
        )


def _pair(params: CamParams) -> Iterator[Finding]:
    """The shaft's slot has to stay clear of studs and pivot."""
    if not params.conjugate:
        return
    import shapely

    from mechwright_cam_follower.parts import slot_of

    slot = shapely.Polygon(slot_of(params).flatten())
    holes = [(stud, params.pin_diameter) for stud in studs_of(params)]
    if not params.translating:
        holes.append((0j, params.pivot_bore))
    wall = min(slot.distance(shapely.Point(at.real, at.imag)) - size / 2 for at, size in holes)
    yield from _thin(
        "base_radius",
        f"the slot for the shaft, {2 * shaft_room(params):g} mm wide,",
        wall,
        params,
        "make base_radius larger, or the bore smaller",
        {"parameters.base_radius": math.ceil(params.base_radius + params.least_wall - wall)},
    )


def _whole(params: CamParams) -> Iterator[Finding]:
    """A roller that fits each place of the cam may still meet another place of it."""
    if params.contact == "flat":
        return
    import shapely

    theta = np.linspace(0.0, math.tau, _STATIONS)
    rates, radius = cycle_of(params).at(theta), params.value("roller_radius")
    for second in cams_of(params):
        loop, deviation = outline_of(params, second)
        centre = geometry_of(params).contact(rates, second).centre * np.exp(-1j * params.sense * theta)
        cam = shapely.Polygon(loop.flatten())
        away = shapely.distance(cam, shapely.points(centre.real, centre.imag))
        worst = int(np.argmin(away))
        if not cam.is_valid or away[worst] < radius - deviation - 2 * TOLERANCES.flatten:
            yield Finding.error(
                "follower.collision",
                "base_radius",
                f"at {math.degrees(theta[worst]):.1f} degrees the roller stands "
                f"{radius - away[worst]:.3g} mm in another place of its cam",
                float(away[worst]),
                radius,
                "mm",
                "use a larger base_radius, a smaller roller, or longer angles",
                proposed=({"parameters.base_radius": math.ceil(1.2 * params.base_radius)},),
            )
            return
