"""Parts of a pair of gears: features of a gear, both shafts, and the pair as cut and as made."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Protocol

from mechwright.arrays import Array
from mechwright.contracts.as_made import AsMade
from mechwright.contracts.finding import Change, Finding
from mechwright.contracts.keyed import Keyed
from mechwright.contracts.made_part import MadePart
from mechwright.contracts.mounting import Hub, Mounting, MountingError, Spindle
from mechwright.contracts.part import Bore, Feature, Profile
from mechwright.geometry import Outline
from mechwright.geometry.segments import Point
from mechwright.mechanics.gearing.cut import cut_mesh, cut_opening, hole_of, ring_of
from mechwright.mechanics.gearing.pair import Pair
from mechwright.mechanics.gearing.proof import MeshProof
from mechwright.mechanics.gearing.running import (
    MadePair,
    about_bore,
    about_rim,
    play_curve,
    running_figures,
    running_findings,
)
from mechwright.mechanics.gearing.teeth import Teeth
from mechwright.mechanics.openings import opening_of
from mechwright.tolerances import TOLERANCES

if TYPE_CHECKING:
    import shapely


class GearPlates(Keyed, Protocol):
    """What a design says of gears from one plate, with one opening."""

    @property
    def thickness(self) -> float:
        """Face width, mm."""

    @property
    def material(self) -> str:
        """Of the gears."""


def gear_features(
    plates: GearPlates, outline: Outline, tabs: tuple[tuple[Point, float], ...]
) -> list[Feature]:
    """Bore and keyway, then the outside with its places for tabs and their limits, mm."""
    depth, opening = plates.thickness, opening_of(plates)
    features: list[Feature] = []
    if opening is not None:
        features.append(Bore("bore", (0.0, 0.0), plates.bore, 0, depth))
        if opening.has_keyway:
            features.append(Profile("keyway", opening.loop(), "inside", 0, depth))
    return [*features, Profile("outside", outline.outer, "outside", 0, depth, tabs)]


def pair_mounting(
    plates: GearPlates, distance: float, force: float, torque: float, shafts: tuple[str, str] = ("1", "2")
) -> Mounting:
    """Both shafts of a pair.

    Parameters
    ----------
    distance
        Of the axes, mm.
    force
        Between the teeth, N, for a torque of 1 N m on the driver.
    torque
        On the driven gear at most, over that on the driver.
    shafts
        Driver and driven; ``gear-1`` stands on shaft 1.

    Raises
    ------
    MountingError
        Gears without a bore.
    """
    if plates.bore == 0:
        raise MountingError(
            "parameters.bore: gears without a bore have no shafts; set bore = 10",
            ({"parameters.bore": 10.0},),
        )
    hub = Hub(0.0, plates.thickness, plates.bore, plates.keyway_width, material=plates.material)
    one, two = shafts
    return Mounting(
        (
            Spindle(one, f"gear-{one}", (0.0, 0.0), hub, "parameters.bore", drives=True, force=force),
            Spindle(two, f"gear-{two}", (distance, 0.0), hub, "parameters.bore", torque=torque, force=force),
        )
    )


def cut_pair(
    plates: GearPlates,
    outlines: Mapping[str, Outline],
    cut: "Mapping[str, shapely.Polygon]",
    prove: Callable[[Array, Array, float], MeshProof],
    larger: Iterable[Change],
    *,
    ring: bool = False,
) -> tuple[Finding, ...]:
    """Judge both gears with their unreachable corners filled.

    Parameters
    ----------
    plates
        The design.
    outlines
        Part name to outline, driver first.
    cut
        Part name to polygon, for parts that are cut.
    prove
        The mesh proof of two outlines (n, 2) and (m, 2), mm, with a depth, mm, that counts as contact.
    larger
        Changes with which the teeth are larger.
    ring
        Whether the driven gear is a ring.
    """
    found: list[Finding] = []
    if all(name in cut for name in outlines):
        allowance = sum(outline.deviation + 2 * TOLERANCES.flatten for outline in outlines.values())
        one, two = (cut[name] for name in outlines)
        proof = prove(ring_of(one), (hole_of if ring else ring_of)(two), allowance)
        found.append(cut_mesh(proof, plates.thickness, larger))
    key = 0.0 if plates.keyway_width > 0 else None
    for name in list(outlines)[: 1 if ring else 2]:
        if name in cut:
            found += cut_opening(plates, key, cut[name], plates.thickness)
    return tuple(dict.fromkeys(found))


def pair_as_made(
    made: Mapping[str, Sequence[MadePart]],
    bores: Mapping[str, float | None],
    pair: Pair,
    teeth: Sequence[Teeth],
    least: tuple[float, str],
) -> AsMade:
    """Judge a pair whose driven gear finds its own angle: part name to its copies as made.

    Parameters
    ----------
    made
        Part name to its copies.
    bores
        Part name to the diameter of its bore, mm, driver first; None for a ring, which runs about its rim.
    pair, teeth
        How they turn, and the teeth of both as designed.
    least
        Backlash, mm, with which they turn, and the rule by which it is found.
    """
    copies = [made.get(name, ()) for name in bores]
    if not all(copies):
        return AsMade()
    one, two = (copy[0] for copy in copies)
    walls = (
        about_rim(part) if bore is None else about_bore(part, bore)
        for part, bore in zip((one, two), bores.values(), strict=True)
    )
    driver, driven = bores
    run = MadePair(
        pair,
        teeth[0],
        (driver, driven),
        (next(walls), next(walls)),
        one.corridor + two.corridor,
        least,
        mate=teeth[1],
    )
    return AsMade(tuple(running_figures(run)), (play_curve(run),), tuple(running_findings(run)))
