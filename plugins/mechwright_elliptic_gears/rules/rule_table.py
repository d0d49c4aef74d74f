"""The rules of elliptic gears, in the order in which they are asked, and the figures worth knowing.

All of them are about the parts, for the pitch ellipses of every design roll on each other; only the backlash
is about what machining leaves of them.
"""

from mechwright.contracts.procedure import Note
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.gearing import body
from mechwright.mechanics.gearing.tooth_rules import BACKLASH, FILLET, chosen_note
from mechwright_elliptic_gears.parts.defaults import USUAL
from mechwright_elliptic_gears.parts.gear import ellipse_of, outline_of
from mechwright_elliptic_gears.rules.mesh import MESH
from mechwright_elliptic_gears.rules.strength import STRENGTH
from mechwright_elliptic_gears.rules.teeth import DRIVE, TEETH
from mechwright_elliptic_gears.rules.train import POINT, TRAIN
from mechwright_elliptic_gears.table import GearTable


def _size_message(m: GearTable) -> str:
    ellipse = ellipse_of(m.given)
    whole, inertia = body(outline_of(m.given), m.given.thickness, m.given.material)
    return (
        f"module {m.module:.4f} mm, semi-axes {ellipse.semi_major:.4f} and {ellipse.semi_minor:.4f} mm, "
        f"centre distance {2 * ellipse.semi_major:.4f} mm; each gear {whole.mass * 1e3:.1f} g, "
        f"{inertia:.4g} kg·mm² about its axis"
    )


NOTES = all_of(
    chosen_note(USUAL), Note[GearTable]("gear.size", _size_message, lambda m: 2 * m.semi_major, "mm"), FILLET
)

RULES = in_turn(TEETH, POINT, TRAIN, DRIVE, MESH, STRENGTH, NOTES, BACKLASH)
