"""What an engineer would object to in a pair, and the figures worth knowing.

The checks run from the law to the mesh. Each group needs what the groups before it have found to be sound,
so the first group with an error ends the list.
"""

import math
from collections.abc import Iterator
from functools import partial

from mechwright import Finding, Severity, Stage, at_stage, kept, material, of_stage, until_error
from mechwright.contracts.finding import errors
from mechwright.mechanics.gearing.checks import (
    FLANK_ERROR,
    LEAST_TIP,
    SHAFT_PRESSURE_ANGLE,
    land_findings,
    least_tip,
    profile_findings,
    rim_findings,
    tip_findings,
)
from mechwright.mechanics.openings import keyed_findings, too_small
from mechwright.tolerances import exceeds, falls_short
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
from mechwright_noncircular_gears.params import LEAST_MODULE, NoncircularParams
from mechwright_noncircular_gears.parts import mill_for_fillets
from mechwright_noncircular_gears.profile import profile_of
from mechwright_noncircular_gears.proof import prove
from mechwright_noncircular_gears.shape_checks import convexity_findings, undercut_findings
from mechwright_noncircular_gears.softer import nearest, said
from mechwright_noncircular_gears.strength_checks import strength_findings


@kept
def findings(params: NoncircularParams) -> tuple[Finding, ...]:
    """Everything that is to be said about a design. No error among it means that the parts can be built."""
    return until_error(params, law_findings, _of_the_parts, _of_the_mesh, _backlash)


def judged(params: NoncircularParams) -> tuple[Finding, ...]:
    """The same without the mesh proof, and without advice on loads."""
    return until_error(params, law_findings, _of_the_parts, _of_the_load, _backlash)


@kept
def _of_the_parts(params: NoncircularParams) -> tuple[Finding, ...]:
    checks = (_size, _profile, convexity_findings, _land, undercut_findings, _tip, _opening, _drive)
    return tuple(at_stage(Stage.PARTS, until_error(params, *checks)))


@of_stage(Stage.PARTS)
def _of_the_mesh(params: NoncircularParams) -> tuple[Finding, ...]:
    return until_error(params, _mesh, strength_findings, _figures)


@of_stage(Stage.PARTS)
def _of_the_load(params: NoncircularParams) -> Iterator[Finding]:
    yield from strength_findings(params, advise=False)


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
    if errors(found):
        return
    rims = [
        finding
        for gear in range(2)
        for finding in rim_findings(
            params,
            rack_of(params),
            partial(room, params, gear),
            bare="law",
            roomier="use more teeth, or a law that changes its ratio less",
        )
    ]
    # Both gears have one bore: what is said of the tighter one holds for both.
    yield from sorted(rims, key=lambda one: one.value or 0.0)[:1]


def _drive(params: NoncircularParams) -> Iterator[Finding]:
    steepest = extremes_of(params).steepest
    angle = params.pressure_angle + math.degrees(steepest.value)
    if not exceeds(angle, SHAFT_PRESSURE_ANGLE):
        return
    most = math.radians(SHAFT_PRESSURE_ANGLE - params.pressure_angle)
    words, changes = said(
        nearest(params, lambda one: extremes_of(one).steepest.value <= most),
        "let the ratio change over a longer angle of the driver",
    )
    yield Finding.warning(
        "gear.pressure-angle",
        "law",
        f"the pressure angle that the shaft sees reaches {angle:.1f} degrees at "
        f"{math.degrees(steepest.angle):.1f} degrees of gear 1, above {SHAFT_PRESSURE_ANGLE:g}: the "
        "teeth push more than they turn",
        angle,
        SHAFT_PRESSURE_ANGLE,
        "deg",
        words,
        proposed=changes,
    )


@of_stage(Stage.MACHINING)
def _backlash(params: NoncircularParams) -> Iterator[Finding]:
    least, given = least_backlash(params), backlash_of(params)
    if not falls_short(given, least):
        return
    jams = given < jamming_backlash(params)
    does = (
        "gears as made jam: walls as they are planned"
        if jams
        else "gears as made may jam: walls and axes within tolerance"
    )
    yield Finding(
        "gear.backlash",
        Severity.ERROR if jams else Severity.WARNING,
        "backlash",
        f"{does} take up to {jamming_backlash(params) if jams else least:g} mm of the backlash",
        given,
        least,
        "mm",
        f"make backlash at least {least:g}, or leave it out"
        if least_tip(teeth_of(with_backlash(params, least))) >= LEAST_TIP
        else f"make the gears larger: with a backlash of {least:g} the teeth are too thin",
        proposed=({"parameters.backlash": least},),
    )


def _mesh(params: NoncircularParams) -> Iterator[Finding]:
    proof = prove(params)
    depth = float(proof.mesh.depth.max())
    if proof.collides:
        yield Finding.error(
            "gear.mesh",
            "addendum",
            f"the pair collides: {depth:.4f} mm deep, {proof.mesh.overlap:.4f} mm² of overlap",
            depth,
            proof.allowance,
            "mm",
            "make addendum or tip_radius smaller, dedendum larger, or use more teeth",
            proposed=(
                {"parameters.addendum": round(profile_of(params).addendum - 0.1, 3)},
                {"parameters.addendum": round(profile_of(params).addendum - 0.2, 3)},
            ),
        )
        return
    if exceeds(proof.flank_error, FLANK_ERROR):
        yield Finding.warning(
            "gear.contact",
            "addendum",
            f"a flank jumps by {proof.flank_error:.4f} mm, {proof.error * 1e6:.0f} µrad of the driven gear: "
            "a tooth leaves contact before the next one takes over",
            proof.flank_error,
            FLANK_ERROR,
            "mm",
            "make addendum larger or pressure_angle smaller, or use more teeth",
        )
    play = proof.mesh.free_play
    yield Finding.note(
        "gear.mesh",
        f"mesh proven at {play.size} positions: overlap {proof.mesh.overlap:g} mm², gap "
        f"{max(0.0, float(proof.mesh.gap.min())):.6f} to {float(proof.mesh.gap.max()):.6f} mm, transmission "
        f"error {proof.error * 1e6:.1f} µrad peak to peak"
        + (
            f" over that of the backlash, {proof.mesh.transmission_error * 1e6:.0f} µrad in all"
            if backlash_of(params)
            else ""
        ),
        proof.error * 1e6,
        "µrad",
    )


def _figures(params: NoncircularParams) -> Iterator[Finding]:
    density = material(params.material).density * 1e-6  # g/cm³ to kg/mm³
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
        mass = outline.area * params.thickness * density
        inertia = outline.polar_moment * params.thickness * density
        _, x, y, *_ = outline.moments
        away = math.hypot(x, y) / outline.area
        unbalance = mass * away * 1e3
        yield Finding.note(
            "gear.balance",
            f"{name.replace('-', ' ')}: {mass * 1e3:.1f} g, {inertia:.4g} kg·mm² about its axis, its middle "
            f"{away:.3f} mm from it: {unbalance:.4g} g·mm of unbalance",
            unbalance,
            "g*mm",
        )
