"""What the cutters sweep at a height: paths that reach it, by effective radius."""

from dataclasses import dataclass
from functools import cached_property
from threading import Lock

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.errors import ProgramError
from mechwright.geometry.prepared import prepared
from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.gouge import distinct
from mechwright_cam.proof.paths import NEAR, Geometries, Paths, Pieces
from mechwright_cam.proof.plane import Shape, swept
from mechwright_cam.proof.point_segment_distance import Chords

ROUNDING = 1e-4
"""A path that should reach the underside may be short by the last decimal of the program, mm."""
SWEEP_CHORD = 0.0005
"""Chord error of arcs in a sweep, mm: a twentieth of the leftover limit."""

MOST_CHORDS = 2_000_000
"""Chords of all cuts that reach a height, beyond which a program is refused: three seconds, and 500 MB."""

BRIDGE = 0.02
"""Accuracy of the areas of :func:`taken`, mm: a bridge thinner than that holds nothing."""

PARTS = ("step", "first", "last", "low")
"""The arrays of Pieces."""


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
        return Chords.along(*self._points)

    @cached_property
    def _extents(self) -> tuple[Array, Array]:
        """Least and greatest x and y (m, 2) of each piece, mm."""
        points, owner = self._points
        first = np.searchsorted(owner, np.arange(len(self.pieces)))
        return np.minimum.reduceat(points, first), np.maximum.reduceat(points, first)

    def stays_inside(self, box: shapely.Polygon) -> bool:
        """Whether nothing that is swept reaches the edge of a rectangle along the axes, nor beyond."""
        least, most = self._extents
        x0, y0, x1, y1 = box.bounds
        reach = self.radius + NEAR
        return bool(((least > (x0 + reach, y0 + reach)) & (most < (x1 - reach, y1 - reach))).all())

    def paths_within_radius(self, shape: shapely.Geometry) -> Geometries:
        """Those of the paths that may come within the radius of a shape."""
        least, most = self._extents
        x0, y0, x1, y1 = shape.bounds
        reach = self.radius + NEAR
        near = (least <= (x1 + reach, y1 + reach)) & (most >= (x0 - reach, y0 - reach))
        return self.paths.chains(self.pieces.only(np.flatnonzero(near.all(axis=1))), SWEEP_CHORD)


def taken(cut: list[Sweep], region: Shape) -> list[Shape]:
    """What is cut away of a region, roughly."""
    region = prepared(region)
    shapes: list[Shape] = []
    for sweep in cut:
        chains = sweep.paths_within_radius(region)
        near = chains[shapely.dwithin(region, chains, sweep.radius)]
        shapes.append(swept(near, sweep.radius, BRIDGE))
    return shapes


class Sweeps:
    """What is cut at different heights, each worked out once."""

    def __init__(self, paths: Paths) -> None:
        self.paths = paths
        self._known: dict[tuple[float, float], list[Sweep]] = {}
        self._one_by_one = Lock()

    def __getstate__(self) -> dict[str, object]:
        """What goes to another process, where nobody is at it."""
        return {key: value for key, value in self.__dict__.items() if key != "_one_by_one"}

    def __setstate__(self, state: dict[str, object]) -> None:
        self.__dict__.update(state, _one_by_one=Lock())

    def at(self, height: float, level: float) -> list[Sweep]:
        """What is cut at ``level`` by feed moves that go down to ``height``, smallest radius first."""
        with self._one_by_one:  # rules that are asked side by side want the same ones
            if (height, level) not in self._known:
                self._known[height, level] = self._cut(height, level)
            return self._known[height, level]

    def _cut(self, height: float, level: float) -> list[Sweep]:
        paths = self.paths
        pieces = distinct(paths, _settled(paths, paths.below(height, steps=paths.cuts), level))
        pieces = pieces.only(np.argsort(pieces.step, kind="stable"))
        chords = np.cumsum(paths.corners(pieces, SWEEP_CHORD))
        beyond = int(np.searchsorted(chords, MOST_CHORDS, side="right"))
        if beyond < len(pieces):
            line = int(paths.run.line[pieces.step[beyond]])
            raise ProgramError(
                f"line {line}: the cuts down to Z{height:g} have over {MOST_CHORDS:,} chords up to here, "
                "most of them in arcs; split the program"
            )
        radius = np.round(paths.radius_at(pieces, level), 6)
        return [
            Sweep(float(one), paths, pieces.only(radius == one)) for one in np.unique(radius[radius > NEAR])
        ]

    def foot(self, bottom: float, thickness: float) -> tuple[float, list[Sweep]]:
        """The height z, mm, at which a band above ``bottom`` is measured, and what is cut there.

        Above a floor it is as high as stock may be left, which cusps are; the underside is cut through.
        """
        if bottom <= -thickness + NEAR:
            return bottom, self.at(bottom + ROUNDING, bottom)
        level = bottom + TOLERANCES.leftover
        return level, self.at(level, level)

    def through(self, thickness: float) -> list[Sweep]:
        """What is cut at the underside of a plate."""
        return self.at(-thickness + ROUNDING, -thickness)


def _settled(paths: Paths, pieces: Pieces, level: float) -> Pieces:
    """Pieces of known width at ``level``: a round cutter on a ramp counts where it is as wide as it gets."""
    nose = paths.cutter.nose[pieces.step]
    drop = np.abs(paths.start[pieces.step, 2] - paths.end[pieces.step, 2])
    ramps = (nose > 0) & (drop > 0) & (paths.length[pieces.step] > drop + NEAR)
    if not ramps.any():
        return pieces
    parts = [pieces.only(~ramps)]
    for one in np.unique(nose[ramps]).tolist():
        parts.append(paths.below(level - one, steps=pieces.step[ramps & (nose == one)]))
    return Pieces(*(np.concatenate([getattr(part, name) for part in parts]) for name in PARTS))
