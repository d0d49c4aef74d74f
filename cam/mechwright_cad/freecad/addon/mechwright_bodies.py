"""The bodies of an assembly: solids of its STEP file, names, colours and motion of its glTF file.

Both are written by ``mechwright model DESIGN -o FOLDER --also glb``, with the bodies in one order. glTF has
metres and Y up; FreeCAD has millimetres and Z up.
"""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import FreeCAD
import Part

LOWEST = (0, 20)
"""The FreeCAD that this was tried with."""
MILLIMETRES = 1000.0
_GAMMA = 2.4
"""Of sRGB: glTF has the linear colour."""


def too_old() -> str:
    """What to say where FreeCAD is too old; nothing where it is not."""
    version = FreeCAD.Version()
    if (int(version[0]), int(version[1])) >= LOWEST:
        return ""
    lowest = ".".join(map(str, LOWEST))
    return f"FreeCAD {version[0]}.{version[1]} is too old for this add-on: install {lowest} or newer"


class Assembly:
    """The bodies in a document, and where each is at any time."""

    def __init__(self, folder: str, document: Any) -> None:
        """Put all bodies of a folder into a document.

        Raises ValueError where the files do not belong together.
        """
        whole, self._data = _gltf(Path(folder, "assembly.glb"))
        shape = Part.read(str(Path(folder, "assembly.step")))
        solids = shape.SubShapes if shape.ShapeType == "Compound" else [shape]
        nodes = whole["nodes"]
        if len(solids) != len(nodes):
            raise ValueError(
                f"{folder}: {len(solids)} bodies in the STEP file, {len(nodes)} in the glTF file"
            )
        self._whole = whole
        self.features = []
        for node, solid in zip(nodes, solids):
            feature = document.addObject("Part::Feature", "Body")
            feature.Label = node["name"]
            feature.Shape = solid
            self.features.append(feature)
        self._rest = [feature.Placement for feature in self.features]
        self._start = [_placement(node) for node in nodes]
        self._tracks = self._animated()

    @property
    def names(self) -> list[str]:
        """Of the bodies, in order."""
        return [str(node["name"]) for node in self._whole["nodes"]]

    @property
    def count(self) -> int:
        """Positions of the motion; 1 of what stands still."""
        return max([len(track) for track in self._tracks.values()] or [1])

    def colour(self) -> None:
        """Give the bodies their colours; only with FreeCAD's window."""
        for node, feature in zip(self._whole["nodes"], self.features):
            primitive = self._whole["meshes"][node["mesh"]]["primitives"][0]
            looks = self._whole["materials"][primitive["material"]]["pbrMetallicRoughness"]
            feature.ViewObject.ShapeColor = tuple(_seen(value) for value in looks["baseColorFactor"][:3])

    def move(self, position: int) -> None:
        """Put all bodies where they are at a position of the motion."""
        for number, track in self._tracks.items():
            there = track[position % len(track)]
            # A solid may have other coordinates of its own than its node: the difference moves it.
            self.features[number].Placement = there.multiply(self._start[number].inverse()).multiply(
                self._rest[number]
            )

    def _animated(self) -> dict[int, list[Any]]:
        moving: dict[int, dict[str, list[tuple[float, ...]]]] = {}
        for animation in self._whole.get("animations", []):
            for channel in animation["channels"]:
                values = self._values(animation["samplers"][channel["sampler"]]["output"])
                moving.setdefault(channel["target"]["node"], {})[channel["target"]["path"]] = values
        found = {}
        for number, paths in moving.items():
            node = self._whole["nodes"][number]
            length = max(map(len, paths.values()))
            found[number] = [
                _placement({**node, **{path: values[i] for path, values in paths.items()}})
                for i in range(length)
            ]
        return found

    def _values(self, number: int) -> list[tuple[float, ...]]:
        accessor = self._whole["accessors"][number]
        view = self._whole["bufferViews"][accessor["bufferView"]]
        size = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        count = accessor["count"] * size
        flat = struct.unpack_from(f"<{count}f", self._data, start)
        return [flat[i : i + size] for i in range(0, count, size)]


def _gltf(path: Path) -> tuple[dict[str, Any], bytes]:
    content = path.read_bytes()
    length = struct.unpack_from("<I", content, 12)[0]
    return json.loads(content[20 : 20 + length]), content[20 + length + 8 :]


def _placement(node: dict[str, Any]) -> Any:
    """Where a node of glTF is, in FreeCAD's coordinates."""
    x, y, z = node.get("translation", (0.0, 0.0, 0.0))
    a, b, c, w = node.get("rotation", (0.0, 0.0, 0.0, 1.0))
    base = FreeCAD.Vector(MILLIMETRES * x, -MILLIMETRES * z, MILLIMETRES * y)
    return FreeCAD.Placement(base, FreeCAD.Rotation(a, -c, b, w))


def _seen(linear: float) -> float:
    """A linear colour as screens have it (IEC 61966-2-1)."""
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / _GAMMA) - 0.055
