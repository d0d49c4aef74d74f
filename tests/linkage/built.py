"""Layouts of the drawn linkages, made once, and shapes of their plates as they stand."""

import functools

import numpy as np
import shapely
from drawn_linkages import LINKAGES

from mechwright.mechanics.linkage.parts.layout import layout_of
from mechwright.mechanics.linkage.parts.sizes import Sizes

SAMPLES = 721
"""Positions at which shapes are compared: twice as many as the layers were found with, half of them new."""


@functools.cache
def laid_out(name, **sizes):
    linkage = LINKAGES[name].linkage()
    return layout_of(linkage, Sizes(**sizes), LINKAGES[name].moved(linkage))


@functools.cache
def fine(name):
    """The motion at twice as many positions."""
    return LINKAGES[name].moved(LINKAGES[name].linkage(), SAMPLES)


def placed(points, body):
    """Complex points (k,) of a link at every position, (n, k)."""
    return body.origin.position[:, None] + np.asarray(points)[None] * body.turning.direction[:, None]


def polygon(loop):
    return loop.flatten(0.01) @ np.array([1, 1j])


def shapes(layout, bodies, plate):
    """A plate without its openings at every position."""
    at = placed(polygon(layout.outlines[plate].outer), bodies[layout.link(plate)])
    return shapely.polygons(np.stack([at.real, at.imag], axis=-1))


def discs(pin, bodies, radius):
    at = placed([pin.place], bodies[pin.body])[:, 0]
    return shapely.buffer(shapely.points(at.real, at.imag), radius)
