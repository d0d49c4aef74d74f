"""A crude, independent simulation of engagement: a raster of stock that a disc takes away step by step."""

import itertools

import numpy as np

ANGLES = np.arange(-90, 90.1, 1.5)


def engagements(cavity, radius, bounds, cells=48):
    """Engagement, degrees, at every step of all passes of a cavity after its helix; (n,)."""
    x0, y0, x1, y1 = bounds
    cell = radius / cells
    xs, ys = (np.arange(a - 2 * cell, b + 2 * cell, cell) for a, b in ((x0, x1), (y0, y1)))
    stock = np.ones((len(xs), len(ys)), dtype=bool)

    def cut(point):
        spans = []
        for axis, value in ((xs, point[0]), (ys, point[1])):
            first = max(int((value - radius - axis[0]) / cell), 0)
            spans.append(slice(first, max(int((value + radius - axis[0]) / cell) + 2, first)))
        i, j = spans
        away = (xs[i, None] - point[0]) ** 2 + (ys[None, j] - point[1]) ** 2
        stock[i, j] &= away > radius**2

    for angle in np.linspace(0, 2 * np.pi, 240):
        cut(np.array(cavity.centre) + cavity.helix * np.array((np.cos(angle), np.sin(angle))))
    found = []
    for one in cavity.passes:
        points = one.path.points(radius / 10)
        for here, there in itertools.pairwise(points):
            step = there - here
            if step.any():
                ahead = np.arctan2(step[1], step[0]) + np.radians(ANGLES)
                edge = there + (radius - cell) * np.column_stack((np.cos(ahead), np.sin(ahead)))
                i = np.clip(np.rint((edge[:, 0] - xs[0]) / cell).astype(int), 0, len(xs) - 1)
                j = np.clip(np.rint((edge[:, 1] - ys[0]) / cell).astype(int), 0, len(ys) - 1)
                found.append(stock[i, j].sum() * 1.5)
                cut(there)
    return np.array(found)
