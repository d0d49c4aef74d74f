"""The dimensions by which a finished part is judged, with their limits, as drawing and sheet list them.

Bores have the limits of their fit, depths and lengths those that they have; all else has ISO 2768-m.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from mechwright.contracts.fits import Fit
from mechwright.contracts.general_tolerances import general_length
from mechwright.contracts.measure import Measure
from mechwright.contracts.part import Bore, Feature, Part, Pocket
from mechwright.contracts.turned import Turned
from mechwright.errors import DesignError

GENERAL = "ISO 2768-m"
"""What holds where the part says no tolerance."""
OF_DRAWING = "limits of the drawing"
LEVEL = 1e-6
"""Depths that differ by less are one, mm."""

LimitKind = Literal["measure", "general", "fit", "length"]
"""What the limits are: of a measure, general ones, those of a fit, or of a length."""


@dataclass(frozen=True)
class Dimension:
    """A size to be measured.

    Parameters
    ----------
    name
        Stable, of one word: ``"bore-1"``, ``"overall-x"``, ``"seat-depth"``, ``"measure-1"``.
    what
        In a few words.
    nominal
        mm.
    least, greatest
        Limits, mm; None where nothing is said.
    by
        What the limits follow from.
    kind
        The same in one word.
    walls
        Of so many walls stock that is left makes it larger; below 0, smaller; 0 where no wall decides it.
    bore
        The bore that it is of, if it is of one.
    """

    name: str
    what: str
    nominal: float
    least: float | None
    greatest: float | None
    by: str
    kind: LimitKind
    walls: int = 0
    bore: Bore | None = None

    @property
    def target(self) -> float:
        """The middle of its limits, mm; nominal where it has none."""
        if self.least is None or self.greatest is None:
            return self.nominal
        return (self.least + self.greatest) / 2

    def is_within(self, value: float) -> bool:
        """Whether a measured value, mm, is within the limits."""
        low = self.least is None or value >= self.least - LEVEL
        return low and (self.greatest is None or value <= self.greatest + LEVEL)


def inspected(part: Part) -> tuple[Dimension, ...]:
    """The dimensions of a plate, of a turned part, or of the bores of a free form; none of another one."""
    if part.turned is not None:
        return tuple(_turned(part.turned))
    if part.free_form is not None:
        bores = part.free_form.bores
        return tuple(_of_fit(one.name, f"{one.name} ⌀", one.diameter, one.fit, -2) for one in bores)
    if part.outline is None:
        return ()
    return tuple(dimensions(part.measures, part.outline.bounds, part.features, part.thickness))


def dimensions(
    measures: Sequence[Measure],
    bounds: tuple[float, float, float, float],
    features: Sequence[Feature],
    thickness: float,
) -> Iterator[Dimension]:
    """Those of a plate: its measures, its overall sizes, diameters of its bores, depths of what is blind.

    Parameters
    ----------
    measures
        Of the part.
    bounds
        Least x and y, greatest x and y of its outline, mm.
    features
        Of the part.
    thickness
        mm.
    """
    for number, one in enumerate(measures, start=1):
        yield Dimension(
            f"measure-{number}", one.what, one.nominal, one.least, one.greatest, one.by, "measure"
        )
    x0, y0, x1, y1 = bounds
    yield _general("overall-x", "overall, along X", x1 - x0, 2)
    yield _general("overall-y", "overall, along Y", y1 - y0, 2)
    for feature in features:
        if isinstance(feature, Bore):
            yield _of_fit(feature.name, f"{feature.name} ⌀", feature.diameter, feature.fit, -2, feature)
        if isinstance(feature, Bore | Pocket) and feature.top + feature.depth < thickness - LEVEL:
            yield _depth(feature)


def _depth(feature: Bore | Pocket) -> Dimension:
    limits = feature.depth_limits if isinstance(feature, Bore) else None
    name, what = f"{feature.name}-depth", f"{feature.name}, depth"
    if limits is None:
        return _general(name, what, feature.depth)
    low, high = feature.depth + limits[0], feature.depth + limits[1]
    return Dimension(name, what, feature.depth, low, high, OF_DRAWING, "length")


def _turned(turned: Turned) -> Iterator[Dimension]:
    for number, step in enumerate(turned.steps, start=1):
        if step.start is None:
            yield _of_fit(f"step-{number}", f"step {number} ⌀", step.diameter, step.fit, 2)
    if turned.bore and not turned.tapped:
        yield _of_fit("bore", "bore ⌀", turned.bore, turned.bore_fit, -2)
    yield _general("length", "overall length", turned.length)
    for one in turned.lengths:
        low, high = one.nominal + one.lower, one.nominal + one.upper
        name = f"length-{one.name.replace(' ', '-')}"
        yield Dimension(name, f"length: {one.name}", one.nominal, low, high, OF_DRAWING, "length")


def _of_fit(
    name: str, what: str, diameter: float, fit: Fit | None, walls: int, bore: Bore | None = None
) -> Dimension:
    if fit is None:
        return _general(name, what, diameter, walls, bore)
    return Dimension(name, what, fit.size, *fit.limits, fit.name, "fit", walls, bore)


def _general(name: str, what: str, nominal: float, walls: int = 0, bore: Bore | None = None) -> Dimension:
    try:
        off = general_length(nominal, "medium")
    except DesignError:
        return Dimension(name, what, nominal, None, None, "", "general", walls, bore)
    return Dimension(name, what, nominal, nominal - off, nominal + off, GENERAL, "general", walls, bore)
