"""How fast each segment may be run, and with how much acceleration along it."""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np

from mechwright.arrays import Array
from mechwright_cam.controls.lookahead.segment_geometry import SegmentGeometry
from mechwright_cam.controls.lookahead.speeds import NO_LENGTH
from mechwright_cam.shop.machine import Machine

NORMAL = np.sqrt(0.75)
"""Share of an axis' acceleration that an arc may take across its path."""


@dataclass(frozen=True)
class Segments(SegmentGeometry):
    """Segments on machines.

    Parameters
    ----------
    asked, most
        (k,) speed that is asked for, and the greatest that the axes and an arc's radius allow, mm/s.
    acceleration
        (k,) along the path, mm/s², if nothing else takes any.
    highest
        (k,) acceleration of an axis, mm/s².
    """

    asked: Array
    most: Array
    acceleration: Array
    highest: Array

    @cached_property
    def speed(self) -> Array:
        """(k,) the smaller of ``asked`` and ``most``, mm/s."""
        return np.minimum(self.asked, self.most)


def segments(
    way: SegmentGeometry, machine: Machine, accelerations: Sequence[float], cycle: float
) -> Segments:
    """The segments on a machine with each of some accelerations, m/s²; servo period ``cycle``, s."""
    highest = np.repeat(1000.0 * np.array(accelerations), way.length.size)
    way = way.repeated(len(accelerations))
    z = machine.rapid if machine.rapid_z is None else machine.rapid_z
    axes = np.array((machine.rapid, machine.rapid, z)) / 60
    chord = np.abs(way.chord)
    nowhere = ~chord.any(axis=1) & ~way.arc
    chord[nowhere, 0] = way.length[nowhere]  # from an unknown place: along some axis
    # As a straight move the axes would take so long; an arc takes what its plane needs, too.
    time, ramp = (chord / axes).max(axis=1), chord.max(axis=1) / highest
    round_ = way.sweep * np.where(way.arc, way.radius, 0.0)
    flat = np.minimum(np.sqrt(NORMAL * highest * way.radius), axes[:2].min())
    time, ramp = np.maximum(time, round_ / flat), np.maximum(ramp, round_ / highest)
    most = np.minimum(np.minimum(way.length / np.maximum(time, 1e-12), axes.max()), way.length / cycle)
    feed = np.minimum(way.feed, machine.max_feed / 60)
    return Segments(
        **{one.name: getattr(way, one.name) for one in fields(SegmentGeometry)},
        asked=np.where(way.rapid, most, np.maximum(feed, NO_LENGTH)),
        most=most,
        acceleration=way.length / np.maximum(ramp, 1e-12),
        highest=highest,
    )
