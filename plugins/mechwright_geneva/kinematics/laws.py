"""The motion law that a design names."""

from mechwright import kept
from mechwright.mechanics.laws import LAWS, Law, Polynomial
from mechwright_geneva.kinematics.straight_slot import StraightSlot
from mechwright_geneva.parameters import GenevaParams


def law_of(params: GenevaParams) -> Law:
    """The law; a table or polynomial has been found free of faults before."""
    return _law(params.law, params.slots, params.polynomial or (), params.table or ())


@kept
def _law(name: str, slots: int, polynomial: tuple[float, ...], table: tuple[tuple[float, float], ...]) -> Law:
    match name:
        case "straight":
            return StraightSlot(slots)
        case "polynomial":
            return Polynomial(polynomial)
        case "table":
            from mechwright.mechanics.laws.table import Table

            return Table(table)
        case named:
            return LAWS[named]()
