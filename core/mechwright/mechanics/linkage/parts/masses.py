"""Masses of the links from their real parts."""

from mechwright.mechanics.linkage import (
    BUSHING_MATERIAL,
    PIN_MATERIAL,
    Mass,
    cylinder_mass,
    plate_mass,
    together,
)
from mechwright.mechanics.linkage.parts.layout import Layout
from mechwright.mechanics.linkage.parts.parts import bushed, pin_span
from mechwright.mechanics.linkage.parts.retention import retention_of
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT
from mechwright.mechanics.planar.dynamics import GROUND


def masses_of(layout: Layout) -> dict[str, Mass]:
    """Mass of every moving link with what is pressed into it, in its own frame; kg, mm, kg mm².

    A roller block has the mass of its roller, which is 0 without bushings. Screws and washers of clamps are
    left out.
    """
    sizes = layout.sizes
    size = sizes.pin_diameter
    found: dict[str, list[Mass]] = {link: [] for link in (GROUND, *layout.linkage.machine.links)}
    for plate, outline in layout.outlines.items():
        own = plate_mass(outline, sizes.thickness_of(plate), sizes.material)
        found[layout.link(plate)].append(own)
    for pin in layout.pins:
        low, high = pin_span(layout, pin)
        bore = 0.0 if pin.clamp is None else pin.clamp.size.size
        found[pin.body].append(cylinder_mass(size, high - low, PIN_MATERIAL, pin.place, bore))
        if pin.head or pin.foot or pin.clamp is not None:
            head = cylinder_mass(HEAD * size, HEAD_HEIGHT * size, PIN_MATERIAL, pin.place, bore)
            found[pin.body].append(head)
    held = retention_of(layout)
    if held is not None:
        found[held.pin.body] += held.masses()
    for one in bushed(layout):
        length, bore = one.length(layout), size + sizes.running_fit
        found[one.link].append(cylinder_mass(sizes.roller, length, BUSHING_MATERIAL, one.place, bore))
    return {link: together(some) for link, some in found.items() if link != GROUND}
