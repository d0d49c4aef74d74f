"""Plates that round-ended mills are tried on."""

import math

import numpy as np
from by_control import posted, prove
from height_map import Simulation, cutters, read
from random_pockets import rounded

from mechwright.contracts.part import Bore, Feature, Part, Pocket, Profile
from mechwright.geometry import Arc, Line, Loop, Outline, circle
from mechwright_cam.planning import choose_tools
from mechwright_cam.proof import Proof
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.library import Library, load_library
from mechwright_cam.shop.settings import CamSettings

LIBRARY = load_library()
WIDE, HIGH, THICK = 50.0, 36.0, 8.0
PLATE = Loop.polygon(
    [(-WIDE / 2, -HIGH / 2), (WIDE / 2, -HIGH / 2), (WIDE / 2, HIGH / 2), (-WIDE / 2, HIGH / 2)]
)


def box(x: float, y: float, corner: float) -> Loop:
    return rounded(np.array([(-x, -y), (x, -y), (x, y), (-x, y)]), [corner] * 4)


def stadium(half: float, radius: float) -> Loop:
    right, left = (half, 0.0), (-half, 0.0)
    return Loop(
        (
            Line((-half, -radius), (half, -radius)),
            Arc(right, radius, -math.pi / 2, math.pi),
            Line((half, radius), (-half, radius)),
            Arc(left, radius, math.pi / 2, math.pi),
        )
    )


def laid(*features: Feature, tools: tuple[str, ...] = (), library: Library = LIBRARY, **cam: object) -> Job:
    """A plate; as large as its stock if nothing is cut around it."""
    holes = [f for f in features if isinstance(f, Bore) and f.top == 0 and f.depth == THICK]
    inner = tuple(Loop((circle(hole.centre, hole.diameter / 2),)).reversed() for hole in holes)
    part = Part("plate", Outline(PLATE, inner), THICK, "aluminium", machined=features)
    if not any(isinstance(feature, Profile) for feature in features):
        cam = {"stock": {"margin": 0}, **cam}
    strong = {"spindle_power": 11, "spindle_torque": 60}  # plain plans are not slowed to what a spindle has
    wanted = CamSettings.model_validate({"tools": tools, "machine": strong, **cam})
    return make_job(part, wanted, choose_tools(part, wanted, library))


def made(job: Job) -> tuple[str, Proof]:
    text = posted(job)
    return text, prove(text, job)


def cut(text: str, job: Job, pitch: float = 0.2) -> Simulation:
    simulation = Simulation(job.stock, job.thickness, pitch)
    simulation.run(read(text), cutters(job))
    assert simulation.complaints == []
    return simulation


def failed(proof: Proof) -> list[str]:
    return [check.name for check in proof.checks.values() if not check.passed]


def operations(text: str) -> list[str]:
    return [line[12:-1] for line in text.splitlines() if line.startswith("(operation: ")]


POCKET = Pocket("pocket", box(14, 9, 4), (), 0.0, 4.0)
OUTSIDE = Profile("outside", PLATE, "outside", 0.0, THICK)
