"""Rules of the outlines: none crosses itself, and those of a pair run together."""

from collections.abc import Iterator

import numpy as np
import shapely

from mechwright import Finding, Stage
from mechwright.contracts.procedure import Procedure
from mechwright.mechanics.gearing.checks import mesh_findings
from mechwright.tolerances import TOLERANCES
from mechwright_spur_gears.gear_table import GearTable
from mechwright_spur_gears.parts.teeth import loops_of, prove


def _crossings(m: GearTable) -> Iterator[Finding]:
    """An error for each toothed outline that crosses itself: its fillets reach over flanks."""
    gears = [flank for flank in m.flanks if not flank.again]
    for flank, (loop, _) in zip(gears, loops_of(m), strict=False):
        corners = loop.flatten(TOLERANCES.flatten)
        whole = shapely.Polygon(corners)
        if whole.is_valid:
            continue
        place = np.fromstring(shapely.is_valid_reason(whole).partition("[")[2].rstrip("]"), sep=" ")
        yield Finding.error(
            "gear.outline",
            "dedendum",
            f"the fillets of {flank.words} cross its flanks {np.hypot(*place[:2]):.3f} mm from its axis: "
            "what cuts them leaves no tooth",
            remedy=f"make dedendum smaller, or tip_radius, or {flank.shift} larger",
            stage=Stage.PARTS,
        )


def _mesh(m: GearTable) -> Iterator[Finding]:
    """The mesh proofs of one design."""
    for mesh, pair in enumerate(m.meshes):
        yield from mesh_findings(prove(m, mesh), float(pair.backlash), list)


OUTLINES = Procedure[GearTable](
    ("gear.outline",), _crossings, when=lambda m: m.single, slow=True, stage=Stage.PARTS
)
MESH = Procedure[GearTable](
    ("gear.mesh", "gear.contact"), _mesh, when=lambda m: m.single, slow=True, stage=Stage.PARTS
)
