"""The scales of the coupler's slots: angles of crank and rocker from X in the pose of setting."""

import math
from collections.abc import Mapping

from mechwright import Engraving
from mechwright.mechanics.linkage.scale import scale
from mechwright_five_bar.kinematics.phases import pose_angles, settings_of
from mechwright_five_bar.parameters import FiveBarParams
from mechwright_five_bar.parts.hardware import clamp_of_design


def scales(params: FiveBarParams) -> Mapping[str, tuple[Engraving, ...]]:
    """Plate to its engravings; ``params`` shows its first phase."""
    clamp = clamp_of_design(params)
    if not params.phases or clamp is None:
        return {}
    found = []
    for (one, places), first, name in zip(
        settings_of(params), pose_angles(params), ("crank_turn", "rocker_turn"), strict=True
    ):
        if one.slot is not None:
            turns = [0.0, *(float(getattr(row, name)) for row in params.phases)]
            angles = [math.remainder(first + turn, 360.0) for turn in turns]
            found.append(scale(f"scale-{one.name.lower()}", one.slot, places, angles, clamp.reach))
    return {"coupler": tuple(found)} if found else {}
