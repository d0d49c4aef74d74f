"""Draws nema-17-plate.dxf: a plate for a NEMA 17 stepper, which slides on slots to tension its belt.

Run it in this folder to draw the file anew: python nema-17-plate.py
"""

from pathlib import Path

import ezdxf
from ezdxf import units
from ezdxf.document import Drawing

WIDE, HIGH, ROUND = 100.0, 80.0, 8.0
"""mm. The plate, and the radius of its corners."""
PILOT, PATTERN, SCREW, TRAVEL = 22.2, 31.0, 3.4, 8.0
"""Boss of the motor with play, square of its screws, their slots (M3 medium, ISO 273), how far it slides."""
FACE = 43.0
"""Square of the motor's face with play: the pocket that leads it."""
QUARTER = 0.41421356237309503


def drawing() -> Drawing:
    """The plate; layers say what is cut."""
    document = ezdxf.new("R2000", units=units.MM)
    space = document.modelspace()
    layers = {"OUTLINE": 7, "THROUGH": 4, "BORE_H7": 5, "M5": 3, "POCKET_2": 2, "ENGRAVE_0.2": 6}
    for name, colour in layers.items():
        document.layers.add(name, color=colour)
    x, y = WIDE / 2, HIGH / 2

    def loop(layer: str, corners: list[tuple[float, float, float]]) -> None:
        space.add_lwpolyline(corners, format="xyb", close=True, dxfattribs={"layer": layer})

    def rounded(layer: str, x0: float, y0: float, x1: float, y1: float, r: float) -> None:
        q = QUARTER
        loop(layer, [(x0 + r, y0, 0), (x1 - r, y0, q), (x1, y0 + r, 0), (x1, y1 - r, q),
                     (x1 - r, y1, 0), (x0 + r, y1, q), (x0, y1 - r, 0), (x0, y0 + r, q)])  # fmt: skip

    def slot(middle: tuple[float, float], width: float, travel: float) -> None:
        (u, v), r, h = middle, width / 2, travel / 2
        loop("THROUGH", [(u - h, v - r, 0), (u + h, v - r, 1), (u + h, v + r, 0), (u - h, v + r, 1)])

    rounded("OUTLINE", 0, 0, WIDE, HIGH, ROUND)
    rounded("POCKET_2", x - (FACE + TRAVEL) / 2, y - FACE / 2, x + (FACE + TRAVEL) / 2, y + FACE / 2, 4)
    slot((x, y), PILOT, TRAVEL)
    for i in (-1, 1):
        for j in (-1, 1):
            slot((x + i * PATTERN / 2, y + j * PATTERN / 2), SCREW, TRAVEL)
            space.add_circle((x + i * 42, y + j * 32), 2.5, dxfattribs={"layer": "M5"})
    for i in (-1, 1):
        space.add_circle((x + i * 42, y), 3, dxfattribs={"layer": "BORE_H7"})
    for stroke in ([(24, 72), (24, 76)], [(76, 72), (76, 76)], [(24, 74), (76, 74)]):
        space.add_lwpolyline(stroke, dxfattribs={"layer": "ENGRAVE_0.2"})
    return document


if __name__ == "__main__":
    drawing().saveas(Path(__file__).with_suffix(".dxf"))
