"""Which links are made as flat strips."""

import math
from collections.abc import Iterator

from mechwright.tolerances import falls_short
from mechwright_spherical.kinematics.linkage import Linkage
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.flat import leg_of
from mechwright_spherical.parts.frame import ground_arcs
from mechwright_spherical.parts.places import link_arcs, second_size
from mechwright_spherical.parts.shells import Shells


def strip_legs(params: SphericalParams, linkage: Linkage, shells: Shells) -> Iterator[tuple[str, float]]:
    """The links that strips are made of, and the length, mm, of each between a bore and its nearest bend."""
    arcs = {**link_arcs(linkage), **ground_arcs(params), **second_size(linkage, shells)}
    arcs |= {f"coupler{phase.number}": math.acos(float(phase.loop.ca)) for phase in linkage.phases}
    for name, angle in arcs.items():
        link = "coupler" if name.startswith("coupler") else name
        yield name, leg_of(angle, shells.arc(link)[0], params.flat)


def makes_strips(params: SphericalParams, linkage: Linkage, shells: Shells) -> bool:
    """Whether links are made as flat strips: as the design says, or where all of them can be bent."""
    if params.flat.make is not None:
        return params.flat.make
    shortest = params.hardware.boss_diameter / 2
    return not any(falls_short(leg, shortest) for _, leg in strip_legs(params, linkage, shells))
