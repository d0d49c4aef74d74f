"""A second opinion on an order of assembly: each step is done again with meshes, from outside to the seat.

Bodies go along their way in small steps, and must stand in nothing that is there already. It shares no code
with how the order was found, which asks shadows.
"""

from collections.abc import Sequence

import numpy as np
from manifold3d import Manifold

from mechwright.contracts.holes import joined
from mechwright_cad.assembly_order.levels import Step
from mechwright_cad.bodies import Body
from mechwright_cad.interference.surface import surface_of

PLACES = 14
"""Places along a way at which a body is looked at; the last is just before its seat."""

LEAST = 0.1
"""Overlap that is one, mm3: facets of a fit without clearance have less."""


def met(steps: Sequence[Step], bodies: Sequence[Body], sample: int) -> list[str]:
    """What meets on its way, step by step, in words; empty if the order can be followed."""
    whole, cores = zip(*(_solids(body, sample) for body in bodies), strict=True)
    found = []
    for number, step in enumerate(steps, start=1):
        if step.way is None:
            found.append(f"step {number} has no way")
            continue
        out = -np.array(step.way)
        for one in step.moved:
            for two in step.onto:
                if _meets(cores[one], whole[two], out):
                    found.append(f"step {number}: {bodies[one].name} meets {bodies[two].name}")
    return found


def _meets(core: Manifold, other: Manifold, out: np.ndarray) -> bool:
    mine, theirs = _along(core, out), _along(other, out)
    far = theirs[1] - mine[0]
    if far <= 0:
        return False
    for share in np.linspace(0.0, 1.0, PLACES) ** 2:
        moved = core.translate((share * far * out).tolist())
        if (moved ^ other).volume() > LEAST:
            return True
    return False


def _along(solid: Manifold, way: np.ndarray) -> tuple[float, float]:
    along = np.asarray(solid.to_mesh64().vert_properties)[:, :3] @ way
    return float(along.min()), float(along.max())


def _solids(body: Body, sample: int) -> tuple[Manifold, Manifold]:
    """A body where it stands, and the same without its skin; a circlip's core is spread to its shaft."""
    surface = surface_of(joined(body.part), body.instance)
    place = np.column_stack((body.poses.rotation[sample], body.poses.position[sample]))
    core, bought = surface.core.manifold, body.part.bought
    if bought is not None and bought.standard == "DIN 471":
        shaft = float(bought.designation.split(" - ")[1].split(" x ")[0]) / 2
        core -= Manifold.cylinder(1000.0, shaft, circular_segments=360, center=True)
    return surface.manifold.transform(place), core.transform(place)
