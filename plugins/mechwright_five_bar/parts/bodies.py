"""Masses of the moving bodies from their real parts."""

from collections.abc import Mapping

import numpy as np

from mechwright import Part
from mechwright.mechanics.linkage import Mass, cylinder_mass, plate_mass, together
from mechwright_five_bar.parts.frames import fixed_frames
from mechwright_five_bar.parts.hub import wheel_angles
from mechwright_five_bar.parts.parts import parts_of
from mechwright_five_bar.table import FiveBarTable

MOVING = ("crank", "coupler", "rocker", "arm", "idler")


def masses_of(m: FiveBarTable) -> Mapping[str, Mass]:
    """Mass of each moving body with what is fixed to it, in its own frame, wheel and clamp on the arm.

    Screws and washers are left out.
    """
    return m.unloaded.once("masses", lambda: _masses(m.unloaded))


def _masses(m: FiveBarTable) -> Mapping[str, Mass]:
    found: dict[str, list[Mass | None]] = {name: [] for name in MOVING}
    places = fixed_frames(m)
    turn = complex(np.exp(1j * wheel_angles(m.params)[0]))
    for part in parts_of(m):
        for instance in part.instances:
            body, place = places.get(instance.body, (instance.body, 0j))
            if body == "wheel":
                body, place = "arm", place * turn
            if body in found:
                found[body].append(_of(part, place))
    return {name: together(one for one in each if one is not None) for name, each in found.items() if each}


def _of(part: Part, place: complex) -> Mass | None:
    if part.outline is not None:
        return plate_mass(part.outline, part.thickness, part.material)
    if part.turned is None:
        return None
    bore, steps = part.turned.bore, part.turned.steps
    return together(cylinder_mass(one.diameter, one.length, part.material, place, bore) for one in steps)
