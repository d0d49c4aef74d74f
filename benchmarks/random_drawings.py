"""Random drawings of plates, and what their design says of them, each from a seed of its own.

``likely``: a plate with features that stand apart in cells of a grid, on layers that mean something, some
with the habits of drawing offices: edges drawn twice, gaps, blocks, splines. ``whole``: entities of any size
anywhere, on any layer, with depths and threads that no plate has.
"""

import io
import math
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
from ezdxf.layouts import BaseLayout
from random_designs import WAYS

from mechwright import Design, DesignError, Host
from mechwright.designs.design import design_of

Rng = np.random.Generator
Points = list[tuple[float, float]]
Attribs = dict[str, Any]

THREADED = {
    "M3": 3,
    "M4": 4,
    "M5X0.5": 5,
    "THREAD_M6": 6,
    "M8_LH": 8,
    "1_4-20_UNC": 6.35,
    "#10-32_UNF": 4.826,
    "SCREW_M4": 4,
    "SUNK_M3": 3,
    "SCREW_1_4": 6.35,
}
"""Layers of threads and screws, and their diameters, mm."""
HOLES = ("BORE", "BORE_H7", "DRILL", "H7_8", *THREADED)
SHAPES = ("THROUGH", "POCKET_{0:.3g}", "POCKET_{0:.3g}_R0.5", "CUTOUT", "CHAMFER_0.5", "ENGRAVE_0.2")
STRANGE = (
    *("0", "Layer 1", "OUTLINE_2", "POCKET", "POCKET_-3", "POCKET_1e9", "POCKET_nan", "M99", "M5X9"),
    *("BORE_ZZ9", "SCREW_M1000", "CHAMFER_50", "ENGRAVE_0", "ENGRAVE_99_W0", "Ünterteil", "a|b"),
    *("POCKET_3_FROM_9", "TEXT"),
)
MEANT = (
    *("outline", "through", "pocket 2", "bore H7", "M5", "ignore", "screw M6", "chamfer 0.3"),
    *("", "no such thing"),
)


def plates(host: Host, seed: int, numbers: range, way: str) -> Iterator[Design]:
    """The designs with these numbers; the same seed and number give the same one."""
    with tempfile.TemporaryDirectory() as folder:
        for number in numbers:
            rng = np.random.default_rng([seed, number, WAYS.index(way)])
            (Path(folder) / "random.dxf").write_text(drawing(rng, way), encoding="utf-8")
            content = {"format": 1, "family": "plate", "name": "random"}
            while True:
                table = {"drawing": "random.dxf", **_table(rng, way)}
                try:
                    yield design_of({**content, "parameters": table}, Path(folder) / "random.toml", "", host)
                except DesignError:
                    continue
                break


def _table(rng: Rng, way: str) -> dict[str, Any]:
    wide = way == "whole"
    thickness = 10 ** rng.uniform(-1, 2.7) if wide else rng.uniform(2, 20)
    found: dict[str, Any] = {"thickness": float(f"{thickness:.3g}")}
    if rng.integers(3 if wide else 30) == 0:
        found["units"] = str(rng.choice(["drawing", "mm", "cm", "inch", "m", "mil"]))
    if rng.integers(4) == 0:
        found["scale"] = float(f"{10 ** (rng.uniform(-3, 3) if wide else rng.uniform(-0.3, 0.3)):.3g}")
    if rng.integers(4) == 0:
        found["join"] = float(f"{10 ** rng.uniform(-4, 0):.3g}")
    if rng.integers(3) == 0:
        found["origin"] = str(rng.choice(["corner", "centre"]))
    if rng.integers(4 if wide else 30) == 0:
        found["layers"] = {str(rng.choice(["0", "Layer 1", "colour 1", "THROUGH"])): str(rng.choice(MEANT))}
    if rng.integers(6) == 0:
        found["holes"] = {f"{rng.uniform(1, 12):.1f}": str(rng.choice(MEANT))}
    return found


def drawing(rng: Rng, way: str) -> str:
    """The text of a drawing."""
    likely = way == "likely"
    doc = ezdxf.new("R2010", units=4 if likely and rng.integers(20) else int(rng.choice([0, 1, 4, 5, 6])))
    space = doc.modelspace()
    if likely:
        _plate(space, rng)
    else:
        for _ in range(rng.integers(0, 40)):
            _anything(space, rng)
    if rng.integers(30 if likely else 4) == 0:
        block = doc.blocks.new("part")
        _closed(block, rng, complex(0, 0), 5.0, {"layer": str(rng.choice(SHAPES)).format(1.0)})
        for _ in range(rng.integers(1, 4)):
            scales = {f"{axis}scale": float(rng.choice([1, 1, -1, 2, 0.01])) for axis in "xy"}
            place = tuple(rng.uniform(-60, 60, 2))
            space.add_blockref("part", place, {**scales, "rotation": float(rng.uniform(-360, 360))})
    text = io.StringIO()
    doc.write(text)
    return text.getvalue()


