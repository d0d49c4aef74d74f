"""Draws inch-bracket.dxf: a bracket in inches as a drawing office sends it, on layer 0, with no unit said.

Run it in this folder to draw the file anew: python inch-bracket.py
"""

from pathlib import Path

import ezdxf
from ezdxf.document import Drawing


def drawing() -> Drawing:
    """Lines and arcs in any order, an edge drawn twice, a small gap, holes as a block, dimensions beside."""
    document = ezdxf.new("R2000")
    document.header["$INSUNITS"] = 0
    document.header["$MEASUREMENT"] = 0
    space = document.modelspace()
    document.linetypes.add("CENTER", [1.0, 0.5, -0.1, 0.3, -0.1])
    space.add_line((0.25, 0), (2.75, 0))
    space.add_line((2.75, 0), (1.5, 0))
    space.add_line((3, 0.25), (3, 1.75))
    space.add_line((0.25, 2), (2.75, 2))
    space.add_line((0, 1.75), (0, 0.2503))  # it ends short of its arc
    for x, y, start in ((2.75, 0.25, 270), (2.75, 1.75, 0), (0.25, 1.75, 90), (0.25, 0.25, 180)):
        space.add_arc((x, y), 0.25, start, start + 90)
    space.add_lwpolyline([(1, 0.75, 0), (2, 0.75, 1), (2, 1.25, 0), (1, 1.25, 1)], format="xyb", close=True)
    document.blocks.new("DOWEL").add_circle((0, 0), 0.125)
    for x in (0.4, 2.6):
        space.add_blockref("DOWEL", (x, 1))
        space.add_line((x - 0.3, 1), (x + 0.3, 1), dxfattribs={"linetype": "CENTER"})
        for y in (0.4, 1.6):
            space.add_circle((x, y), 0.0985)
    space.add_linear_dim((0, -0.5), (0, 0), (3, 0)).render()
    return document


if __name__ == "__main__":
    drawing().saveas(Path(__file__).with_suffix(".dxf"))
