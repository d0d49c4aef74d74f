"""What is bought for a machine and is no body of it: compounds, grease, electrical parts."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Supply:
    """A line of the list.

    Parameters
    ----------
    name
        What it is, in a few words.
    order
        What to order, with the figures that it has to have.
    note
        What it is for.
    qty, unit
        How much of it.
    designation, standard
        Of what a standard fixes.
    inch
        What is sold in its place where sizes are in inches.
    """

    name: str
    order: str
    note: str
    qty: int = 1
    unit: str = "pcs"
    designation: str = ""
    standard: str = ""
    inch: str = ""


def next_above(sizes: tuple[float, ...], least: float) -> float:
    """The least of some rising sizes that is at least so much; the largest where none is.

    >>> next_above((1.0, 2.0, 5.0), 1.2), next_above((1.0, 2.0), 3.0)
    (2.0, 2.0)
    """
    return next((one for one in sizes if one >= least), sizes[-1])
