"""Random pockets in a plate as large as its stock: what has to go is the pocket and nothing else."""

import math

import numpy as np
from by_control import posted, prove

from mechwright.contracts.part import Part, Pocket
from mechwright.errors import MechwrightError
from mechwright.geometry import Arc, Line, Loop, Outline, circle
from mechwright_cam.planning import choose_tools, plan
from mechwright_cam.proof import Proof
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.settings import CamSettings

LIBRARY = load_library()
MILLS = ("mill-10", "mill-8", "mill-6", "mill-5", "mill-4", "mill-3", "mill-2")
WIDE, HIGH, THICK = 70.0, 50.0, 8.0


def rounded(points, radii):
    """A polygon whose corners have fillets, mm; a corner too short for its fillet stays sharp."""
    count = len(points)
    segments = []
    ends = []
    for i in range(count):
        p, a, b = points[i], points[i - 1], points[(i + 1) % count]
        u, v = (a - p) / np.hypot(*(a - p)), (b - p) / np.hypot(*(b - p))
        half = math.acos(np.clip(u @ v, -1, 1)) / 2
        reach = radii[i] / math.tan(half)
        if reach > 0.45 * min(np.hypot(*(a - p)), np.hypot(*(b - p))) or half > 1.5:
            ends.append((p, p, None))
            continue
        one, two = p + reach * u, p + reach * v
        centre = p + radii[i] / math.sin(half) * (u + v) / np.hypot(*(u + v))
        first = math.atan2(*(one - centre)[::-1])
        sweep = (math.atan2(*(two - centre)[::-1]) - first + math.pi) % math.tau - math.pi
        ends.append((one, two, Arc(tuple(centre), radii[i], first, sweep)))
    for i in range(count):
        one, two, arc = ends[i]
        after = ends[(i + 1) % count]
        start = two
        if arc is not None:
            segments.append(arc)
            start = arc.end
        end = after[2].start if after[2] is not None else tuple(after[0])
        segments.append(Line(tuple(float(c) for c in start), tuple(float(c) for c in end)))
    return Loop(tuple(segments))


def random_pocket(rng):
    """A star-shaped polygon with fillets, over the edge of the plate at times, with islands at times."""
    count = int(rng.integers(3, 9))
    angles = np.linspace(0, math.tau, count, endpoint=False) + rng.uniform(-0.25, 0.25, count)
    size = rng.uniform(6, 22)
    far = size * rng.uniform(0.55, 1.0, count)
    middle = np.array([rng.uniform(-WIDE / 2, WIDE / 2), rng.uniform(-HIGH / 2, HIGH / 2)]) * rng.uniform(
        0.2, 1.0
    )
    points = middle + np.column_stack((far * np.cos(angles), far * np.sin(angles)))
    boundary = rounded(points, rng.uniform(0.5, 5.0, count))
    islands = ()
    if size > 14 and rng.random() < 0.4:
        islands = (Loop((circle(tuple(middle), rng.uniform(0.8, 2.5)),)),)
    return Pocket("pocket", boundary, islands, 0.0, float(rng.uniform(0.5, 6.0)))


def case(seed: int, **changes: object) -> Proof | str:
    """The proof of one random pocket, or the reason why planning refuses it; changes go into its settings."""
    rng = np.random.default_rng(seed)
    x, y = WIDE / 2, HIGH / 2
    plate = Outline(Loop.polygon([(-x, -y), (x, -y), (x, y), (-x, y)]))
    part = Part("plate", plate, THICK, "aluminium", machined=(random_pocket(rng),))
    named = [] if rng.random() < 0.4 else sorted(rng.choice(MILLS, 2, replace=False).tolist())
    wanted = CamSettings.model_validate(
        {"stock": {"margin": 0}, "tools": named, "climb": bool(rng.integers(2)), **changes}
    )
    try:
        job = make_job(part, wanted, choose_tools(part, wanted, LIBRARY))
        program = plan(job)
    except MechwrightError as error:
        return str(error)
    return prove(posted(job, program), job)
