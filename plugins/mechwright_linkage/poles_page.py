"""The pages of acceleration poles: one for each pair of links that the design names."""

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np

from mechwright.mechanics.linkage.kinematics.period import course_of
from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.relative_motion import relative
from mechwright.pipeline.poles import NAME, Coupler, PolesPage
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.table import LinkageTable

Drawn = tuple[dict[str, complex], Sequence[Sequence[complex]]]
"""Places of joints, and lines of links."""


class LinkagePoles(PolesPage):
    """``poles.html`` of a linkage, and one page more for each further pair of links."""

    name = "linkage-poles"
    family = "linkage"

    def file_names(self, params: LinkageParams) -> Sequence[str]:
        """One for each pair; none where the input slides, whose accelerations have another unit."""
        if LinkageTable.of(params).driver_slides:
            return ()
        others = params.pole_pairs[1:]
        return (NAME, *(f"poles-{one}-{two}.html".lower() for one, two in others))

    def couplers(self, params: LinkageParams) -> Mapping[str, Coupler]:
        """Each pair."""
        table = LinkageTable.of(params)
        pairs = zip(self.file_names(params), params.pole_pairs, strict=False)
        return {name: _seen(table, *pair) for name, pair in pairs}


def _seen(table: LinkageTable, link: str, seen_from: str) -> Coupler:
    """A link as seen from another one; the drawing is in the frame of the latter."""

    def moved(crank: Turning) -> Sequence[BodyMotion]:
        found = table.solved(crank)
        return [relative(found.bodies[link], found.bodies[seen_from])]

    places = "from the origin" if seen_from == GROUND else f"in the frame of the {seen_from}"
    return Coupler(
        course_of(table),
        moved,
        partial(_drawn, table, seen_from),
        0.0,
        link,
        seen_from,
        places,
        _outline(table, link),
    )


def _drawn(table: LinkageTable, seen_from: str, at: float) -> Drawn:
    """The linkage at an angle of the input, in the frame of a link."""
    bodies = table.solved_at(np.array([at])).bodies
    joints: dict[str, complex] = {}
    lines = []
    for name, points in table.linkage.points.items():
        seen = relative(bodies[name], bodies[seen_from])
        own = {point: complex(seen.point(place).position[0]) for point, place in points.items()}
        joints |= own
        if name != GROUND and len(own) > 1:
            closed = [*own.values(), next(iter(own.values()))]
            lines.append(closed if len(own) > 2 else [*own.values()])
    return joints, lines


def _outline(table: LinkageTable, link: str) -> Drawn:
    own = {point: complex(place) for point, place in table.linkage.points[link].items()}
    line = [*own.values(), next(iter(own.values()))]
    return own, [line]
