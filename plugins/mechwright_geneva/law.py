"""The motion law that a design names."""

from mechwright import kept
from mechwright.mechanics.laws import LAWS, Law, Polynomial
from mechwright_geneva.params import GenevaParams
from mechwright_geneva.straight import StraightSlot


@kept
def law_of(params: GenevaParams) -> Law:
    """The law; a table or polynomial has been found free of faults before."""
    match params.law:
        case "straight":
            return StraightSlot(params.slots)
        case "polynomial":
            return Polynomial(params.polynomial or ())
        case "table":
            from mechwright.mechanics.laws.table import Table

            return Table(params.table or ())
        case named:
            return LAWS[named]()
