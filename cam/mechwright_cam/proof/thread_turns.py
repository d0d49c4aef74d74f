"""The turns of a milled thread: whether its helix is there, and whether the mill keeps to it.

A thread mill that touches the wall anywhere but on the helix takes away a crest between two turns. Tooth and
groove have the same flanks, so the tooth's peak decides: at a height δ off the groove it may reach in as far
as the flank there, by √3 δ less than the groove is deep, and no further than the crest where δ is greater.
"""

import math

import numpy as np

from mechwright.contracts.details import Thread
from mechwright_cam.controls.reading import Kind
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.paths import Paths
from mechwright_cam.shop.tool import ToolKind

FITS = 0.02
"""A thread's helix may be off in radius and pitch by so much, mm: a fraction of any thread's tolerance."""
SPACING = 0.1
"""Distance of the places along a path at which the mill is looked at, mm."""
LEADS = 1 / 8
"""A flank may be cut into by so much, in pitches: ways in and out on an arc do not climb, and take a part of
it."""
FLANK = math.sqrt(3.0)
"""Depth of a flank of 60° for its height along the axis."""


def turns(paths: Paths, detail: Thread) -> Ints:
    """The arcs that go round on a thread's helix."""
    run, steps = paths.run, paths.of_kinds({ToolKind.THREAD_MILL}).steps
    arcs = steps[run.kind[steps] == Kind.ARC]
    centred = np.hypot(*(run.centre[arcs] - detail.centre).T) < FITS
    wide = np.abs(run.radius[arcs] + paths.radius[arcs] - detail.diameter / 2) < FITS
    arcs = arcs[centred & wide]
    rise = (paths.end[arcs, 2] - paths.start[arcs, 2]) / np.where(run.sweep[arcs] == 0, 1, run.sweep[arcs])
    found: Ints = arcs[np.abs(rise * 2 * np.pi - pitch_of(detail)) < FITS]
    return found


def pitch_of(detail: Thread) -> float:
    """How far a thread climbs with a turn to the left, mm; negative for a left-hand one."""
    return -detail.pitch if detail.left else detail.pitch


def unthreaded(paths: Paths, detail: Thread) -> str:
    """What a milled thread lacks; nothing if it is there to its last turn."""
    run, arcs = paths.run, turns(paths, detail)
    if arcs.size == 0:
        hand = "left-hand" if detail.left else "right-hand"
        size = f"{detail.diameter:g} mm with a pitch of {detail.pitch:g} mm"
        return f"no {hand} helix of {size} around its axis"
    low = float(np.minimum(paths.start[arcs, 2], paths.end[arcs, 2]).min())
    high = float(np.maximum(paths.start[arcs, 2], paths.end[arcs, 2]).max())
    count = float(np.abs(run.sweep[arcs]).sum()) / (2 * np.pi)
    if low > -detail.depth + FITS or high < 0 or count < detail.depth / detail.pitch:
        return f"the thread runs from Z{low:.3f} to Z{high:.3f}, not from Z{-detail.depth:g} to the top"
    return ""


def off_helix(paths: Paths, detail: Thread) -> tuple[int, float, tuple[float, float, float]] | None:
    """The step in which a mill goes deepest into the turns of its thread, how deep, mm, and where."""
    helix = turns(paths, detail)
    if not helix.size:
        return None
    places, z, step = paths.samples(paths.of_kinds({ToolKind.THREAD_MILL}).steps, SPACING)
    off = places - detail.centre
    reach = np.hypot(*off.T) + paths.radius[step]
    inside = (z <= 0) & (reach > detail.core / 2) & (reach < detail.diameter / 2 + FITS)
    if not inside.any():
        return None
    places, off, z, step, reach = places[inside], off[inside], z[inside], step[inside], reach[inside]
    begin, pitch = paths.start[helix[0]], detail.pitch
    first = math.atan2(begin[1] - detail.centre[1], begin[0] - detail.centre[0])
    turned = (np.arctan2(off[:, 1], off[:, 0]) - first) / (2 * np.pi)
    beside = z - begin[2] - pitch_of(detail) * turned
    beside = np.abs(beside - pitch * np.round(beside / pitch))
    deep = reach - np.maximum(detail.core / 2, detail.diameter / 2 - FLANK * beside)
    worst = int(np.argmax(deep))
    return int(step[worst]), float(deep[worst]), (*places[worst].tolist(), float(z[worst]))
