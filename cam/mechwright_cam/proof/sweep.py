"""What the cutters sweep at a height: paths that reach it, by effective radius."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from mechwright.motion import Array
from mechwright_cam.interpreter import Kind
from mechwright_cam.interpreter.run import Ints
from mechwright_cam.proof.near import Chords
from mechwright_cam.proof.paths import NEAR, Geometries, Paths, Pieces

SWEEP_CHORD = 0.0005
"""Chord error of arcs in a sweep, mm: a twentieth of the leftover limit."""


@dataclass(frozen=True)
class Sweep:
    """Paths of one effective radius, mm: as lines for areas, as chords for distances."""

    radius: float
    paths: Paths
    pieces: Pieces

    @cached_property
    def _points(self) -> tuple[Array, Ints]:
        return self.paths.points(self.pieces, SWEEP_CHORD)

    @cached_property
    def chains(self) -> Geometries:
        """All of the paths, repeated ones once."""
        return self.paths.chains(self.pieces, SWEEP_CHORD)

    @cached_property
    def chords(self) -> Chords:
        """The straight pieces of all paths."""
        points, owner = self._points
        same = owner[:-1] == owner[1:]
        return Chords(points[:-1][same], points[1:][same])

    def beside(self, shape: shapely.Geometry) -> Geometries:
        """Those of the paths that may come within the radius of a shape."""
        points, owner = self._points
        x0, y0, x1, y1 = shape.bounds
        reach = self.radius + NEAR
        count = len(self.pieces)
        least, most = np.full((2, count), np.inf), np.full((2, count), -np.inf)
        for axis in (0, 1):
            np.minimum.at(least[axis], owner, points[:, axis])
            np.maximum.at(most[axis], owner, points[:, axis])
        near = (least[0] <= x1 + reach) & (most[0] >= x0 - reach)
        near &= (least[1] <= y1 + reach) & (most[1] >= y0 - reach)
        return self.paths.chains(self.pieces.only(near), SWEEP_CHORD)


def sweeps(paths: Paths, height: float, bottom: float) -> list[Sweep]:
    """What is cut at ``bottom`` by the feed moves that go down to ``height``."""
    cutting = paths.steps[np.isin(paths.run.kind[paths.steps], (Kind.FEED, Kind.ARC))]
    pieces = paths.below(height, steps=cutting)
    radius = np.round(paths.radius_at(pieces, bottom), 6)
    return [Sweep(float(one), paths, pieces.only(radius == one)) for one in np.unique(radius[radius > NEAR])]
