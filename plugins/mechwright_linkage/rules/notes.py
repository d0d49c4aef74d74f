"""Figures worth knowing."""

import math

from mechwright import Stage
from mechwright.contracts.procedure import Note
from mechwright.contracts.rule_list import all_of
from mechwright.mechanics.linkage.kinematics.figures import figures_of, least_transmission
from mechwright.mechanics.linkage.kinematics.period import course_of
from mechwright.mechanics.linkage.rules.part_rules import part_notes
from mechwright_linkage.table import LinkageTable


def _motion_message(m: LinkageTable) -> str:
    course, figures = course_of(m), figures_of(m)
    travel = abs(course.travel) if m.driver_slides else math.degrees(abs(course.travel))
    unit = "mm" if m.driver_slides else "degrees"
    way = f"goes {travel:.4g} {unit} there and back" if course.rocks else "turns fully"
    output = m.output
    if "output_stroke" in figures:
        moves = f"the {output} has a stroke of {float(figures['output_stroke']()):.4f} mm"
    else:
        moves = f"the {output} swings by {math.degrees(float(figures['output_swing']())):.4f} degrees"
    ratio = float(figures["time_ratio"]())
    timed = f", with a time ratio of {ratio:.5f}" if ratio == ratio else ""
    return (
        f"the driver {way}; {moves}{timed}; transmission angle down to "
        f"{math.degrees(least_transmission(m)):.3f} degrees"
    )


NOTES = all_of(
    Note[LinkageTable]("linkage.motion", _motion_message, stage=Stage.MOTION),
    part_notes(LinkageTable.code),
)
