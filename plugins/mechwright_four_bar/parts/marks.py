"""The scales of the coupler's slots: angles of crank and follower from X in the pose of setting."""

import math
from collections.abc import Mapping

from mechwright import Colour, Engraving
from mechwright.mechanics.linkage.scale import scale
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.phases import clamp_of_design, pose_angles, settings_of

COLOURS: Mapping[str, Colour] = {
    "crank": (0.78, 0.36, 0.30),
    "coupler": (0.45, 0.58, 0.70),
    "follower": (0.80, 0.68, 0.42),
}


def scales(params: FourBarParams) -> Mapping[str, tuple[Engraving, ...]]:
    """Plate to its engravings; ``params`` shows its first phase."""
    clamp = clamp_of_design(params)
    if not params.phases or clamp is None:
        return {}
    found = []
    for (one, places), first, name in zip(
        settings_of(params), pose_angles(params), ("crank_turn", "follower_turn"), strict=True
    ):
        if one.slot is not None:
            turns = [0.0, *(float(getattr(row, name)) for row in params.phases)]
            angles = [math.remainder(first + turn, 360.0) for turn in turns]
            found.append(scale(f"scale-{one.name.lower()}", one.slot, places, angles, clamp.reach))
    return {"coupler": tuple(found)} if found else {}
