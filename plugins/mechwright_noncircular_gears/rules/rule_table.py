"""The rules of a pair of non-circular gears in their order, and the figures worth knowing."""

from collections.abc import Iterator

from mechwright import Finding, Stage
from mechwright.contracts.finding import at_stage
from mechwright.contracts.procedure import Note, Procedure
from mechwright.contracts.rule_list import all_of, by_design, in_turn
from mechwright.mechanics.gearing import body
from mechwright.mechanics.gearing.tooth_rules import BACKLASH, FILLET, MESH, chosen_note
from mechwright_noncircular_gears.defaults import USUAL
from mechwright_noncircular_gears.rules.law_rules import LAW
from mechwright_noncircular_gears.rules.part_rules import PARTS
from mechwright_noncircular_gears.rules.sector_rules import STOPS
from mechwright_noncircular_gears.rules.strength import STRENGTH
from mechwright_noncircular_gears.table import NAMES, GearTable

ON_AXIS = 0.0005
"""A middle nearer to its axis is said to be on it, mm: half of the last digit that is told."""


def _size(m: GearTable) -> str:
    return (
        f"module {m.rack.module:.4f} mm, {m.given.teeth} and {m.given.mate_teeth} teeth, centre distance "
        f"{m.pair.distance:.4f} mm"
    )


def _balance(m: GearTable) -> Iterator[Finding]:
    for name, outline in zip(NAMES, m.outlines, strict=True):
        whole, inertia = body(outline, m.given.thickness, m.given.material)
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


NOTES = all_of(
    STOPS,
    chosen_note(USUAL),
    Note[GearTable]("gear.size", _size, lambda m: m.pair.distance, "mm"),
    FILLET,
    Procedure[GearTable](
        ("gear.balance",), lambda m: at_stage(Stage.PARTS, _balance(m)), slow=True, warns=True
    ),
)

RULES = in_turn(LAW, by_design(PARTS, MESH, STRENGTH, NOTES, BACKLASH, stage=Stage.PARTS))
"""Each needs what those before it have found to be right."""
