"""What an engineer would object to in a design, and the figures worth knowing.

The checks run from the rack to the mesh. Each group needs what the groups before it have found to be sound,
so the first group with an error ends the list.
"""

import math
from collections.abc import Iterator
from functools import partial

from mechwright import (
    Finding,
    Stage,
    at_stage,
    kept,
    of_stage,
    until_error,
)
from mechwright.mechanics.gearing import body
from mechwright.mechanics.gearing.checks import (
    SHAFT_PRESSURE_ANGLE,
    backlash_findings,
    collision,
    land_findings,
    least_tip,
    mesh_findings,
    profile_findings,
    tip_findings,
)
from mechwright.mechanics.gearing.usual import chosen
from mechwright.tolerances import exceeds, falls_short
from mechwright_elliptic_gears.kinematics.equations import steepest_shaft_pressure_angle
from mechwright_elliptic_gears.parameters import LEAST_MODULE, EllipticGearParams
from mechwright_elliptic_gears.parts.backlash import (
    backlash_of,
    jamming_backlash,
    least_backlash,
    with_backlash,
)
from mechwright_elliptic_gears.parts.defaults import USUAL
from mechwright_elliptic_gears.parts.gear import (
    ellipse_of,
    fillet_mill,
    outline_of,
    rack_of,
    teeth_of,
)
from mechwright_elliptic_gears.parts.mesh_proof import first_collision, prove
from mechwright_elliptic_gears.parts.tip_reach import may_collide, that_clear
from mechwright_elliptic_gears.parts.tooth_offset import offset_miss, offsets_that_mesh
from mechwright_elliptic_gears.rules.opening import opening_findings
from mechwright_elliptic_gears.rules.strength import strength_findings
from mechwright_elliptic_gears.rules.train import train_findings
from mechwright_elliptic_gears.rules.undercut import undercut_findings


@kept
def findings(params: EllipticGearParams) -> tuple[Finding, ...]:
    """Everything that is to be said about a design. No error among it means that the part can be built.

    All of it is about the parts, for the pitch ellipses of every design roll on each other; only the backlash
    is about what machining leaves of them.
    """
    return until_error(params, _of_the_parts, _of_the_mesh, _backlash)


def judged(params: EllipticGearParams) -> tuple[Finding, ...]:
    """The same with the mesh proof only where tips may collide, and without advice on loads."""
    parts = partial(_of_the_parts, noted=False)
    return until_error(params, parts, _of_the_doubtful_mesh, _of_the_load, _backlash)


@kept
def _of_the_parts(params: EllipticGearParams, *, noted: bool = True) -> tuple[Finding, ...]:
    trains = partial(train_findings, noted=noted)
    checks = (_rack, undercut_findings, _tip, opening_findings, trains, _drive)
    return tuple(at_stage(Stage.PARTS, until_error(params, *checks)))


@of_stage(Stage.PARTS)
def _of_the_mesh(params: EllipticGearParams) -> tuple[Finding, ...]:
    return until_error(params, _mesh, strength_findings, _figures)


@of_stage(Stage.PARTS)
def _of_the_doubtful_mesh(params: EllipticGearParams) -> Iterator[Finding]:
    if may_collide(params):
        depth, allowance = first_collision(params)
        if depth:
            yield collision(depth, allowance, f"at least {depth:.4f} mm deep", lambda: that_clear(params))


@of_stage(Stage.PARTS)
def _of_the_load(params: EllipticGearParams) -> Iterator[Finding]:
    yield from strength_findings(params, advise=False)


