"""The plates of a linkage that is laid out by its links and joints alone."""

from mechwright.mechanics.linkage.kinematics.period import course_of, period_of
from mechwright.mechanics.linkage.parts.layout import Layout, layout_of
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.linkage.stacking import STACK_SAMPLES


def plates_of(table: AnyPlanarTable) -> Layout:
    """Plates and layers.

    Raises
    ------
    GeometryError
        There are gears, bores leave no rim, or no order of layers keeps all plates apart.
    KinematicsError
        The linkage does not move.
    """
    course = course_of(table)
    turns = 1 if course.rocks else max(1, round(abs(course.travel) / 6.3))
    bodies = period_of(table, turns * (STACK_SAMPLES - 1) + 1).solution.bodies
    return layout_of(table.linkage, table.sizes, bodies)
