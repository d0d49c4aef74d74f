"""Rules about rapid moves."""

import numpy as np
import shapely

from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.bands import stock_shape
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.stock import TOUCH

ABOVE = 0.2
"""Rapids down end at least so far above the stock, mm: plates are uneven, and tools are set, to tenths."""


def rapid_height(scene: Scene) -> Check:
    """Sideways rapids over the stock run at the clearance plane or above."""
    paths, limit = scene.paths, scene.job.settings.clearance
    rapid = paths.rapids
    sideways = np.hypot(*(paths.end - paths.start)[rapid, :2].T) > NEAR
    low = rapid[sideways & (paths.low[rapid] < limit - NEAR)]
    if low.size:
        lines = paths.lines(paths.below(np.inf, steps=low))
        over = low[shapely.dwithin(lines, stock_shape(scene.job), paths.radius[low])]
        if over.size:
            step = int(over[0])
            z = float(paths.low[step])
            message = f"a sideways rapid over the stock at Z{z:g}, the clearance plane is Z{limit:g}"
            return scene.bad(step, message, z, limit, "mm")
    return Check(True, "sideways rapids run at the clearance plane or above", limit=limit, unit="mm")


def rapids_in_stock(scene: Scene) -> Check:
    """No rapid meets material, nor ends right on it."""
    found = scene.stock.rapids
    for step in [] if found else _onto_stock(scene).tolist():
        z = float(scene.paths.end[step, 2])
        if scene.stock.meets(step, lift=-z - TOUCH, radius=float(scene.paths.radius[step])):
            message = f"a rapid ends {z:g} mm above the stock, less than {ABOVE:g} mm; feed the rest"
            return scene.bad(step, message, z, ABOVE, "mm")
    if found:
        message = f"a rapid into the stock ({len(found)} in all); feed there"
        return scene.bad(found[0], message, float(len(found)), 0.0)
    return Check(True, "no rapid meets material", value=0.0, limit=0.0)


def _onto_stock(scene: Scene) -> Ints:
    """Rapids that end down on the top of the stock, or nearly so."""
    paths = scene.paths
    rapid = paths.rapids
    z = paths.end[rapid, 2]
    onto: Ints = rapid[(z < ABOVE - NEAR) & (z >= -NEAR) & (z < paths.start[rapid, 2])]
    return onto
