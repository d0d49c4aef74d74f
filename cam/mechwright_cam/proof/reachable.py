"""What cutters leave at a height of the part although nothing hinders them from going there.

Glossary
--------
layer
    Top, z in mm, and what has to stay from there down to the next layer.
rest
    What has to stay at a height, with all around it that no cutter gets at: the corners that its radius does
    not enter, and at the foot of a wall the fillet of its nose.

A cutter whose tip is at t may stand where at the top of every layer above t it is as far from what stays as
it is wide there. At the height z it then sweeps discs as wide as it is at z - t. A flat end mill does most
with its tip at z, and leaves the closing of the layer. A round one leaves less if it can go deeper, past the
edge of a floor or below the underside, so all heights of tips count that lead somewhere.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from mechwright.cutter import cutter
from mechwright.tooling import Tool
from mechwright_cam.proof.fillets import Fillet, stay
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import Shape, closing, grow

Layer = tuple[float, Shape]


@dataclass(frozen=True)
class Surroundings:
    """What has to stay: layers from the top of the plate down, and the fillets of floors."""

    layers: Sequence[Layer]
    fillets: Sequence[Fillet] = ()


@dataclass(frozen=True)
class Reach:
    """The mills of a program.

    Parameters
    ----------
    mills
        All of them, one at least.
    play
        Air on either side without which a cutter does not enter, mm.
    """

    mills: Sequence[Tool]
    play: float

    @property
    def flat(self) -> float:
        """Radius of the smallest flat end mill with its play, mm; inf if there is none."""
        return min((tool.radius + self.play for tool in self.mills if tool.nose == 0), default=np.inf)

    @property
    def noses(self) -> tuple[float, ...]:
        """The different corner radii of the round mills, mm."""
        return tuple(sorted({tool.nose for tool in self.mills if tool.nose > 0}))

    def least(self, height: float) -> float:
        """Radius of the narrowest mill at a height above its tip, mm."""
        return min(float(cutter(tool).radius_at(height)) for tool in self.mills)

    def rest(self, around: Surroundings, place: int, height: float, tips: Sequence[float]) -> Shape:
        """What stays at ``height``, z in mm, in the layer of index ``place``.

        ``tips`` are the heights at which floors lie below, the layer's own bottom first.
        """
        layer = around.layers[place][1]
        solid = [one for one in (fillet.solid(height) for fillet in around.fillets) if not one.is_empty]
        keep = shapely.union_all([layer, *solid]) if solid else layer
        found: Shape | None = closing(keep, self.flat) if np.isfinite(self.flat) else None
        for tool in self.mills:
            if tool.nose == 0 or (tool.radius + self.play >= self.flat and not around.fillets):
                continue
            for tip in (*tips, min(tips) - tool.nose):
                left = shapely.union(keep, self._rest_of(tool, around, height, tip))
                found = left if found is None else shapely.intersection(found, left)
        assert found is not None  # noqa: S101 - there is a mill
        return found

    def _rest_of(self, tool: Tool, around: Surroundings, height: float, tip: float) -> Shape:
        """What one cutter leaves that works with its tip at one height."""
        shape = cutter(tool)
        blocked: dict[int, tuple[float, Shape]] = {}
        for top, keep in around.layers:
            if top > tip + NEAR:
                away = float(shape.radius_at(top - tip)) + self.play
                blocked[id(keep)] = max(away, blocked.get(id(keep), (0.0, keep))[0]), keep
        shapes = [grow(keep, away) for away, keep in blocked.values()]
        for fillet in around.fillets:
            off = stay(tool.nose, fillet.radius, tip - fillet.floor)
            shapes.append(grow(fillet.walls, tool.radius + off + self.play))
        return grow(shapely.union_all(shapes), -float(shape.radius_at(height - tip)) - self.play)
