"""The part as a drawing has it, for certificates and for programs without one; needs ezdxf.

Layers: OUTLINE, BORE, OPENING and 0 hold contours through the plate, POCKET_3.5 that of a recess 3.5 mm
deep, POCKET_5_FROM_2 one that begins 2 mm down; CENTRE, TEXT, OPEN and DEFPOINTS hold nothing that is cut.
"""

import argparse
import re
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import shapely
import shapely.affinity

from mechwright_check import RefutedError, UnknownError
from mechwright_check.certificate import content, cutter, program
from mechwright_check.checks import GOUGE, Case
from mechwright_check.geometry import SAG
from mechwright_check.reading import read

THROUGH = re.compile(r"OUTLINE|BORE(_[A-Z]+\d+)?|OPENING|0")
RECESS = re.compile(r"(?:POCKET|BORE_[A-Z]+\d+)_(\d+(?:\.\d+)?)(?:_FROM_(\d+(?:\.\d+)?))?(?:_OPEN)?")
IDLE = {"CENTRE", "TEXT", "OPEN", "DEFPOINTS"}
GAP = 0.001
"""Ends of curves so near to each other meet."""


def levels_of(path: Path, thickness: float) -> list[tuple[float, float, Any]]:
    """The levels of a drawn plate, z = 0 on its top, in the drawing's own coordinates."""
    try:
        import ezdxf.path
        from ezdxf.filemanagement import readfile
        from ezdxf.lldxf.const import DXFError
    except ImportError:
        raise UnknownError("drawings need ezdxf: pip install 'mechwright-check[dxf]'") from None
    content(path)
    curves: dict[str, list[Any]] = {}
    try:
        document = readfile(path)
        for entity in document.modelspace():
            if (layer := entity.dxf.layer.upper()) not in IDLE:
                line = ezdxf.path.make_path(entity).flattening(SAG)
                curves.setdefault(layer, []).append(np.array([(p.x, p.y) for p in line]))
        if document.units not in {0, 4}:
            raise UnknownError(f"{path.name}: its units are not millimetres")
    except (OSError, DXFError, TypeError, ValueError, AttributeError, LookupError) as error:
        raise UnknownError(f"{path.name}: cannot be read as a drawing ({type(error).__name__})") from None
    through, recesses = list[Any](), list[Any]()
    for layer, lines in curves.items():
        if recess := RECESS.fullmatch(layer):
            recesses.append((float(recess[2] or 0), min(float(recess[1]), thickness), _region(lines, path)))
        elif THROUGH.fullmatch(layer):
            through += lines
        else:
            raise UnknownError(f"{path.name}: the layer {layer!r:.40} has no meaning here")
    plate = _region(through, path)
    heights, found = sorted({0.0, thickness, *(h for top, bottom, _ in recesses for h in (top, bottom))}), []
    for top, bottom in pairwise(heights):
        open_ = [shape for start, end, shape in recesses if start <= top and end >= bottom]
        found.append((-top, -bottom, shapely.difference(plate, shapely.union_all(open_))))
    return found


def _region(lines: list[Any], path: Path) -> Any:
    """What lies within an odd number of the contours of curves, of which ends that nearly meet are one."""
    known: list[Any] = []
    for line in lines:
        for end in (0, -1):
            line[end] = next((place for place in known if np.hypot(*(place - line[end])) < GAP), line[end])
            known.append(line[end].copy())
    merged = shapely.get_parts(shapely.line_merge(shapely.MultiLineString(lines)))
    if not all(line.is_closed and len(line.coords) > 3 for line in merged):
        raise UnknownError(f"{path.name}: a contour is not closed")
    region = shapely.Polygon()
    for line in merged:
        region = shapely.symmetric_difference(region, shapely.Polygon(line))
    return region


def compare(case: Case, origin: list[float], path: Path) -> None:
    """Each level of a certificate is that of the drawing, within the gouge limit."""
    drawn = levels_of(path, -case.levels[-1][1])
    for top, bottom, shape in case.levels:
        middle = (top + bottom) / 2
        own = next(level for high, low, level in drawn if low <= middle <= high)
        own = shapely.affinity.translate(own, -origin[0] / 1000, -origin[1] / 1000)
        for one, other in ((shape, own), (own, shape)):
            apart = shapely.difference(one, other.buffer(GOUGE))
            if apart.area > SAG**2:
                x, y = apart.representative_point().coords[0]
                raise RefutedError(
                    f"the certificate's part is not that of {path.name} at X{x:.3f} Y{y:.3f} Z{middle:.3f}"
                )


def add_options(parser: argparse.ArgumentParser) -> None:
    """What has to be said of a program that has no certificate."""
    parser.add_argument("--control", help="without a certificate: the control that runs it")
    parser.add_argument("--thickness", type=float, help="of the plate, mm")
    parser.add_argument("--tools", help="T number, kind and diameter, mm: 1=end-mill:6,2=drill:5")
    parser.add_argument("--stock", help="the plate: least x, least y, greatest x, greatest y, mm")
    parser.add_argument("--below", type=float, default=0.3, help="how deep cuts go below the plate, mm")


def case_of(asked: argparse.Namespace, notes: list[str]) -> Case:
    """A program and a drawing, with no claims; the whole plate is held from below."""
    try:
        plate = shapely.box(*map(float, asked.stock.split(",")))
        tools = dict(_tool(*re.split("[=:]", text)) for text in asked.tools.split(","))
        levels = levels_of(asked.dxf, asked.thickness + 0.0)
    except (ValueError, TypeError, AttributeError):
        raise UnknownError(
            "a program without a certificate needs --dxf, --control, --thickness, --tools, --stock"
        ) from None
    far = [-1e4, 1e4]
    machine = {"x": far, "y": far, "z": far, "zero": [None] * 3, "retract": -1e4, "work_offset": None}
    moves = read(asked.control, {asked.certificate.name: program(asked.certificate)}, machine, tools)
    limits = {"play": 0.0015, "lowest": -asked.thickness - asked.below, "tab_slack": 0.5}
    hold = {"method": "vacuum", "tabs": [], "prisms": []}
    machine |= {"max_feed": 1e6, "spindle": [0.0, 1e6]}
    return Case(moves, [asked.certificate.name], tools, levels, plate, hold, machine, limits, notes)


def _tool(number: str, kind: str, diameter: str) -> tuple[int, Any]:
    """A tool of the list; drills have points of 118 degrees, and flutes are as long as they need be."""
    radius, cone = float(diameter) * 500, {"tip": 0.0, "slope": np.tan(np.radians(59))}
    if kind != "drill":
        cone = {"tip": radius, "slope": None}
    said = {"radius": radius, "kind": kind, "flute_length": 1e6, "speed": None, "stick_out": None}
    return int(number), cutter({**said, **cone})
