"""Bodies of a job's picture: tools with shank and holder, clamps, tabs, and the finished part."""

from typing import Any

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright_cad.interference.slabs import Slab, triangles_of
from mechwright_cad.viewer.packed import form
from mechwright_cam.pages.job.relief import end_of
from mechwright_cam.proof.bands import bands
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.tool_collisions import Body, bodies, obstacles
from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.tool import Tool

CHORD = 0.05
"""Largest distance of what is drawn from its outline, mm."""

HOLDER = 30.0
"""So much of a holder is drawn, mm."""

SHANK = 2.0
"""Diameters of a tool that are drawn above its flutes, where its length out of the holder is not known."""

COLOURS = {"cutter": "#c9a227", "shank": "#8a929a", "holder": "#4b5965", "clamp": "#a33b2e", "tab": "#e6a100"}
GHOST = "#3d7fb8"

ROUND = 24
"""Corners of a quarter of the outline of a round clamp."""


def tools_of(scene: Scene) -> list[dict[str, Any]]:
    """Each tool that the run has in the spindle: name, sizes, the shape of its end, and outlines to turn."""
    used = set(scene.run.tool.tolist())
    held = bodies(scene)
    return [
        {
            "number": tool.number,
            "name": tool.name,
            "kind": str(tool.kind),
            "radius": tool.radius,
            "end": end_of(tool),
            "outlines": outlines(tool, [one for one in held if one.tool.number == tool.number]),
        }
        for tool in sorted(scene.tools.values(), key=lambda tool: tool.number)
        if tool.number in used
    ]


def outlines(tool: Tool, above: list[Body]) -> list[dict[str, Any]]:
    """Profiles (k, 2) of cutter, shank and holder: radius and height over the tip, mm; with their colours."""
    heights = np.unique(
        np.concatenate((np.linspace(0.0, min(tool.radius * 2, tool.flute_length), 17), [tool.flute_length]))
    )
    radii = cutter(tool).radius_at(heights)
    found = [_profile("cutter", np.column_stack((radii, heights)))]
    ends = {body.name: body for body in above}
    top = ends["holder"].lift if "holder" in ends else tool.flute_length + SHANK * tool.diameter
    shank = ends["shank"].radius if "shank" in ends else tool.radius
    if top > tool.flute_length:
        found.append(_profile("shank", np.array([(shank, tool.flute_length), (shank, top)])))
    if "holder" in ends:
        wide = ends["holder"].radius
        found.append(_profile("holder", np.array([(wide, top), (wide, top + HOLDER)])))
    return found


def _profile(name: str, corners: Array) -> dict[str, Any]:
    return {"colour": COLOURS[name], "profile": np.round(corners, 4).tolist()}


def fixtures_of(scene: Scene) -> list[dict[str, Any]]:
    """Clamps and jaws from the table up, each with the step from which on it is there, and the tabs."""
    bottom = -scene.job.thickness
    found = []
    for one in obstacles(scene):
        shape = one.shape.buffer(one.radius, quad_segs=ROUND) if one.radius > 0 else one.shape
        low = 0.0 if one.radius > 0 else bottom
        found += [_prism(one.name, "clamp", shape, low, one.top) | {"since": one.since}]
    for number, tab in enumerate(scene.job.tabs, start=1):
        found += [_prism(f"tab {number} (up to Z{tab.top:g})", "tab", tab.shape, bottom, tab.top)]
    return found


def _prism(name: str, kind: str, shape: shapely.Geometry, low: float, high: float) -> dict[str, Any]:
    slabs = [Slab(piece, low, high) for piece in _polygons(shape)]
    return {"name": name, "kind": kind, "colour": COLOURS[kind], "form": form(*triangles_of(slabs, CHORD))}


def ghost_of(scene: Scene) -> dict[str, Any]:
    """The finished part in work coordinates, without fillets on its floors."""
    slabs = [
        Slab(shapely.normalize(piece), band.bottom, band.top)
        for band in bands(scene.job)
        for piece in _polygons(band.keep)
    ]
    return {"colour": GHOST, "form": form(*triangles_of(slabs, CHORD))}


def _polygons(shape: shapely.Geometry) -> list[shapely.Polygon]:
    return [one for one in shapely.get_parts(shape) if isinstance(one, shapely.Polygon) and one.area > 0]
