"""Axial stacks of the shafts of a ground link with a motor's flange.

A link is bonded on its shaft flush with the shaft's lower end. Spacer, hub and ring follow outwards.
"""

from collections.abc import Iterator

from mechwright import AxialStack, Length, StackLength
from mechwright.contracts.general_tolerances import general_length
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.frame import shells_of
from mechwright_spherical.parts.mount import (
    FACE,
    LOADED,
    Hub,
    hubs_of,
    shaft_form,
    spacer_form,
    spacer_room,
)
from mechwright_spherical.parts.places import carried_by
from mechwright_spherical.parts.seats import plate_of

FLOAT = (0.1, 1.5)
"""Play of a shaft that is meant, mm: links that float a little find the centre in which their axes meet."""


def stacks_of(params: SphericalParams) -> Iterator[AxialStack]:
    """The float of each shaft between its link and its ring; none of a shaft that carries gears."""
    for name, hub in hubs_of(params).items():
        shaft = shaft_form(params, shells_of(params), name)
        if shaft.lengths and hub.ring is not None:
            lengths = tuple(_lengths(params, name, hub, shaft.length_of(LOADED)))
            yield AxialStack(f"float of shaft-{name}", lengths, *FLOAT, adjustable=LOADED)


def _lengths(params: SphericalParams, name: str, hub: Hub, loaded: Length) -> Iterator[StackLength]:
    ring, link = hub.ring, carried_by(params, name)
    yield StackLength.of(loaded, 1, f"shaft-{name}")
    if ring is not None:
        yield StackLength("circlip", -1, ring.thickness, -ring.thinner, 0.0, True, f"circlip-{name}")
    long = hub.span[1] - spacer_room(params, name)[1]
    yield StackLength(f"hub of {name}, both faces", -1, long, -2 * FACE, 2 * FACE, part="ground")
    plate = plate_of(params)
    yield StackLength(f"bosses of {link}, both faces", -1, plate, -2 * FACE, 2 * FACE, part=link)
    spacer = spacer_form(params, name)
    if spacer is not None:
        off = general_length(spacer.length, "medium")
        yield StackLength("spacer, ISO 2768-m", -1, spacer.length, -off, off, part=f"spacer-{name}")
