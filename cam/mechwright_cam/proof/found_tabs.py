"""Tabs of a program that has them elsewhere than planned: what it leaves between part and frame.

With ``hold.tab_places = "found"`` they stand in for the planned ones, and all rules judge them as those.
"""

import math
from dataclasses import replace

import numpy as np
import shapely

from mechwright.contracts.part import Profile
from mechwright.geometry.prepared import prepared
from mechwright_cam.proof.bands import stock_shape
from mechwright_cam.proof.part_rules import lowest_cut
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import Shape, grow
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.sweep import BRIDGE, taken
from mechwright_cam.setup.holding import Tab, rectangle
from mechwright_cam.setup.tabs import TAB_REACH

FILM = 0.05
"""Stock so thin on a wall is no bridge, mm: five times what may be left."""
NARROWEST = 0.3
"""A bridge narrower than that is none, mm."""
ACROSS = 24
"""So many places across the channel are looked at for where a bridge is narrowest."""


def with_found_tabs(scene: Scene) -> Scene:
    """The scene with the tabs that the program leaves, if the job asks for those."""
    hold = scene.job.settings.hold
    if hold.method != "tabs" or hold.tab_places != "found" or scene.job.side == "underside":
        return scene
    return replace(scene, job=replace(scene.job, tabs=found_tabs(scene)))


def found_tabs(scene: Scene) -> tuple[Tab, ...]:
    """The bridges from the outsides of the job to the frame, as the program leaves them."""
    job = scene.job
    plate, cut = stock_shape(job), scene.sweeps.through(job.thickness)
    bodies = [
        shapely.Polygon(feature.loop.flatten())
        for feature in job.features
        if isinstance(feature, Profile) and feature.side == "outside"
    ]
    walls = [grow(body, FILM, FILM / 10) for body in bodies]
    rest = shapely.difference(plate, shapely.union_all([*taken(cut, plate), *walls]))
    pieces = shapely.get_parts(rest)
    near = np.array([shapely.dwithin(pieces, wall, BRIDGE) for wall in walls]).reshape(-1, pieces.size)
    frame = pieces[shapely.dwithin(pieces, plate.exterior, BRIDGE) | (near.sum(axis=0) > 1)]
    held: list[Tab] = []
    for wall in walls:
        meets = shapely.intersection(wall.exterior, grow(shapely.union_all(frame), BRIDGE, BRIDGE / 4))
        for line in shapely.get_parts(shapely.line_merge(meets)).tolist():
            if line.geom_type == "LineString" and NARROWEST < line.length < wall.exterior.length / 2:
                tab = _tab(scene, wall, line, shapely.union_all(frame))
                held += [] if tab is None else [tab]
    return tuple(held)


def _tab(scene: Scene, wall: Shape, line: shapely.LineString, frame: Shape) -> Tab | None:
    """The bridge that meets a wall along a line; None if it is too narrow."""
    job = scene.job
    middle = line.interpolate(0.5, normalized=True)
    (ax, ay), (bx, by) = line.coords[0], line.coords[-1]
    long = math.hypot(bx - ax, by - ay)
    if long < NARROWEST:
        return None
    tx, ty = (bx - ax) / long, (by - ay) / long
    if shapely.contains_xy(wall, middle.x + ty * FILM, middle.y - tx * FILM):
        tx, ty = -tx, -ty
    cutters = [s.radius for s in scene.sweeps.through(job.thickness) if s.paths_within_radius(line).size]
    channel = 2 * max(cutters, default=0.0)
    if channel <= 0:
        return None
    widths = []
    for out in np.linspace(FILM, channel, ACROSS).tolist():
        x, y = middle.x + out * ty, middle.y - out * tx
        sides = []
        for way in (-long, long):
            ray = shapely.LineString([(x, y), (x + way * tx, y + way * ty)])
            parts = shapely.get_parts(shapely.intersection(ray, frame))
            own = [part.length for part in parts.tolist() if part.distance(shapely.Point(x, y)) < BRIDGE]
            sides.append(max(own, default=0.0))
        widths.append(2 * min(sides))
    width = min(widths) - 2 * BRIDGE
    if width < NARROWEST:
        return None
    place = (middle.x, middle.y, (tx, ty))
    ends = (-TAB_REACH, channel)
    shape = rectangle(place, width, ends)
    outside = prepared(shapely.difference(shape, wall))
    low = lowest_cut(scene.paths, scene.paths.below(-NEAR, steps=scene.paths.cuts), outside)
    if low + job.thickness < NEAR:
        return None
    return Tab(shape, low, width, at=(middle.x, middle.y), along=(tx, ty), ends=ends)
