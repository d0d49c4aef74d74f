"""What holds the bodies of a spherical linkage: pins whose axes all meet in the centre."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from mechwright import GROUND, Joint
from mechwright.contracts.joint import Vector, fixed
from mechwright_spherical.kinematics.chain import orientation
from mechwright_spherical.kinematics.drive import Train
from mechwright_spherical.kinematics.linkage import Linkage
from mechwright_spherical.kinematics.vectors import arc


def held_by(
    linkage: Linkage, train: Train | None, radius: float, slotted: Sequence[str] = ()
) -> dict[str, Joint]:
    """Joints of the phase that is shown, each at ``radius`` mm from the centre; the loop is closed in C.

    Pins that are ``slotted``, a or c, are fixed in the coupler. The arm of a five-bar turns with the crank,
    by gears or by two motors that keep their ratio.
    """
    loop = linkage.shown.loop
    rocker = math.acos(float(loop.cb))
    arcs = {"b0": float(arc(loop.a0, loop.b0)), "a": float(arc(loop.a0, loop.a1))}

    def pin(one: str, two: str, angle: float, *, drives: bool = False) -> Joint:
        return _about((math.cos(angle), math.sin(angle), 0.0), one, two, radius, drives=drives)

    held = {**fixed(GROUND, "ground", "base"), "a0": pin("ground", "crank", 0.0, drives=True)}
    if linkage.five_bar is None:
        held["b0"] = pin("ground", "rocker", arcs["b0"])
    else:
        held["b0"] = pin("ground", "arm", arcs["b0"])
        held["b"] = pin("arm", "rocker", float(arc(loop.b0, loop.b1)))
        held["ratio"] = Joint("gear", "crank", "arm", ratio=float(loop.ratio))
    held["a"] = pin("crank", "coupler", arcs["a"])
    held["c"] = pin("rocker", "coupler", rocker)
    for name in slotted:
        held |= fixed("coupler", f"coupler-{name}")
    if train is not None:
        held |= fixed("crank", "pinion")
        if train.idler_axis is not None:
            axis = orientation(loop.a0, loop.b0).T @ train.idler_axis
            held["idler-shaft"] = _about(axis, "ground", "idler", radius)
            held["idler-ratio"] = Joint("gear", "crank", "idler", ratio=train.idler_ratio)
    return held


def _about(direction: ArrayLike, one: str, two: str, radius: float, *, drives: bool = False) -> Joint:
    """A joint about a direction through the centre, in the coordinates of ``one``."""
    unit = np.asarray(direction, dtype=float)
    return Joint("revolute", one, two, _tuple(radius * unit), _tuple(unit), drives=drives)


def _tuple(vector: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> Vector:
    x, y, z = vector.tolist()
    return x, y, z
