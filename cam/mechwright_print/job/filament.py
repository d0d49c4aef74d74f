"""Filament that a part takes: full lines at its walls, full layers at its faces, a share of the inside."""

from typing import TYPE_CHECKING

import shapely

from mechwright.contracts.part import Part
from mechwright.contracts.sections import sections
from mechwright_print.printer.settings import Printer
from mechwright_print.settings import PrintSettings

if TYPE_CHECKING:
    from mechwright_print.meshes.printed_mesh import PrintedMesh

CHORD = 0.02
"""Chord error of the sections that are weighed, mm: their areas are right to a thousandth."""


def filament_mass(
    model: Part, mesh: "PrintedMesh | None", settings: PrintSettings, printer: Printer
) -> float:
    """Mass of the filament in one copy, g; skirts, supports and what is purged are not counted.

    Of a body that is no plate the shell is taken as if it were a ball's: its area times its thickness. A
    plate needs no mesh: its sections have its volume.
    """
    if mesh is None:
        inside = sum(float((one.bottom - one.top) * one.shape.area) for one in sections(model, CHORD, 0))
    else:
        inside = _volume(mesh)
    share = settings.infill
    if share == 1:
        return inside * printer.grams_per_mm3
    filled = _plate_inside(model, settings, printer) if model.outline is not None else None
    if filled is None and mesh is not None:
        filled = _body_inside(mesh, settings, printer)
    hollow = inside if filled is None else min(filled, inside)
    return (inside - (1 - share) * hollow) * printer.grams_per_mm3


def _plate_inside(model: Part, settings: PrintSettings, printer: Printer) -> float:
    """Volume of a plate that gets infill: within its lines, and not under its faces; mm³."""
    layers = sections(model, CHORD, 0)
    skin = settings.skins * printer.layer
    depth = settings.walls * printer.line_width
    total = 0.0
    for layer in layers:
        top, bottom = layer.top, layer.bottom
        core = shapely.buffer(layer.shape, -depth)
        for one in layers:  # what is open within a skin above or below is a face there
            if one is not layer and (abs(one.bottom - top) < skin or abs(one.top - bottom) < skin):
                core = shapely.intersection(core, shapely.buffer(one.shape, -depth))
        high = top + (skin if top <= 0 or core.is_empty else 0.0)
        low = bottom - (skin if bottom >= model.thickness - 1e-6 else 0.0)
        total += max(low - high, 0.0) * core.area
    return float(total)


def _volume(mesh: "PrintedMesh") -> float:
    from mechwright_print.meshes.printed_mesh import volume

    return float(volume(mesh.mesh))


def _body_inside(mesh: "PrintedMesh", settings: PrintSettings, printer: Printer) -> float:
    import numpy as np

    a, b, c = mesh.mesh.points[mesh.mesh.triangles].transpose(1, 0, 2)
    area = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
    shell = area * settings.walls * printer.line_width
    return max(_volume(mesh) - shell, 0.0)
