"""What forbids teeth of any pitch curve: the rack's own shape, its land, and tips that are too thin."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Protocol

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.finding import Change, Finding, Severity
from mechwright.contracts.keyed import Keyed
from mechwright.errors import GeometryError
from mechwright.mechanics.gearing.proof import MeshProof
from mechwright.mechanics.gearing.rack import Rack
from mechwright.mechanics.gearing.teeth import Teeth
from mechwright.mechanics.openings import opening_of
from mechwright.tolerances import exceeds, falls_short

LEAST_TIP = 0.2
"""Narrowest tip land in modules: the usual least of gear standards for teeth that are not case-hardened;
thinner tips break out."""

LEAST_CLEARANCE = 0.1
"""Modules between tip and root below which dirt and run-out make them touch (ISO 53 racks have 0.25)."""

SHAFT_PRESSURE_ANGLE = 50.0
"""Degrees above which the flanks mainly push the shafts apart and friction may block the drive."""

FLANK_ERROR = 0.002
"""Jump of a flank, mm, that no longer comes from fitting: contact is lost between two teeth."""


LEAST_RIM = 1.0
"""Thinnest rim between opening and root, in modules: thinner ones give way under the tooth's load."""

FULL_RIM = 1.2
"""Rim in whole tooth depths from which it no longer weakens the teeth (the backup ratio of AGMA 2001)."""


class Profile(Protocol):
    """What a design table says of its rack: in modules, and degrees."""

    @property
    def pressure_angle(self) -> float:
        """Degrees."""

    @property
    def addendum(self) -> float:
        """Tooth height over the pitch curve."""

    @property
    def dedendum(self) -> float:
        """Depth below it."""

    @property
    def tip_radius(self) -> float:
        """At the tip of the rack."""

    @property
    def backlash(self) -> float | None:
        """mm; None where the design leaves it to the family."""


def profile_findings(profile: Profile) -> Iterator[Finding]:
    """What must hold of the rack by itself."""
    if profile.tip_radius >= profile.dedendum:
        yield Finding.error(
            "gear.rack",
            "tip_radius",
            "the tip arc of the rack is deeper than its tooth",
            profile.tip_radius,
            profile.dedendum,
            remedy="make tip_radius smaller than dedendum",
        )
    clearance = profile.dedendum - profile.addendum
    if falls_short(clearance, LEAST_CLEARANCE):
        yield Finding(
            "gear.clearance",
            Severity.ERROR if clearance <= 0 else Severity.WARNING,
            "dedendum",
            f"tips run {clearance:.3g} modules from the mating roots, below {LEAST_CLEARANCE:g}",
            profile.dedendum,
            profile.addendum + LEAST_CLEARANCE,
            "",
            f"make dedendum at least {profile.addendum + LEAST_CLEARANCE:g}, or addendum smaller",
        )


def land_findings(profile: Profile, rack: Rack) -> Iterator[Finding]:
    """Whether a tooth of the rack has an end between its two tip arcs."""
    if rack.half_land < 0:
        yield _land(profile, rack)


def _land(profile: Profile, rack: Rack) -> Finding:
    sin, cos = math.sin(rack.pressure_angle), math.cos(rack.pressure_angle)
    # The half land is half_space - h_f tan α - r_f (1 - sin α) / cos α.
    most = (rack.half_space - rack.dedendum * sin / cos) * cos / (1 - sin) / rack.module
    if most >= 0:
        return Finding.error(
            "gear.root-land",
            "tip_radius",
            "the two tip arcs of a rack tooth overlap: the fillets of a space merge and no root is left",
            profile.tip_radius,
            most,
            remedy=f"make tip_radius at most {math.floor(most * 1e4) / 1e4:g}",
        )
    deepest = rack.half_space * cos / sin / rack.module
    return Finding.error(
        "gear.root-land",
        "dedendum",
        "the flanks of a rack tooth meet before its tip: there is no root",
        profile.dedendum,
        deepest,
        remedy=f"make dedendum less than {math.floor(deepest * 1e4) / 1e4:g}, or pressure_angle smaller",
    )


def least_tip(teeth: Sequence[Teeth]) -> float:
    """Width of the thinnest tip of some gears, modules; GeometryError where flanks do not reach their tip."""
    return min(float(one.tip_widths.min()) / one.rack.module for one in teeth)


