"""Whether bevel drive, post, base plate and flat strips have room."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import DesignRule, Finding, Procedure, Severity, Stage
from mechwright.contracts.design_rule import Failure
from mechwright.contracts.design_table import items
from mechwright.contracts.finding import at_stage
from mechwright.tolerances import falls_short
from mechwright_spherical.defaults.preferred_sizes import least_boss
from mechwright_spherical.kinematics.drive import Train, internal, train_of
from mechwright_spherical.kinematics.vectors import arc
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.flat import leg_of
from mechwright_spherical.parts.frame import AIR, ground_arcs, ground_beyond
from mechwright_spherical.parts.hardware import StandTable
from mechwright_spherical.parts.places import gear_span, second_size
from mechwright_spherical.parts.stand import MOUNTING_SCREWS, flange_diameter
from mechwright_spherical.table import SphericalTable

Rule = DesignRule[SphericalTable]
Fails = Failure[SphericalTable]

LONGEST_GROUND = 330.0
"""Degrees of the ground link from post to far axis: with more, its ends meet."""


def _drive(m: SphericalTable) -> Iterator[Finding]:
    params, mechanism = m.params, m.linkage.five_bar
    if mechanism is None or not params.drive.gears:
        return
    train = train_of(m.linkage, params.drive)
    shafts = float(arc(mechanism.a0, mechanism.b0))
    if train is None:
        least = math.degrees((1 - params.drive.share) * shafts / 2)
        yield Finding.error(
            "spherical.drive",
            "drive.idler",
            f"an idler of {params.drive.idler:g}° does not reach both gears",
            params.drive.idler,
            least,
            "deg",
            f"use more than {least:.4g}°, or a larger share",
        )
        return
    yield from _cones(m, train)
    said = f"pitch cones of {_cone(train.pinion)} on the crank and {_cone(train.wheel)} on the arm"
    if train.idler_axis is not None:
        said += f", an idler of {_cone(train.idler)}"
        if mechanism.ratio < 1:
            inner, outer = internal(shafts, mechanism.ratio)
            said += f"; an internal pair would have {_cone(inner)} and {_cone(outer)}"
    yield Finding("spherical.drive", Severity.NOTE, "drive", said)


def _cone(angle: float) -> str:
    return f"{math.degrees(angle):.4f}°"


def _cones(m: SphericalTable, train: Train) -> Iterator[Finding]:
    hardware = m.params.hardware
    inner, _ = gear_span(m.params, m.shells, train)
    least = least_boss(hardware.pin_diameter, hardware.fit)
    cones = {"pinion": train.pinion, "wheel": train.wheel}
    if train.idler_axis is not None:
        cones["idler"] = train.idler
    for name, angle in cones.items():
        diameter = 2 * inner * math.sin(angle)
        if falls_short(diameter, least) or angle >= math.pi / 2:
            yield Finding.error(
                "spherical.drive",
                "drive.idler" if name == "idler" else "drive.share",
                f"the {name} has a pitch diameter of {diameter:.4g} mm at its small end, or is no cone",
                diameter,
                least,
                "mm",
                f"it needs {least:g} mm: use a larger radius, thinner pins, or no gears",
            )


DRIVE = Procedure[SphericalTable](
    ("spherical.drive",),
    lambda m: at_stage(Stage.PARTS, _drive(m)),
    when=lambda t: t.single,
    stage=Stage.PARTS,
)
"""Of five-bars, which are single designs."""


def _whole(t: SphericalTable) -> Any:
    """The ground link from post to far axis, degrees."""
    beyond = ground_beyond(t.params) if t.single else np.radians(t.params.stand.arc)
    return np.degrees(t.arcs["ground"] + beyond)


def _post(t: SphericalTable) -> Any:
    """The least arc, rad, between the input axis with what is on it, and the middle of the post."""
    stand, hardware, radius = t.params.stand, t.params.hardware, t.shells.outside
    wide = np.maximum(hardware.boss_diameter, flange_diameter(stand) * radius / (radius + stand.height))
    needed = np.arctan2(hardware.boss_diameter / 2 + AIR, radius)
    train = train_of(t.linkage, t.params.drive) if t.single else None
    if train is not None:
        needed = np.maximum(needed, train.pinion)
    return needed + np.arctan2(wide / 2, radius)


def _rim(stand: StandTable) -> Any:
    """From the middle of a mounting hole to the edge of the plate, mm."""
    return (0.5 - abs(MOUNTING_SCREWS[0][0])) * stand.plate


def _largest_screw(f: Fails) -> float:
    stand = f.m.params.stand
    within: float = (stand.plate / 2 - (flange_diameter(stand) / 2 - 1.5 * stand.screw)) / 1.5
    return min(float(_rim(stand)), within)


STAND = (
    Rule(
        "spherical.stand",
        "stand.arc",
        "the ground link would be an arc of {value:.4g}°",
        value=_whole,
        limit=LONGEST_GROUND,
        unit="deg",
        remedy=lambda f: f"use at most {LONGEST_GROUND - f.value + f.m.params.stand.arc:.4g}°",
        must_be="at most",
    ),
    Rule(
        "spherical.stand",
        "stand.arc",
        "post and flange stand in the way of what sits on the input axis",
        value=lambda t: np.radians(t.params.stand.arc),
        limit=_post,
        unit="deg",
        remedy=lambda f: (
            f"use {math.ceil(10 * math.degrees(f.limit)) / 10:g}° or more, a smaller plate, or a higher post"
        ),
        reported=lambda f: (f.m.params.stand.arc, math.degrees(f.limit)),
    ),
    Rule(
        "spherical.stand",
        "stand.screw",
        "screws of {m.params.stand.screw:g} mm are too large for a base plate of {m.params.stand.plate:g} mm",
        # Mounting holes, a screw's head of material around them, and the flange must all fit on the plate.
        value=lambda t: items([_rim(t.params.stand), -flange_diameter(t.params.stand)], t.size),
        limit=lambda t: items([t.params.stand.screw, -t.params.stand.plate], t.size),
        unit="mm",
        remedy=lambda f: f"use at most {math.floor(100 * _largest_screw(f)) / 100:g} mm, or a larger plate",
        reported=lambda f: (f.m.params.stand.screw, _largest_screw(f)),
        each=False,
    ),
    Rule(
        "spherical.stand",
        "stand.height",
        "the flange is thicker than the post is high",
        value=lambda t: t.params.stand.height,
        limit=lambda t: t.params.hardware.link_thickness,
        unit="mm",
        remedy="make the post {limit:g} mm at least",
    ),
)
"""Of the ground link, the post, the base plate, and the flange of the post."""


def _legs(t: SphericalTable) -> list[tuple[str, Any]]:
    """Links that strips are made of, and the length of each between a bore and its nearest bend, mm."""
    arcs = dict(t.arcs)
    if t.single:
        arcs |= ground_arcs(t.params) | second_size(t.linkage, t.shells)
    links = [*arcs.items(), *(("coupler", angle) for angle in t.coupler_arcs)]
    return [(name, leg_of(angle, t.shells.arc(name)[0], t.params.flat)) for name, angle in links]


def _strip_message(f: Fails) -> str:
    return (
        f"the strip of the {_legs(f.m)[f.item][0]} has {f.value:.4g} mm between bore and bend, and its "
        f"round end takes {f.limit:g} mm"
    )


STRIPS = Rule(
    "spherical.strip",
    "flat.bend_radius",
    _strip_message,
    value=lambda t: items([leg for _, leg in _legs(t)], t.size),
    limit=lambda t: t.params.hardware.boss_diameter / 2,
    unit="mm",
    remedy="use a smaller flat.bend_radius, smaller bosses or a larger radius, or leave flat.make out",
    proposed=lambda _: ({"parameters.flat.make": None},),
    when=lambda t: t.params.flat.make is True,
)

_FIRST_TOO_SHORT = STRIPS.but(when=None, each=False)


def makes_strips(params: SphericalParams) -> bool:
    """Whether links are made as flat strips: as the design says, or where all of them can be bent."""
    if params.flat.make is not None:
        return params.flat.make
    return not any(_FIRST_TOO_SHORT.findings(SphericalTable.of(params), quick=True))


def _no_strips(m: SphericalTable) -> Iterator[Finding]:
    """A note where strips are left out because they cannot be bent."""
    for error in _FIRST_TOO_SHORT.findings(m, quick=False):
        yield Finding.note(
            "spherical.strip",
            f"links are not made as flat strips: {error.message}; "
            "a smaller flat.bend_radius would leave more",
            error.value,
            "mm",
        )


NO_STRIPS = Procedure[SphericalTable](
    ("spherical.strip",),
    lambda m: at_stage(Stage.PARTS, _no_strips(m)),
    when=lambda t: t.params.flat.make is None,
    warns=True,
)
