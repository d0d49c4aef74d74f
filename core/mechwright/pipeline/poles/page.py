"""The page ``poles.html``."""

import math
from abc import abstractmethod
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from mechwright.pipeline.build import Build, Wanted
from mechwright.pipeline.figures import Figure, Grid, figures_page
from mechwright.pipeline.page import FileName, Page

if TYPE_CHECKING:
    from mechwright.pipeline.poles.coupler import Coupler

NAME = "poles.html"
"""The file."""

RATIOS = (0.0, 0.5, -0.5)
"""Acceleration ratios that are drawn beside the design's own."""

POSITIONS = 4
"""Crank angles at which the circles are drawn: a sixth of the way, then even steps."""


class PolesPage(Page):
    """``poles.html``: loci of the acceleration pole on both planes, the circles at some angles, numbers.

    A family derives from it, says its own name, and what its coupler does.
    """

    commands = frozenset({"solve", "build"})
    doing = "poles"
    family: ClassVar[str]
    """Name of the family whose designs have the page."""

    @abstractmethod
    def couplers(self, params: Any) -> "Mapping[str, Coupler]":
        """The links of a design that moves whose poles are drawn, each by the name of its page."""

    def file_names(self, params: Any) -> Sequence[str]:  # noqa: ARG002 - used by families with several
        """The names of the pages."""
        return (NAME,)

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """The pages."""
        if build.design.family.name != self.family:
            return []
        return [FileName(name, "the poles") for name in self.file_names(build.design.params)]

    def files(self, build: Build) -> Mapping[str, str]:
        """The pages; none for other families, and of links that only shift."""
        found: dict[str, str] = {}
        if build.design.family.name != self.family:
            return found
        for name, coupler in self.couplers(build.design.params).items():
            try:
                found[name] = page(build.design.name, build.design.family.title, coupler)
            except NoPole:
                continue
        return found


class NoPole(Exception):  # noqa: N818 - it is no fault
    """All points of the coupler share one acceleration."""


def page(name: str, title: str, coupler: "Coupler") -> str:
    """The page of a coupler; raises NoPole where it has no pole."""
    import numpy as np

    from mechwright.pipeline.poles import planes

    own = coupler.course.acceleration_ratio
    ratios = tuple(dict.fromkeys((own, *RATIOS)))
    if not np.isfinite(coupler.locus(own)[0]).any():
        raise NoPole
    start, travel = coupler.course.start, coupler.course.travel
    angles = [start + travel * (1 + 1.5 * n) / 6 for n in range(POSITIONS)]
    said = ", ".join(f"{ratio:g}" for ratio in ratios)
    figures = [
        Figure(
            f"On the {coupler.seen_from}",
            planes.ground(coupler, ratios, angles[0]),
            f"Loci of the acceleration pole G over a period for the acceleration ratios k = α/ω² of the "
            f"crank, {said} per radian; the first is the design's own, dashed in the other assembly.",
        ),
        Figure(
            f"In the {coupler.link}",
            planes.moving(coupler, ratios),
            f"The same loci as the {coupler.link} sees them"
            + (", A in the origin, B to the right." if coupler.outline is None else "."),
        ),
    ]
    figures += [
        Figure(
            f"Crank at {math.degrees(phi):.4g}°",
            planes.position(coupler, own, phi),
            f"P at {_place(complex(coupler.circles(phi, own).instant_centre[0]))}; "
            f"G at {_place(coupler.pole(phi, own))}.",
        )
        for phi in angles
    ]
    return figures_page(
        name,
        f"{title}: acceleration poles{_pair(coupler)}",
        _notes(coupler),
        figures,
        [_table(coupler, angles)],
    )


def _pair(coupler: "Coupler") -> str:
    """Which link is seen from which, where that is not the coupler from the ground."""
    if (coupler.link, coupler.seen_from) == ("coupler", "ground"):
        return ""
    return f" of the {coupler.link}, seen from the {coupler.seen_from}"


def _notes(coupler: "Coupler") -> list[str]:
    k = coupler.course.acceleration_ratio
    law = (
        "The crank is a lever with a law of its own; drawn are the poles of constant acceleration ratios."
        if coupler.course.rocks
        else "The crank's speed is constant."
        if k == 0
        else f"The crank's acceleration is {k:g} times the square of its speed, all along."
    )
    return [
        f"{law} Places are {coupler.places}, in mm; k is counter-clockwise positive, per radian.",
        "Circles, blue: the inflection circle. Whatever the crank's acceleration, the pole lies on it; the "
        "dots are the poles of the ratios beside them. Green: the circle of zero tangential acceleration "
        "of the design's own ratio. Both meet in the instant centre P and in the pole G.",
    ]


def _table(coupler: "Coupler", angles: list[float]) -> Grid:
    own = coupler.course.acceleration_ratio
    ratios = sorted({own, *RATIOS})
    rows = []
    for phi in angles:
        found, body = coupler.circles(phi, own), coupler.body(phi, 0.0)
        omega, alpha = float(body.turning.omega[0]), float(body.turning.alpha[0])
        rows.append(
            [
                f"{math.degrees(phi):.6g}°",
                _place(complex(found.instant_centre[0])),
                _place(complex(found.inflection_pole[0])),
                f"{-alpha / omega:.6f}" if omega else "none",
                *(_place(coupler.pole(phi, ratio)) for ratio in ratios),
            ]
        )
    head = ["crank", "P", "inflection pole", "its k", *(f"G, k = {ratio:g}" for ratio in ratios)]
    return Grid(f"Instant centre and poles, mm {coupler.places}", head, rows)


def _place(point: complex) -> str:
    if math.isnan(point.real):
        return "at infinity"
    return f"{point.real:.4f}, {point.imag:.4f}".replace("-", "−")
