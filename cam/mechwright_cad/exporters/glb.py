"""Binary glTF: parts, and assemblies that move, the same bytes for the same parts. Imports the CAD kernel.

glTF is in metres with y up, as its specification demands.
"""

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.motion import TIME, Motion, Poses
from mechwright.contracts.part import Colour, Part
from mechwright_cad.bodies import bodies_of
from mechwright_cad.exporters.mesh import corner_normals, part_mesh
from mechwright_cad.interference.path import STILL, space_path
from mechwright_cad.solids import solid as solids

_Y_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
_TRIANGLES, _FLOAT, _UNSIGNED, _VERTICES, _INDICES = 4, 5126, 5125, 34962, 34963
"""Numbers of the glTF 2.0 specification: primitive mode, component types, buffer targets."""


KEYS = 121
"""Positions of a moving body that a file holds: 3 degrees apart, with straight ways between."""

TURN = 8.0
"""Seconds in which a motion goes by that has no time of its own."""

FEWEST = 3
"""Samples of a motion that is shown: two are its ends."""


@dataclass(frozen=True)
class _Node:
    """A copy of a part: its name, the number of its look, and its pose, mm; with its poses where it moves."""

    name: str
    look: int
    turn: Array
    shift: Array
    poses: Poses | None = None
    height: float = 0.0


def glb_part(part: Part) -> bytes:
    """A part as binary glTF."""
    return _glb(part.name, [(part, part.colour)], [_Node(part.name, 0, np.eye(3), np.zeros(3))])


def glb_assembly(name: str, parts: Sequence[Part], motion: Motion, sample: int = 0) -> bytes:
    """All instances in their poses as binary glTF, nodes named by their bodies; what moves is animated."""
    whole = solids.assembly(name, parts, motion, sample)
    shown = [(part, part.colour_of(instance)) for part in parts for instance in part.instances]
    looks = list(dict.fromkeys((parts.index(part), colour) for part, colour in shown))
    nodes = []
    bodies = bodies_of(parts, motion, sample)
    for (part, colour), child, body in zip(shown, whole.children, bodies, strict=True):
        number = looks.index((parts.index(part), colour))
        placed = child.loc.wrapped.Transformation()
        rows = np.array([[placed.Value(i, j) for j in range(1, 5)] for i in range(1, 4)])
        poses = body.poses if motion.samples >= FEWEST and _moves(body.poses) else None
        nodes.append(_Node(child.name, number, rows[:, :3], rows[:, 3], poses, body.instance.z))
    return _glb(name, [(parts[number], colour) for number, colour in looks], nodes, motion)


def _moves(poses: Poses) -> bool:
    return bool(max(np.ptp(poses.position, axis=0).max(), np.ptp(poses.rotation, axis=0).max()) > STILL)


def _times(motion: Motion, keys: Array) -> Array:
    """Time (k,) of each key, s: that of the motion where it grows from 0, else a part of ``TURN``."""
    if TIME in motion.channels:
        own: Array = motion.channels[TIME].values[keys.astype(int)]
        if own[0] == 0 and (np.diff(own.astype("<f4")) > 0).all():
            return own
    return TURN * keys / (motion.samples - 1)


def _glb(
    name: str, looks: Sequence[tuple[Part, Colour]], nodes: Sequence[_Node], motion: Motion | None = None
) -> bytes:
    """Nodes with their number in ``looks`` and their pose; parts that differ in colour share triangles."""
    chunks: list[bytes] = []
    accessors: list[dict[str, object]] = []
    views: list[dict[str, int]] = []

    def store(values: Array, kind: str, target: int, component: int, **extra: object) -> int:
        data = values.tobytes()
        view = {"buffer": 0, "byteOffset": sum(map(len, chunks)), "byteLength": len(data)}
        views.append(view | ({"target": target} if target else {}))
        chunks.append(data)
        accessors.append(
            {
                "bufferView": len(views) - 1,
                "componentType": component,
                "count": len(values),
                "type": kind,
                **extra,
            }
        )
        return len(accessors) - 1

    shapes: dict[int, dict[str, object]] = {}
    for part, _ in looks:
        if id(part) in shapes:
            continue
        mesh = part_mesh(part)
        corners = np.concatenate([mesh.points[mesh.triangles] / 1000, corner_normals(mesh)], axis=2).reshape(
            -1, 2, 3
        )
        corners = (corners @ _Y_UP.T).reshape(-1, 6).astype("<f4")
        corners, index = np.unique(corners, axis=0, return_inverse=True)
        points = np.ascontiguousarray(corners[:, :3])
        limits = {"min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()}
        attributes = {
            "POSITION": store(points, "VEC3", _VERTICES, _FLOAT, **limits),
            "NORMAL": store(np.ascontiguousarray(corners[:, 3:]), "VEC3", _VERTICES, _FLOAT),
        }
        indices = store(index.ravel().astype("<u4"), "SCALAR", _INDICES, _UNSIGNED)
        shapes[id(part)] = {"attributes": attributes, "indices": indices, "mode": _TRIANGLES}
    meshes = [
        {"name": part.name, "primitives": [{**shapes[id(part)], "material": number}]}
        for number, (part, _) in enumerate(looks)
    ]
    animation = _animation(nodes, motion, store)
    body = b"".join(chunks)
    document = {
        "asset": {"version": "2.0", "generator": "Mechwright"},
        "scene": 0,
        "scenes": [{"name": name, "nodes": list(range(len(nodes)))}],
        "nodes": [{"name": node.name, "mesh": node.look, **_placed(node)} for node in nodes],
        "meshes": meshes,
        "materials": [_material(part.material, colour) for part, colour in looks],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(body)}],
        **({"animations": [animation]} if animation else {}),
    }
    head = json.dumps(document, separators=(",", ":")).encode()
    head += b" " * (-len(head) % 4)
    return b"".join(
        [
            b"glTF" + np.array([2, 12 + 8 + len(head) + 8 + len(body)], "<u4").tobytes(),
            np.uint32(len(head)).tobytes() + b"JSON" + head,
            np.uint32(len(body)).tobytes() + b"BIN\0" + body,
        ]
    )