def tip_findings(
    profile: Profile, backlash: float, teeth_of: Callable[[float], Sequence[Teeth]], size: str
) -> Iterator[Finding]:
    """Whether every tooth is thick enough at its tip.

    ``backlash`` is that of the design, mm, ``teeth_of`` its gears with any, and ``size`` names the keys that
    make teeth larger.
    """
    try:
        width = least_tip(teeth_of(backlash))
    except GeometryError as error:
        yield Finding.error(
            "gear.tip",
            "addendum",
            str(error),
            profile.addendum,
            remedy="make addendum smaller",
        )
        return
    if not falls_short(width, LEAST_TIP):
        return
    blame = "backlash" if backlash and least_tip(teeth_of(0.0)) >= LEAST_TIP else "addendum"
    what = "pointed" if width <= 0 else f"{width:.3f} modules wide at the tip"
    yield Finding.error(
        "gear.tip",
        blame,
        f"the thinnest tooth is {what}, below {LEAST_TIP:g} modules",
        width,
        LEAST_TIP,
        remedy=f"make {size} larger: as made, these teeth need all their backlash"
        if blame == "backlash" and profile.backlash is None
        else f"make {blame} smaller" + ("" if blame == "backlash" else ", or pressure_angle smaller"),
    )


def rim_findings(
    table: Keyed, rack: Rack, room: Callable[[Array], float], *, bare: str, roomier: str
) -> Iterator[Finding]:
    """Whether enough stays between the shaft opening of a gear and its nearest root.

    Parameters
    ----------
    table
        What the design says of the opening.
    rack
        Of the gear.
    room
        Least distance, mm, of points (n, 2) from the root curve; below 0 beyond it.
    bare
        Key that is to blame where there is no bore.
    roomier
        What makes a gear larger inside, where it has no room for any bore.
    """
    opening = opening_of(table)
    reach = room(np.zeros((1, 2)))
    rim = plain = reach - table.bore / 2
    blame = "bore" if opening else bare
    if opening and opening.has_keyway:
        rim = min(plain, room(opening.loop().flatten()))
        if falls_short(rim, plain):
            sharp = room(replace(opening, relief=0.0).loop().flatten())
            blame = "keyway_relief" if opening.relief and rim < sharp else "keyway_depth"
    m = rack.module
    full = FULL_RIM * (rack.addendum + rack.dedendum) / m
    rim /= m
    if not falls_short(rim, full):
        return
    too_thin = rim < LEAST_RIM
    if blame == "bore":
        wanted = max(0.0, 2 * (plain + table.bore / 2 - (LEAST_RIM if too_thin else full) * m))
        remedy = f"make bore at most {math.floor(wanted * 100) / 100:g}, or the gear larger"
        if math.floor(wanted * 100) == 0:
            remedy = f"make the gear larger, or {roomier}"
    else:
        remedy = f"make {blame} smaller, or the gear larger"
    yield Finding(
        "bore.rim",
        Severity.ERROR if too_thin else Severity.WARNING,
        blame,
        f"{rim:.2f} modules stay between the shaft opening and the nearest root",
        rim,
        LEAST_RIM if too_thin else full,
        "",
        remedy,
    )


def mesh_findings(
    proof: MeshProof, backlash: float, clearing: Callable[[], Iterable[Change]]
) -> Iterator[Finding]:
    """What the mesh proof of a design says; ``clearing`` gives changes that may end a collision."""
    depth = float(proof.mesh.depth.max())
    if proof.collides:
        said = f"{depth:.4f} mm deep, {proof.mesh.overlap:.4f} mm² of overlap, or more"
        yield collision(depth, proof.allowance, said, clearing)
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
            if backlash
            else ""
        ),
        proof.error * 1e6,
        "µrad",
    )


def collision(depth: float, allowance: float, said: str, clearing: Callable[[], Iterable[Change]]) -> Finding:
    """That a pair collides, ``said`` how deeply, with changes that may end it."""
    return Finding.error(
        "gear.mesh",
        "addendum",
        f"the pair collides: {said}",
        depth,
        allowance,
        "mm",
        "make addendum or tip_radius smaller, dedendum larger, or use more teeth",
        proposed=tuple(clearing()),
    )


def backlash_findings(
    given: float, least: float, jamming: float, teeth: Sequence[Teeth], larger: str
) -> Iterator[Finding]:
    """Whether the backlash of a design, mm, is at least that with which gears as made turn.

    With less than ``jamming`` they are sure to jam. ``teeth`` are those with the least backlash, and
    ``larger`` says what makes them thick enough for it.
    """
    if not falls_short(given, least):
        return
    jams = given < jamming
    does = (
        "gears as made jam: walls as they are planned"
        if jams
        else "gears as made may jam: walls and axes within tolerance"
    )
    yield Finding(
        "gear.backlash",
        Severity.ERROR if jams else Severity.WARNING,
        "backlash",
        f"{does} take up to {jamming if jams else least:g} mm of the backlash",
        given,
        least,
        "mm",
        f"make backlash at least {least:g}, or leave it out"
        if least_tip(teeth) >= LEAST_TIP
        else f"make {larger} larger: with a backlash of {least:g} the teeth are too thin",
        proposed=({"parameters.backlash": least},),
    )
