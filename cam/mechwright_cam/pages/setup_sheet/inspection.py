"""What is measured on the finished part: dimensions with their limits, and room to write the answer."""

from collections.abc import Iterator
from dataclasses import dataclass

from mechwright.contracts.general_tolerances import general_length
from mechwright.contracts.part import Bore, Feature, Pocket
from mechwright.errors import DesignError
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import Lengths
from mechwright_plane.nest import Nest

GENERAL = "ISO 2768-m"
"""What holds where the part says no tolerance."""
NO_LIMIT = "–"
MOST = 40
"""Rows of a sheet: on a wheel of a hundred holes nobody measures more."""


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
    """The dimensions of a part; none of a nest, whose parts are measured one by one, and of one turned over.

    Bores have the limits of their fit, and depths those that they have; all else has those of ISO 2768-m.
    """
    if isinstance(job.part, Nest) or job.side == "underside":
        return []
    return list(_listed(job, to))[:MOST]


def _listed(job: Job, to: Lengths) -> Iterator[Measured]:
    x0, y0, x1, y1 = job.target.bounds
    for measure in job.part.measures:
        sizes = (measure.nominal, measure.least, measure.greatest)
        nominal, least, greatest = (NO_LIMIT if one is None else _text(one, to, 3) for one in sizes)
        yield Measured(measure.what, nominal, least, greatest, measure.by)
    yield _general("overall, along X", x1 - x0, to)
    yield _general("overall, along Y", y1 - y0, to)
    for feature in job.features:
        if isinstance(feature, Bore):
            x, y = feature.centre
            what = f"{feature.name} ⌀, at X {to.signed(x)} Y {to.signed(y)}"
            if feature.fit is None:
                yield _general(what, feature.diameter, to)
            else:
                fit = feature.fit
                low, high = fit.size + fit.lower, fit.size + fit.upper
                nominal, least, greatest = (_text(value, to, 4) for value in (fit.size, low, high))
                yield Measured(what, nominal, least, greatest, fit.name)
        if isinstance(feature, Bore | Pocket) and not _through(job, feature):
            yield _depth(feature, to)


def _depth(feature: Bore | Pocket, to: Lengths) -> Measured:
    what, limits = f"{feature.name}, depth", feature.depth_limits if isinstance(feature, Bore) else None
    if limits is None:
        return _general(what, feature.depth, to)
    sizes = (feature.depth, feature.depth + limits[0], feature.depth + limits[1])
    nominal, least, greatest = (_text(value, to, 3) for value in sizes)
    return Measured(what, nominal, least, greatest, "limits of the drawing")


def _through(job: Job, feature: Feature) -> bool:
    return feature.top + feature.depth >= job.thickness - 1e-6


def _general(what: str, nominal: float, to: Lengths) -> Measured:
    try:
        off = general_length(nominal, "medium")
    except DesignError:
        return Measured(what, _text(nominal, to), NO_LIMIT, NO_LIMIT, "")
    return Measured(what, _text(nominal, to), _text(nominal - off, to), _text(nominal + off, to), GENERAL)


def _text(value: float, to: Lengths, digits: int = 2) -> str:
    """A dimension; a limit in inches may not be rounded wider than its thousandth of a millimetre."""
    return to.fixed(value, digits if to.units == "mm" else min(digits, 3))