def _animation(
    nodes: Sequence[_Node], motion: Motion | None, store: Callable[..., int]
) -> dict[str, object] | None:
    """The motion of all nodes that move, two samplers for each: place and turn; None of none."""
    moving = [
        (number, node.poses, node.height) for number, node in enumerate(nodes) if node.poses is not None
    ]
    if motion is None or not moving:
        return None
    keys = np.unique(np.rint(np.linspace(0, motion.samples - 1, min(KEYS, motion.samples))))
    times = np.ascontiguousarray(_times(motion, keys).astype("<f4"))
    limits = {"min": [float(times[0])], "max": [float(times[-1])]}
    clock = store(times, "SCALAR", 0, _FLOAT, **limits)
    samplers: list[dict[str, object]] = []
    channels: list[dict[str, object]] = []
    for number, poses, height in moving:
        places, turns = _keys(poses, height, keys.astype(int))
        for path, values, kind in (("translation", places, "VEC3"), ("rotation", turns, "VEC4")):
            output = store(np.ascontiguousarray(values.astype("<f4")), kind, 0, _FLOAT)
            channels.append({"sampler": len(samplers), "target": {"node": number, "path": path}})
            samplers.append({"input": clock, "output": output, "interpolation": "LINEAR"})
    return {"name": motion.input_name, "channels": channels, "samplers": samplers}


def _keys(poses: Poses, height: float, keys: NDArray[np.int64]) -> tuple[Array, Array]:
    """Places (k, 3), m, and unit quaternions (k, 4), scalar last, of a body whose part stands at a height."""
    path = space_path(poses.rotation[keys], poses.position[keys])
    places = path.position + poses.rotation[keys] @ (0.0, 0.0, height)
    turns = np.column_stack((path.attitude[:, 1:] @ _Y_UP.T, path.attitude[:, 0]))
    return places @ _Y_UP.T / 1000, turns / np.linalg.norm(turns, axis=1)[:, None]


def _placed(node: _Node) -> dict[str, list[float]]:
    """The pose of a node: a matrix, or place and turn of one that moves, as the format demands."""
    if node.poses is None:
        return {"matrix": _matrix(node.turn, node.shift)}
    one = Poses(node.shift[None], node.turn[None])
    places, turns = _keys(one, 0.0, np.array([0]))
    return {
        "translation": (np.round(places[0], 12) + 0.0).tolist(),
        "rotation": (np.round(turns[0], 12) + 0.0).tolist(),
    }


def _matrix(turn: Array, shift: Array) -> list[float]:
    """A pose as glTF holds it: column by column, y up, metres."""
    matrix = np.eye(4)
    matrix[:3, :3] = _Y_UP @ turn @ _Y_UP.T
    matrix[:3, 3] = _Y_UP @ shift / 1000
    return [round(value, 12) + 0.0 for value in matrix.T.ravel().tolist()]


def _material(name: str, colour: Colour) -> dict[str, object]:
    # glTF colours are linear, ours are meant for a screen.
    linear = [((c + 0.055) / 1.055) ** 2.4 if c > 0.04045 else c / 12.92 for c in colour]
    metal = {"baseColorFactor": [*linear, 1.0], "metallicFactor": 0.4, "roughnessFactor": 0.5}
    return {"name": name, "pbrMetallicRoughness": metal}
