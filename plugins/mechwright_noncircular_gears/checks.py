"""What an engineer would object to in a pair, and the figures worth knowing.

The checks run from the law to the mesh. Each group needs what the groups before it have found to be sound,
so the first group with an error ends the list.
"""

import math
from collections.abc import Iterator
from functools import partial

from mechwright import Finding, Stage, at_stage, kept, of_stage, until_error
from mechwright.contracts.finding import Change, errors
from mechwright.mechanics.gearing import body
from mechwright.mechanics.gearing.checks import (
    SHAFT_PRESSURE_ANGLE,
    backlash_findings,
    land_findings,
    mesh_findings,
    profile_findings,
    tip_findings,
)
from mechwright.mechanics.gearing.checks import rim_findings as opening_rim_findings
from mechwright.mechanics.gearing.usual import chosen
from mechwright.mechanics.openings import keyed_findings, too_small
from mechwright.tolerances import exceeds, falls_short
from mechwright_noncircular_gears.cures import cured
from mechwright_noncircular_gears.fields import LEAST_MODULE
from mechwright_noncircular_gears.gear import (
    NAMES,
    backlash_of,
    jamming_backlash,
    least_backlash,
    outlines_of,
    pair_of,
    rack_of,
    room,
    teeth_of,
    with_backlash,
)
from mechwright_noncircular_gears.law import extremes_of
from mechwright_noncircular_gears.law_checks import law_findings
from mechwright_noncircular_gears.params import NoncircularParams
from mechwright_noncircular_gears.parts import mill_for_fillets
from mechwright_noncircular_gears.profile import profile_of
from mechwright_noncircular_gears.proof import collides, prove
from mechwright_noncircular_gears.ring_checks import rim_findings, room_findings
from mechwright_noncircular_gears.sector_checks import sector_findings, stop_notes
from mechwright_noncircular_gears.shape_checks import convexity_findings, undercut_findings
from mechwright_noncircular_gears.softer import nearest, said
from mechwright_noncircular_gears.strength_checks import strength_findings, strength_judged
from mechwright_noncircular_gears.tip_checks import (
    LEAST_ADDENDUM,
    addendum_of,
    cusp_findings,
    fillet_findings,
)
from mechwright_noncircular_gears.usual import USUAL

LOCKED = 85.0
"""Degrees of pressure angle: at 90 the force of a tooth has no lever left about the shaft."""

ON_AXIS = 0.0005
"""A middle nearer to its axis is said to be on it, mm: half of the last digit that is told."""


@kept
def findings(params: NoncircularParams) -> tuple[Finding, ...]:
    """Everything that is to be said about a design. No error among it means that the parts can be built."""
    found = until_error(params, law_findings, _of_the_parts, _of_the_mesh, _backlash)
    return tuple(cured(params, one, _meshes) for one in found)


@kept
def standing(params: NoncircularParams) -> tuple[Finding, ...]:
    """What speaks against the motion."""
    return until_error(params, law_findings)


def judged(params: NoncircularParams) -> tuple[Finding, ...]:
    """The same without the mesh proof, and without advice."""
    return until_error(params, *_UNADVISED, _of_the_load, _backlash)


def _meshes(params: NoncircularParams) -> bool:
    """Whether gears can be made, and those in rings run: beside each other they do, but for few."""
    if errors(until_error(params, *_UNADVISED)):
        return False
    return not (params.internal and collides(params))


@kept
def _of_the_parts(params: NoncircularParams, *, advise: bool = True) -> tuple[Finding, ...]:
    hollow, undercut, cusp, fillet, drive = (
        partial(one, advise=advise)
        for one in (convexity_findings, undercut_findings, cusp_findings, fillet_findings, _drive)
    )
    teeth = (_size, _profile, hollow, room_findings, _opening, sector_findings, _land, undercut)
    tips = (cusp, _tip, fillet)
    return tuple(at_stage(Stage.PARTS, until_error(params, *teeth, *tips, _rims, rim_findings, drive)))


_UNADVISED = partial(law_findings, advise=False), partial(_of_the_parts, advise=False)
"""The law and the parts, judged alone."""


@of_stage(Stage.PARTS)
def _of_the_mesh(params: NoncircularParams) -> tuple[Finding, ...]:
    return until_error(params, _mesh, strength_findings, _figures)


@of_stage(Stage.PARTS)
def _of_the_load(params: NoncircularParams) -> Iterator[Finding]:
    yield from strength_judged(params)


def _size(params: NoncircularParams) -> Iterator[Finding]:
    m = rack_of(params).module
    if falls_short(m, LEAST_MODULE):
        most = math.floor(params.teeth * m / LEAST_MODULE)
        yield Finding.error(
            "gear.module",
            "teeth",
            f"{params.teeth} teeth at this centre distance make a module of {m:.3g} mm, "
            f"below {LEAST_MODULE:g} mm",
            m,
            LEAST_MODULE,
            "mm",
            f"use at most {most} teeth, or a larger centre_distance",
        )


