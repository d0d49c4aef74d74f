"""Limits of teeth of any pitch curve, and what the mesh proof of a pair says."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Protocol

from mechwright.contracts.finding import Change, Finding
from mechwright.mechanics.gearing.proof import MeshProof
from mechwright.mechanics.gearing.teeth import Teeth
from mechwright.tolerances import exceeds

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


def least_tip(teeth: Sequence[Teeth]) -> float:
    """Width of the thinnest tip of some gears, modules; GeometryError where flanks do not reach their tip."""
    return min(float(one.tip_widths.min()) / one.rack.module for one in teeth)


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
