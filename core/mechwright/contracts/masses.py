"""Masses as columns of a study: of one of each part by its name, and of all copies of all parts.

    mass            all that stands in the mechanism, kg
    mass.crank      one part named crank, kg, as the bill of a build weighs it

They are those of the parts' own solids, so they need a design whose parts can be made: of others, and in a
study up to the stage ``motion``, there are none.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from mechwright.errors import MechwrightError

if TYPE_CHECKING:
    from mechwright.contracts.part import Part

TOTAL, OF_PART, OF_BODY, UNIT = "mass", "mass.", "mass_", "kg"
"""Of bodies are figures of a motion."""

WEIGHED = 3e-5
"""Share of a mass by which two ways to it may differ: an outline that is fitted runs within
``TOLERANCES.outline`` of its curve, now on one side and now on the other; formulas integrate the curve."""


def is_mass(column: str) -> bool:
    """Whether a column is a mass of parts.

    >>> [is_mass(name) for name in ("mass", "mass.crank", "mass_crank", "massive")]
    [True, True, False, False]
    """
    return column == TOTAL or column.startswith(OF_PART)


def names_of(parts: "Sequence[Part]") -> tuple[str, ...]:
    """The columns that these parts have."""
    return (TOTAL, *(OF_PART + part.name for part in parts))


def masses_of(parts: "Sequence[Part]") -> dict[str, float]:
    """Column to mass, kg; what has none, for want of a density, is left out, and so is the total then.

    >>> from mechwright import Instance, Part
    >>> from mechwright.geometry import Loop, Outline
    >>> square = Outline(Loop.polygon([(0, 0), (10, 0), (10, 10), (0, 10)]))
    >>> twice = (Instance("ground"), Instance("ground", 5.0))
    >>> found = masses_of([Part("block", square, 10.0, "steel", twice)])
    >>> {name: round(value, 9) for name, value in found.items()}
    {'mass.block': 0.00785, 'mass': 0.0157}
    """
    from mechwright.contracts.mass import mass_moments

    found, total, whole = {}, 0.0, True
    for part in parts:
        try:
            one = float(mass_moments(part)[3, 3])
        except MechwrightError:
            whole = whole and not part.instances
            continue
        found[OF_PART + part.name] = one
        total += len(part.instances) * one
    return found | ({TOTAL: total} if whole else {})