def _profile(params: NoncircularParams) -> Iterator[Finding]:
    yield from profile_findings(profile_of(params))


def _land(params: NoncircularParams) -> Iterator[Finding]:
    yield from land_findings(profile_of(params), rack_of(params))


def _tip(params: NoncircularParams) -> Iterator[Finding]:
    yield from tip_findings(
        profile_of(params),
        backlash_of(params),
        lambda play: teeth_of(with_backlash(params, play)),
        "module or centre_distance",
    )


def _opening(params: NoncircularParams) -> Iterator[Finding]:
    names = ("bore", "keyway_width", "keyway_relief")
    found = list(too_small({name: getattr(params, name) for name in names}))
    if not found and params.keyway_width > 0:
        found += keyed_findings(params)
    yield from found


def _rims(params: NoncircularParams) -> Iterator[Finding]:
    rims = [
        finding
        for gear in range(1 if params.internal else 2)
        for finding in opening_rim_findings(
            params,
            rack_of(params),
            partial(room, params, gear),
            bare="law",
            roomier="use more teeth, or a law that changes its ratio less",
        )
    ]
    # Both gears have one bore: what is said of the tighter one holds for both.
    yield from sorted(rims, key=lambda one: one.value or 0.0)[:1]


def _drive(params: NoncircularParams, *, advise: bool = True) -> Iterator[Finding]:
    steepest = extremes_of(params).steepest
    angle = params.pressure_angle + math.degrees(steepest.value)
    if not exceeds(angle, SHAFT_PRESSURE_ANGLE):
        return
    most = math.radians(SHAFT_PRESSURE_ANGLE - params.pressure_angle)
    words, changes = said(
        nearest(params, lambda one: extremes_of(one).steepest.value <= most) if advise else None,
        "let the ratio change over a longer angle of the driver",
    )
    locked = not falls_short(angle, LOCKED)
    kind, limit = (Finding.error, LOCKED) if locked else (Finding.warning, SHAFT_PRESSURE_ANGLE)
    yield kind(
        "gear.pressure-angle",
        "law",
        f"the pressure angle that the shaft sees reaches {angle:.1f} degrees at "
        f"{math.degrees(steepest.angle):.1f} degrees of gear 1, above {limit:g}: "
        f"the teeth {'lock' if locked else 'push more than they turn'}",
        angle,
        limit,
        "deg",
        words,
        proposed=changes,
    )


@of_stage(Stage.MACHINING)
def _backlash(params: NoncircularParams) -> Iterator[Finding]:
    least = least_backlash(params)
    teeth = teeth_of(with_backlash(params, least))
    yield from backlash_findings(
        backlash_of(params), least, jamming_backlash(params), teeth, "module or centre_distance"
    )


def _mesh(params: NoncircularParams) -> Iterator[Finding]:
    yield from mesh_findings(prove(params), backlash_of(params), lambda: _lower(params))


def _lower(params: NoncircularParams) -> Iterator[Change]:
    """Lower teeth that clear the fillets and tips of their mates, tried."""
    heights = dict(addendum_of(params, gear) for gear in range(2))
    for less in (0.1, 0.2):
        lower = {name: round(value - less, 3) for name, value in heights.items()}
        if min(lower.values()) >= LEAST_ADDENDUM and not collides(params.model_copy(update=lower)):
            yield {f"parameters.{name}": value for name, value in lower.items()}
            return


def _figures(params: NoncircularParams) -> Iterator[Finding]:
    yield from stop_notes(params)
    yield from chosen("gear.chosen", params, USUAL)
    a, m = pair_of(params).distance, rack_of(params).module
    yield Finding.note(
        "gear.size",
        f"module {m:.4f} mm, {params.teeth} and {params.mate_teeth} teeth, centre distance {a:.4f} mm",
        a,
        "mm",
    )
    mill = mill_for_fillets(params)
    yield Finding.note(
        "gear.fillet",
        f"the largest end mill that cuts every fillet exactly has a diameter of {mill:.3f} mm",
        mill,
        "mm",
    )
    for name, outline in zip(NAMES, outlines_of(params), strict=True):
        whole, inertia = body(outline, params.thickness, params.material)
        mass, away = whole.mass, abs(whole.centre)
        unbalance = mass * away * 1e3
        middle = f"{away:.3f} mm from it: {unbalance:.4g} g·mm of unbalance" if away >= ON_AXIS else "on it"
        yield Finding.note(
            "gear.balance",
            f"{name.replace('-', ' ')}: {mass * 1e3:.1f} g, {inertia:.4g} kg·mm² about its axis, its middle "
            f"{middle}",
            unbalance,
            "g*mm",
        )
