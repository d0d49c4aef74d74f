"""Which links are made as flat strips."""

import math
from collections.abc import Iterator

from mechwright import Finding
from mechwright.tolerances import falls_short
from mechwright_spherical.kinematics.linkage import Linkage
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.flat import strip
from mechwright_spherical.parts.frame import ground_arcs
from mechwright_spherical.parts.places import link_arcs, second_size
from mechwright_spherical.parts.shells import Shells


def strip_findings(params: SphericalParams, linkage: Linkage, shells: Shells) -> Iterator[Finding]:
    """Errors where strips that are asked for cannot be bent; a note where they are left out for that."""
    flat, shortest = params.flat, params.hardware.boss_diameter / 2
    if flat.make is False:
        return
    for name, leg in strip_legs(params, linkage, shells):
        if not falls_short(leg, shortest):
            continue
        link = "coupler" if name.startswith("coupler") else name
        said = (
            f"the strip of the {link} has {leg:.4g} mm between bore and bend, and its round end takes "
            f"{shortest:g} mm"
        )
        if flat.make is None:
            yield Finding.note(
                "spherical.strip",
                f"links are not made as flat strips: {said}; a smaller flat.bend_radius would leave more",
                leg,
                "mm",
            )
            return
        yield Finding.error(
            "spherical.strip",
            "flat.bend_radius",
            said,
            leg,
            shortest,
            "mm",
            "use a smaller flat.bend_radius, smaller bosses or a larger radius, or leave flat.make out",
            proposed=({"parameters.flat.make": None},),
        )


def strip_legs(params: SphericalParams, linkage: Linkage, shells: Shells) -> Iterator[tuple[str, float]]:
    """The links that strips are made of, and the length, mm, of each between a bore and its nearest bend."""
    arcs = {**link_arcs(linkage), **ground_arcs(params), **second_size(linkage, shells)}
    arcs |= {f"coupler{phase.number}": math.acos(float(phase.loop.ca)) for phase in linkage.phases}
    for name, angle in arcs.items():
        link = "coupler" if name.startswith("coupler") else name
        yield name, strip(angle, shells.arc(link)[0], params.flat).leg


def makes_strips(params: SphericalParams, linkage: Linkage, shells: Shells) -> bool:
    """Whether links are made as flat strips: as the design says, or where all of them can be bent."""
    if params.flat.make is not None:
        return params.flat.make
    shortest = params.hardware.boss_diameter / 2
    return not any(falls_short(leg, shortest) for _, leg in strip_legs(params, linkage, shells))