def _plate(space: BaseLayout, rng: Rng) -> None:
    """A plate with features in some cells of a grid."""
    columns, rows, cell = int(rng.integers(1, 5)), int(rng.integers(1, 4)), rng.uniform(12, 30)
    width, height = cell * columns, cell * rows
    outline = {"layer": "OUTLINE" if rng.integers(9) else "0"}
    if rng.integers(5) == 0:
        _closed(space, rng, complex(width, height) / 2, math.hypot(width, height) / 2, outline)
    else:
        corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
        _contour(space, rng, corners, outline)
    for column in range(columns):
        for row in range(rows):
            if rng.integers(4) == 0:
                continue
            middle = complex((column + 0.5) * cell, (row + 0.5) * cell)
            reach = cell * rng.uniform(0.05, 0.47)
            if rng.integers(2):
                layer = str(rng.choice(HOLES))
                screw = THREADED.get(layer)
                radius = min(reach, rng.uniform(0.5, 8)) if screw is None else screw * rng.uniform(0.42, 0.5)
                space.add_circle((middle.real, middle.imag), radius, {"layer": layer})
                continue
            depth = rng.uniform(0.1, 6)
            _closed(space, rng, middle, reach, {"layer": str(rng.choice(SHAPES)).format(depth)})
            if rng.integers(3) == 0:
                _closed(space, rng, middle, reach / 2, {"layer": str(rng.choice(SHAPES)).format(depth / 2)})


def _anything(space: BaseLayout, rng: Rng) -> None:
    layers = [*SHAPES, *HOLES, *STRANGE, "OUTLINE"]
    layer = str(rng.choice(layers)).format(10 ** rng.uniform(-3, 3))
    attribs: Attribs = {"layer": layer, "color": int(rng.integers(0, 256))}
    if rng.integers(10) == 0:
        attribs["extrusion"] = tuple(rng.choice([(0, 0, -1), (0, 0, 1), (0, 1, 0), (0, 0.1, 1)]))
    size = 10 ** rng.uniform(-4, 4 if rng.integers(5) == 0 else 2)
    middle = complex(*rng.uniform(-100, 100, 2))
    kind: Callable[..., None] = (_closed, _closed, _open)[rng.integers(3)]
    kind(space, rng, middle, size, attribs)


def _open(space: BaseLayout, rng: Rng, middle: complex, size: float, attribs: Attribs) -> None:
    one, two = ((p.real, p.imag) for p in (middle, middle + size * complex(*rng.uniform(-1, 1, 2))))
    which = rng.integers(6)
    if which == 0:
        space.add_line(one, two if rng.integers(4) else one, attribs)
    elif which == 1:
        space.add_arc(one, size, *rng.uniform(-720, 720, 2), dxfattribs=attribs)
    elif which == 2:
        space.add_text("A5", height=size, dxfattribs=attribs).set_placement(one)
    elif which == 3:
        space.add_point(one, attribs)
    elif which == 4:
        points = [(*one, 0.0), *((*p, 0.0) for p in _star(rng, middle, size, int(rng.integers(1, 6))))]
        space.add_open_spline(points, degree=min(3, len(points) - 1), dxfattribs=attribs)
    else:
        space.add_lwpolyline(_star(rng, middle, size, int(rng.integers(1, 5))), dxfattribs=attribs)


def _star(rng: Rng, middle: complex, size: float, corners: int) -> Points:
    angles = np.sort(rng.uniform(0, math.tau, corners))
    points = [middle + size * rng.uniform(0.4, 1) * complex(math.cos(a), math.sin(a)) for a in angles]
    return [(point.real, point.imag) for point in points]


def _closed(space: BaseLayout, rng: Rng, middle: complex, size: float, attribs: Attribs) -> None:
    """A contour within a circle about a place."""
    place = (middle.real, middle.imag)
    which = rng.integers(6)
    if which == 0:
        space.add_circle(place, size, attribs)
    elif which == 1:
        axis = size * complex(math.cos(a := rng.uniform(0, math.tau)), math.sin(a))
        space.add_ellipse(place, (axis.real, axis.imag), rng.uniform(0.1, 1), dxfattribs=attribs)
    elif which == 2:
        points = _star(rng, middle, size, int(rng.integers(4, 9)))
        space.add_spline(dxfattribs=attribs).set_closed([(*p, 0.0) for p in points])
    elif which == 3:
        long, wide = size * 0.9, size * rng.uniform(0.1, 0.5)
        left, right = middle - (long - wide), middle + (long - wide)
        slot = [(left.real, left.imag - wide, 0.0), (right.real, right.imag - wide, 1.0)]
        slot += [(right.real, right.imag + wide, 0.0), (left.real, left.imag + wide, 1.0)]
        space.add_lwpolyline(slot, format="xyb", close=True, dxfattribs=attribs)
    else:
        half = size * complex(math.cos(a := rng.uniform(0.3, 1.2)), math.sin(a))
        corners = [middle - half, middle + half.conjugate(), middle + half, middle - half.conjugate()]
        _contour(space, rng, [(point.real, point.imag) for point in corners], attribs)


def _contour(space: BaseLayout, rng: Rng, corners: Points, attribs: Attribs) -> None:
    """Lines from corner to corner: a polyline, or lines with the habits of drawing offices."""
    if rng.integers(2):
        bulges = [0.0 if rng.integers(4) else float(rng.uniform(-0.3, 0.3)) for _ in corners]
        points = [(*point, bulge) for point, bulge in zip(corners, bulges, strict=True)]
        space.add_lwpolyline(points, format="xyb", close=True, dxfattribs=attribs)
        return
    gap = float(rng.choice([0, 0, 0, 0, 1e-7, 1e-3, 1e-3, 0.5])) * rng.uniform(0, 1)
    for one, two in zip(corners, [*corners[1:], corners[0]], strict=True):
        ends = [(one[0] + gap, one[1]), two]
        for _ in range(1 + (rng.integers(8) == 0)):
            space.add_line(*(ends if rng.integers(2) else ends[::-1]), attribs)
