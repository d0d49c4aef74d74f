"""Several plates on one table: the tool that works at one stays clear of the others."""

import numpy as np

from mechwright.arrays import Array
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene

Box = tuple[float, float, float, float]


def covered(scene: Scene, top: float) -> tuple[Ints, Array]:
    """The steps (m,) that go below a height, and the box (m, 4) that cutter and holder cover there, mm.

    A box is least x, least y, greatest x, greatest y. The holder begins behind the flutes where the library
    does not know it.
    """
    paths = scene.paths
    low = paths.steps[paths.low[paths.steps] < top - NEAR]
    least, most = paths.extent(low)
    radius = paths.radius[low]
    holder = paths.of_tool(lambda tool: tool.stick_out or tool.flute_length)[low]
    sunk = paths.low[low] + holder < top - NEAR
    radius[sunk] = np.maximum(radius, paths.of_tool(lambda tool: tool.holder_diameter / 2)[low])[sunk]
    return low, np.hstack((least - radius[:, None], most + radius[:, None]))


def apart(boxes: Array, stock: Box) -> str:
    """How far two equal plates have to be apart, whichever side the other one is on."""
    (x0, y0), (x1, y1) = boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)
    across, along = max(x1 - stock[0], stock[2] - x0), max(y1 - stock[1], stock[3] - y0)
    return f"{across:.1f} mm apart in X or {along:.1f} mm in Y, from zero to zero"


def neighbours(scene: Scene) -> Check:
    """Tool and holder stay clear of the plates at other work offsets, where it is known how these lie."""
    settings, stock = scene.job.settings, scene.job.stock
    if not settings.more_offsets:
        return Check(True, "one plate, one work offset")
    highest, words = scene.job.highest, scene.control.offset_words
    here, own = settings.measured, words(settings.work_offset)
    usual = covered(scene, highest)[1]
    if not len(usual):
        return Check(True, "no tool comes down")
    wanted, unknown = apart(usual, stock), []
    for other in settings.more_offsets:
        there = settings.measured.of(other)
        if here.x is None or here.y is None or there.x is None or there.y is None:
            unknown.append(words(other))
            continue
        x, y = there.x - here.x, there.y - here.y
        up = 0.0 if here.z is None or there.z is None else there.z - here.z
        steps, boxes = covered(scene, highest + up)
        beside = (stock[0] + x - boxes[:, 2], boxes[:, 0] - stock[2] - x)
        gaps = np.max((*beside, stock[1] + y - boxes[:, 3], boxes[:, 1] - stock[3] - y), axis=0)
        worst = int(np.argmin(gaps)) if steps.size else 0
        if steps.size and gaps[worst] < 0:
            gap = float(gaps[worst])
            message = f"tool or holder at {own} comes {-gap:.1f} mm over the plate at {words(other)}; "
            return scene.bad(int(steps[worst]), f"{message}clamp them {wanted}", gap, 0.0, "mm")
    if unknown:
        message = (
            f"where {' and '.join(sorted({own, *unknown}))} lie from each other is not known: for tool and "
            f"holder the plates have to be {wanted}"
        )
        return Check(True, message, told=True)
    return Check(True, f"tool and holder at {own} stay clear of the other plates")
