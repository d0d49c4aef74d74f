"""Draws the pictures of the first hour: from the commands on its page, and from the program that they write.

``python docs/first_hour.py``
"""

import contextlib
import re
import tempfile
from pathlib import Path

import numpy as np
import shapely
from gif import animation
from tour import cut_out

import mechwright as mw
from mechwright.testing import commands
from mechwright_cam.machining import Machined, Machining

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "first-hour.md"
IMAGES = ROOT / "docs" / "images"
PICTURES = {
    "first-hour-sheet.svg": "Plan view of nest",
    "first-hour-z.svg": "Heights of the job and the Z setter",
}
MOVING = "first-hour.gif"
PALETTE = ("#ffffff", "#bcd9e6", "#3b4a54", "#d9480f", "#1f6f8b", "#8a9ba8", "#c3d4de")
AIR, SHEET, CUT, MILL, WHEEL, DRIVER, OTHER = range(len(PALETTE))
SCALE = 1.6
"""Pixels in a millimetre."""
CUTTING, TURNING = 48, 36
"""Frames of the cut, and of a turn of the driver."""
HUNDREDTHS = 10


def shell_lines() -> list[list[str]]:
    """The commands on the page, without those for the gears: they take as long again."""
    lines = re.findall(r"^mechwright (.*)$", PAGE.read_text(encoding="utf-8"), flags=re.M)
    words = [re.findall(r'"([^"]*)"|(\S+)', line) for line in lines]
    return [[quoted or plain for quoted, plain in line] for line in words][:3]


def grid(left: float, low: float, right: float, high: float) -> tuple[np.ndarray, np.ndarray]:
    """X and Y of the pixels of a picture, mm; rows from above."""
    x = np.arange(left, right, 1 / SCALE)
    y = np.arange(high, low, -1 / SCALE)
    return np.meshgrid(x, y)


def cutting(program: Machined) -> list[np.ndarray]:
    """The sheet while it is cut, a frame after equal ways."""
    paths = program.scene.paths
    pieces = paths.below(0.0, steps=paths.steps)
    points, radius = dense(*paths.points(pieces, 0.05), paths.radius[pieces.step])
    x0, y0, x1, y1 = program.job.stock
    x, y = grid(x0 - 5, y0 - 5, x1 + 5, y1 + 5)
    picture = np.where((x >= x0) & (x <= x1) & (y >= y0) & (y <= y1), SHEET, AIR)
    way = np.append(0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T)))
    frames = []
    for share in np.linspace(0, 1, CUTTING + 1)[1:]:
        until = int(np.searchsorted(way, share * way[-1], side="right"))
        start = int(np.searchsorted(way, (share - 1 / CUTTING) * way[-1], side="left"))
        for one, size in zip(points[start:until], radius[start:until].tolist(), strict=True):
            stamp(picture, x, y, one, size, CUT)
        shown = picture.copy()
        stamp(shown, x, y, points[until - 1], 3.0, MILL)
        frames.append(shown)
    return frames


def dense(corners: np.ndarray, owner: np.ndarray, radius: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points (n, 2) a pixel apart along pieces of a path with corners (k, 2), and the mill's radius there."""
    way = np.where(np.diff(owner) == 0, np.hypot(*np.diff(corners, axis=0).T), 0.0)
    count = np.append(np.maximum(np.ceil(way * SCALE), 1).astype(int), 1)
    place = np.repeat(np.arange(len(corners)), count)
    share = (np.arange(len(place)) - np.repeat(np.cumsum(count) - count, count)) / count[place]
    after = corners[np.minimum(place + 1, len(corners) - 1)]
    return corners[place] + (after - corners[place]) * share[:, None], radius[owner[place]]


def stamp(
    picture: np.ndarray, x: np.ndarray, y: np.ndarray, at: np.ndarray, radius: float, what: int
) -> None:
    """A disc in a picture."""
    column, row = int((at[0] - x[0, 0]) * SCALE), int((y[0, 0] - at[1]) * SCALE)
    reach = int(radius * SCALE) + 2
    rows = slice(max(row - reach, 0), row + reach + 1)
    columns = slice(max(column - reach, 0), column + reach + 1)
    near = (x[rows, columns] - at[0]) ** 2 + (y[rows, columns] - at[1]) ** 2 <= radius**2
    picture[rows, columns][near] = what


def turning(mechanism: mw.Mechanism, shape: tuple[int, int]) -> list[np.ndarray]:
    """The mechanism in a turn of its driver, in pictures of as many pixels."""
    plates = [part for part in mechanism.parts if part.outline is not None]
    colours = {"wheel": WHEEL, "crank": DRIVER}
    poses = mechanism.motion.poses
    ways = {part.name: poses[part.instances[0].body] for part in plates}
    ends = np.vstack([way.position[:, :2] for way in ways.values()])
    middle = (ends.min(axis=0) + ends.max(axis=0)) / 2
    wide, high = shape[1] / SCALE, shape[0] / SCALE
    x, y = grid(middle[0] - wide / 2, middle[1] - high / 2, middle[0] + wide / 2, middle[1] + high / 2)
    x, y = x[: shape[0], : shape[1]], y[: shape[0], : shape[1]]
    frames = []
    samples = len(next(iter(ways.values())).position)
    for sample in np.linspace(0, samples - 1, TURNING, endpoint=False).astype(int):
        picture = np.full(x.shape, AIR)
        for part in plates:
            way = ways[part.name]
            turn, place = way.rotation[sample, :2, :2], way.position[sample, :2]
            local = np.stack((x - place[0], y - place[1]), axis=-1) @ turn
            inside = shapely.contains_xy(part.outline.polygon(), local[..., 0], local[..., 1])
            picture[inside] = colours.get(part.name, OTHER)
        frames.append(picture)
    return frames


def pictures() -> dict[str, bytes]:
    """File to content, from the commands of the page."""
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        for words in shell_lines():
            done = commands.run(*words)
            if done.returncode:
                raise RuntimeError(done.stderr)
        page = Path("wheel", "nest.setup.html").read_text(encoding="utf-8")
        mechanism = mw.load("wheel.toml")
        (program,) = mechanism.made(Machining).proven_programs
        first = cutting(program)
        frames = first + [first[-1]] * 5 + turning(mechanism, first[0].shape)
    drawn = {name: cut_out(page, label).encode() for name, label in PICTURES.items()}
    return {**drawn, MOVING: animation(frames, PALETTE, HUNDREDTHS)}


if __name__ == "__main__":
    for file, content in pictures().items():
        (IMAGES / file).write_bytes(content)
