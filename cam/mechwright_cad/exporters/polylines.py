"""DXF drawings of measured outlines: closed polylines on layers of their own. Imports ezdxf."""

from collections.abc import Mapping, Sequence

import numpy as np
from ezdxf import units
from ezdxf.filemanagement import new

from mechwright.arrays import Array
from mechwright.geometry.segments import Point
from mechwright_cad.exporters.dxf import TEXT_HEIGHT, finished, fixed_metadata

MARK = 1.0
"""Radius of the circle about a marked place, mm."""


def polylines(
    layers: Mapping[str, Sequence[Array]],
    marks: Sequence[tuple[Point, str]] = (),
    text: str = "",
) -> bytes:
    """The drawing (R2010, mm).

    Parameters
    ----------
    layers
        Name of a layer to closed polylines (n, 2), mm.
    marks
        Places with a few words, on the layer ``MARK``.
    text
        Lines below the drawing, on the layer ``TEXT``.
    """
    with fixed_metadata():
        document = new("R2010", units=units.MM)
        document.header["$MEASUREMENT"] = 1
        for number, name in enumerate((*layers, "MARK", "TEXT"), start=1):
            document.layers.add(name, color=number, lineweight=18)
        space = document.modelspace()
        for name, rings in layers.items():
            for ring in rings:
                drawn = space.add_lwpolyline([], close=True, dxfattribs={"layer": name})
                # All points at once, without widths and bulges: one by one takes time in their square.
                drawn.lwpoints.extend(np.column_stack((ring, np.zeros((len(ring), 3)))).tolist())
        for (x, y), words in marks:
            space.add_circle((x, y), MARK, dxfattribs={"layer": "MARK"})
            note = space.add_text(words, height=TEXT_HEIGHT / 2, dxfattribs={"layer": "MARK"})
            note.set_placement((x + 1.5 * MARK, y))
        every = np.concatenate([ring for rings in layers.values() for ring in rings])
        (x0, y0), (x1, y1) = every.min(axis=0).tolist(), every.max(axis=0).tolist()
        return finished(document, (x0, y0, x1, y1), text)