def _rack(params: EllipticGearParams) -> Iterator[Finding]:
    """What must hold before any curve is drawn."""
    rack = rack_of(params)
    m = rack.module
    if falls_short(m, LEAST_MODULE):
        most = math.floor(params.teeth * m / LEAST_MODULE)
        yield Finding.error(
            "gear.module",
            "teeth",
            f"{params.teeth} teeth on this ellipse make a module of {m:.3g} mm, below {LEAST_MODULE:g} mm",
            m,
            LEAST_MODULE,
            "mm",
            f"use at most {most} teeth, or a larger semi_major",
        )
    if params.tooth_offset is not None:
        right = offsets_that_mesh(params.teeth)
        if offset_miss(params.tooth_offset, params.teeth) > 0:
            nearest = min(right, key=lambda value: abs((params.tooth_offset or 0.0) - value))
            parity = "odd" if params.teeth % 2 else "even"
            yield Finding.error(
                "gear.phase",
                "tooth_offset",
                f"wrong phase: with a tooth {params.tooth_offset:g} pitches from the far vertex, two gears "
                f"of {params.teeth} teeth collide",
                params.tooth_offset,
                nearest,
                remedy=f"{parity} numbers of teeth need {right[0]:g} or {right[1]:g}",
                proposed=({"parameters.tooth_offset": nearest},),
            )
    yield from profile_findings(params)
    tightest = ellipse_of(params).least_radius
    if rack.dedendum >= tightest:
        yield Finding.error(
            "gear.convexity",
            "dedendum",
            f"the root lies {rack.dedendum:.3f} mm inside an ellipse that is curved by {tightest:.3f} mm at "
            "the ends of its major axis: its offset curve crosses itself",
            params.dedendum,
            tightest / rack.module,
            remedy="use more teeth, a smaller eccentricity or a smaller dedendum",
        )
    yield from land_findings(params, rack)


def _tip(params: EllipticGearParams) -> Iterator[Finding]:
    """The backlash is to blame where the teeth would be thick enough without one."""
    size = "module or semi_major"
    yield from tip_findings(
        params, backlash_of(params), lambda play: [teeth_of(with_backlash(params, play))], size
    )


def _tip_width(params: EllipticGearParams) -> float:
    return least_tip([teeth_of(params)])


def _drive(params: EllipticGearParams) -> Iterator[Finding]:
    angle = math.degrees(
        steepest_shaft_pressure_angle(params.eccentricity, math.radians(params.pressure_angle))
    )
    if exceeds(angle, SHAFT_PRESSURE_ANGLE):
        most = math.sin(math.radians(SHAFT_PRESSURE_ANGLE - params.pressure_angle))
        yield Finding.warning(
            "gear.pressure-angle",
            "eccentricity",
            f"the pressure angle that the shaft sees reaches {angle:.1f} degrees at e = "
            f"{params.eccentricity:g}, above {SHAFT_PRESSURE_ANGLE:g}: the teeth push more than they turn",
            angle,
            SHAFT_PRESSURE_ANGLE,
            "deg",
            f"make eccentricity at most {math.floor(round(most * 1e3, 6)) / 1e3:g}, or let a coupler between "
            "the free foci carry the steep part",
        )


@of_stage(Stage.MACHINING)
def _backlash(params: EllipticGearParams) -> Iterator[Finding]:
    least = least_backlash(params)
    yield from backlash_findings(
        backlash_of(params),
        least,
        jamming_backlash(params),
        [teeth_of(with_backlash(params, least))],
        "module or semi_major",
    )


def _mesh(params: EllipticGearParams) -> Iterator[Finding]:
    yield from mesh_findings(prove(params), backlash_of(params), lambda: that_clear(params))


def _figures(params: EllipticGearParams) -> Iterator[Finding]:
    rack, ellipse, outline = rack_of(params), ellipse_of(params), outline_of(params)
    yield from chosen("gear.chosen", params, USUAL)
    whole, inertia = body(outline, params.thickness, params.material)
    yield Finding.note(
        "gear.size",
        f"module {rack.module:.4f} mm, semi-axes {ellipse.semi_major:.4f} and "
        f"{ellipse.semi_minor:.4f} mm, centre distance {2 * ellipse.semi_major:.4f} mm; each "
        f"gear {whole.mass * 1e3:.1f} g, {inertia:.4g} kg·mm² about its axis",
        2 * ellipse.semi_major,
        "mm",
    )
    mill = fillet_mill(params)
    yield Finding.note(
        "gear.fillet",
        f"the largest end mill that cuts every fillet exactly has a diameter of {mill:.3f} mm",
        mill,
        "mm",
    )
