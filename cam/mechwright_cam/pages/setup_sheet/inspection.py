"""What is measured on the finished part: dimensions with their limits, and room to write the answer."""

from dataclasses import dataclass

from mechwright.contracts.inspected import Dimension, LimitKind, dimensions
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import Lengths
from mechwright_plane.nest import Nest

NO_LIMIT = "–"
MOST = 40
"""Rows of a sheet: on a wheel of a hundred holes nobody measures more."""
DIGITS: dict[LimitKind, int] = {"general": 2, "measure": 3, "length": 3, "fit": 4}
"""Of a size in mm by what its limits are."""


@dataclass(frozen=True)
class Measured:
    """A dimension: what it is, its nominal size and its limits, as they are written."""

    what: str
    nominal: str
    least: str
    greatest: str
    by: str

    @property
    def has_limits(self) -> bool:
        """Whether what is typed in can be told to be within its limits."""
        return NO_LIMIT not in (self.least, self.greatest)


def inspection(job: Job, to: Lengths) -> list[Measured]:
    """The dimensions of a part; none of a nest, whose parts are measured singly, and of one turned over."""
    if isinstance(job.part, Nest) or job.side == "underside":
        return []
    listed = dimensions(job.part.measures, job.target.bounds, job.features, job.thickness)
    return [_written(one, to) for one in listed][:MOST]


def _written(one: Dimension, to: Lengths) -> Measured:
    """A limit in inches may not be rounded wider than its thousandth of a millimetre."""
    digits = DIGITS[one.kind] if to.units == "mm" else min(DIGITS[one.kind], 3)
    nominal, least, greatest = (
        NO_LIMIT if size is None else to.fixed(size, digits)
        for size in (one.nominal, one.least, one.greatest)
    )
    what = one.what
    if one.bore is not None:
        x, y = one.bore.centre
        what = f"{what}, at X {to.signed(x)} Y {to.signed(y)}"
    return Measured(what, nominal, least, greatest, one.by)
