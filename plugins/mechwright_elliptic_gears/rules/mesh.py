"""Rules of the mesh: whether pairs collide, and how exactly they turn each other."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from mechwright import Finding, Stage, at_stage
from mechwright.contracts.procedure import Procedure
from mechwright.contracts.rule_list import all_of
from mechwright.mechanics.gearing.checks import LEAST_CLEARANCE, collision
from mechwright.mechanics.gearing.tooth_rules import MESH as PROOF
from mechwright_elliptic_gears.parts.mesh_proof import first_collision
from mechwright_elliptic_gears.table import GearTable

DOUBT = 0.03
"""Modules of flank left below a tip from which no tip was seen to collide, if it clears the root as well."""


def may_collide(m: GearTable) -> NDArray[np.bool_]:
    """Whether only the mesh proof can tell (n, 1): tips reach the fillets or roots of their mates, or nearly.

    A tip that reaches below the straight flank of the rack meets no flank but a fillet.
    """
    gears = m.gears
    left = gears.straight_depth - m.tips.depth
    return np.asarray((left < DOUBT) | (gears.dedendum - gears.addendum < LEAST_CLEARANCE))


def _collision(m: GearTable) -> Iterator[Finding]:
    depth, allowance = first_collision(m.given)
    if depth:
        found = collision(depth, allowance, f"at least {depth:.4f} mm deep", m.clearing)
        yield from at_stage(Stage.PARTS, [found])


COLLISION = Procedure[GearTable](
    ("gear.mesh",), _collision, when=may_collide, stage=Stage.PARTS, quickly=True
)
MESH = all_of(COLLISION, PROOF)
