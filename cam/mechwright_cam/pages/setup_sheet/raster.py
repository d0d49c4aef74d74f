"""The simulated stock as a picture: a PNG inside an ``<svg>`` element."""

import base64
import math
import struct
import zlib

import numpy as np
from numpy.typing import NDArray

from mechwright.output import svg
from mechwright_cam.proof.simulation import Simulation, deviation
from mechwright_cam.setup.job import Job

PIXELS = 420
"""Larger side of the picture: an A4 column at 130 dots per inch."""
COLOURED = 0.1
"""Stock left on a floor, or cut into it, is coloured from here on, mm: a cell of the grid."""
UNCUT, TOP, BOTTOM, THROUGH = (222, 212, 190), (176, 198, 216), (62, 92, 122), (255, 255, 255)
LEFT_COLOUR, CUT_COLOUR = (240, 150, 30), (200, 0, 30)


def simulated_view(simulation: Simulation, job: Job) -> str:
    """The stock at last, darker the deeper, and what deviates from the part, as an ``<svg>`` element."""
    coarser = max(1, math.ceil(max(simulation.heights.shape) / PIXELS))
    depth = np.clip(-simulation.heights[::coarser, ::coarser] / job.thickness, 0.0, 1.0)
    share = depth[..., None]
    image = np.where(share > 0, (1 - share) * np.array(TOP) + share * np.array(BOTTOM), np.array(UNCUT))
    image[depth >= 1.0 - 1e-6] = THROUGH
    off = deviation(simulation, job, coarser)
    image[np.nan_to_num(off) > COLOURED] = LEFT_COLOUR
    image[np.nan_to_num(off) < -COLOURED] = CUT_COLOUR
    x0, y0, x1, y1 = job.stock
    href = "data:image/png;base64," + base64.b64encode(_png(image[::-1].astype(np.uint8))).decode()
    picture = svg.element("image", x=x0, y=-y1, width=x1 - x0, height=y1 - y0, href=href)
    return svg.picture(picture, (x0, -y1, x1 - x0, y1 - y0), "The simulated stock", font_family=None)


def _png(image: NDArray[np.uint8]) -> bytes:
    """Encode rows of red, green, blue (PNG specification, third edition)."""
    height, width, _ = image.shape
    rows = np.concatenate((np.zeros((height, 1), dtype=np.uint8), image.reshape(height, -1)), axis=1)

    def chunk(name: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", head)
        + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9))
        + chunk(b"IEND", b"")
    )
