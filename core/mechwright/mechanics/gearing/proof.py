"""The mesh proof of a pair: what its outlines do, held against what its rack was to make of them."""

import math
from dataclasses import dataclass

from mechwright.arrays import Array
from mechwright.mechanics.gearing.mesh import Mesh, mesh, swing
from mechwright.mechanics.gearing.pair import Pair
from mechwright.mechanics.gearing.rack import Rack


@dataclass(frozen=True)
class MeshProof:
    """What the mesh proof of a pair found.

    Parameters
    ----------
    mesh
        The raw result.
    allowance
        Depth that counts as contact, mm.
    flank_error
        Peak to peak of a flank's normal distance from where the designed backlash puts it, mm, the larger of
        both flanks.
    error
        Peak to peak of the driven gear's angle against the exact motion, without what the designed backlash
        alone makes of it, rad.
    """

    mesh: Mesh
    allowance: float
    flank_error: float
    error: float

    @property
    def collides(self) -> bool:
        """Whether the outlines stand in each other, more deeply than their fits can."""
        return bool(self.mesh.depth.max() > self.allowance)


def prove_mesh(
    pair: Pair,
    rack: Rack,
    teeth: int,
    outlines: tuple[Array, Array],
    allowance: float,
    *,
    stop: bool = False,
) -> MeshProof:
    """Run the outlines of driver and driven gear, (n, 2) and (m, 2), mm, as :func:`mesh` takes them.

    ``teeth`` are those of the driver. ``allowance`` is the depth, mm, that the making of the outlines
    itself can cause; ``stop`` is that of :func:`mesh`.
    """
    result = mesh(*outlines, pair, teeth, allowance=allowance, stop=stop)
    normal = rack.backlash / 2 * math.cos(rack.pressure_angle)
    levers = pair.levers(result.arc, rack.pressure_angle)
    flanks = list(zip((result.ahead, result.behind), levers, strict=True))
    return MeshProof(
        result,
        allowance,
        max(swing(play * lever) for play, lever in flanks),
        max(swing(play - normal / lever) for play, lever in flanks),
    )
