"""A picture of a mechanism as its moving page shows it at one instant, as SVG."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.output import svg
from mechwright_cad.viewer.packed import corners, indices

INSTANT = 1 / 12
"""Part of the period at which it stands: the start has links in line or hidden behind each other."""
AZIMUTH, HEIGHT = math.radians(37), math.radians(30)
"""Where the eye stands that sees a mechanism in space, rad: around the upright, and above the horizon."""
LIGHT = np.array([0.3, -0.5, 0.8])
"""Where the light comes from."""
COVER = "0.25"
"""Opacity of what stands still above what moves, such as the upper plate of a frame."""
SHADES = 0.45
"""Part of its colour that a surface away from the light still has."""


def still(scene: Mapping[str, Any]) -> str:
    """The picture of what :func:`mechwright_cad.animation.scene.scene` gives."""
    return _plane(scene) if "window" in scene else _space(scene)


def _plane(scene: Mapping[str, Any]) -> str:
    x, y, width, height = scene["window"]
    line = max(width, height) / 400
    drawn, covering = [], False
    for layer in scene["layers"]:
        pose = scene["poses"].get(layer["body"], {"columns": [[0]] * 3})
        px, py, angle = (float(column[_at(column)]) for column in pose["columns"])
        down = " scale(1 -1)" if pose.get("down") else ""
        bones = layer.get("bones")
        moves = any(len(column) > 1 for column in pose["columns"])
        covering = covering or moves
        drawn.append(
            svg.element(
                "path",
                d=layer["path"],
                transform=f"translate({px:g} {py:g}) rotate({np.degrees(angle):.3f}){down}",
                fill="none" if bones else layer["colour"],
                fill_rule="evenodd",
                fill_opacity=None if moves or not covering else COVER,
                stroke=layer["colour"] if bones else "#22303c",
                stroke_width=svg.number(3 * line if bones else line),
                stroke_linejoin="round",
            )
        )
    for trace in scene["traces"].values():
        points = "M" + "L".join(f"{px:g} {py:g}" for px, py in trace)
        drawn.append(
            svg.element("path", d=points, fill="none", stroke="#b3261e", stroke_width=svg.number(2 * line))
        )
    turned = svg.element("g", "".join(drawn), transform="scale(1 -1)")
    return svg.picture(turned, (x, -y - height, width, height), "the mechanism")


def _space(scene: Mapping[str, Any]) -> str:
    right = np.array([math.cos(AZIMUTH), math.sin(AZIMUTH), 0.0])
    back = np.array([math.sin(AZIMUTH), -math.cos(AZIMUTH), 0.0])  # towards the eye
    near = math.cos(HEIGHT) * back + np.array([0.0, 0.0, math.sin(HEIGHT)])
    basis = np.array([right, np.cross(near, right), near]) @ _upright(scene["up"])
    faces: list[tuple[float, str]] = []
    for mesh in scene["meshes"]:
        columns = scene["poses"].get(mesh["body"], {"columns": [[0], [0], [0], [1], [0], [0], [0]]})[
            "columns"
        ]
        px, py, pz, w, a, b, c = (float(column[_at(column)]) for column in columns)
        form = scene["forms"][mesh["form"]]
        own = corners(form) + np.array((0.0, 0.0, mesh.get("z", 0.0)))
        points = own @ _turn(w, a, b, c).T + (px, py, pz)
        faces += _faces((points - scene["ball"]["centre"]) @ basis.T, indices(form), mesh["colour"])
    radius = scene["ball"]["radius"]
    paths = []
    for trace in scene["traces"].values():
        flat = (np.array(trace) - scene["ball"]["centre"]) @ basis.T
        paths.append(
            svg.element(
                "path",
                d=svg.path(flat[:, :2]),
                fill="none",
                stroke="#b3261e",
                stroke_width=svg.number(radius / 100),
            )
        )
    drawn = "".join(face for _, face in sorted(faces)) + "".join(paths)
    return svg.picture(drawn, (-radius, -radius, 2 * radius, 2 * radius), "the mechanism")


def _faces(points: Array, triangles: Array, colour: str) -> list[tuple[float, str]]:
    """Depth and drawing of each triangle that faces the eye."""
    three = points[triangles]
    normal = np.cross(three[:, 1] - three[:, 0], three[:, 2] - three[:, 0])
    size = np.linalg.norm(normal, axis=1)
    found = []
    rgb = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)])
    for triangle, unit in zip(three[size > 0], normal[size > 0] / size[size > 0, None], strict=True):
        if unit[2] <= 0:
            continue
        shade = SHADES + (1 - SHADES) * max(float(unit @ LIGHT), 0.0)
        tone = "#" + "".join(f"{min(round(value * shade), 255):02x}" for value in rgb)
        data = svg.path(triangle[:, :2], close=True)
        face = svg.element("path", d=data, fill=tone, stroke=tone, stroke_width="0.15")
        found.append((float(triangle[:, 2].mean()), face))
    return found


def _at(column: list[float]) -> int:
    return round(INSTANT * (len(column) - 1))


def _turn(w: float, x: float, y: float, z: float) -> Array:
    """The rotation matrix of a unit quaternion."""
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def _upright(up: list[float]) -> Array:
    """A rotation that takes the direction ``up`` to +z."""
    z = np.array(up, dtype=float) / np.linalg.norm(up)
    x = np.cross([0.0, 1.0, 0.0] if abs(z[1]) < 0.9 else [1.0, 0.0, 0.0], z)
    x = x / np.linalg.norm(x)
    return np.array([x, np.cross(z, x), z])
