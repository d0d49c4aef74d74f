"""Which shafts of a mechanism turn in its frame, and what is fixed to what."""

from collections.abc import Mapping

import numpy as np

from mechwright.contracts.joint import GROUND, Joint
from mechwright.contracts.motion import Motion
from mechwright.contracts.mounting import MountingError
from mechwright.errors import DesignError

TURNS = 1e-9
"""Change of a rotation matrix from which a body turns."""


def fixed_to(body: str, joints: Mapping[str, Joint]) -> set[str]:
    """A body and all that moves as one with it."""
    found, added = {body}, True
    while added:
        added = False
        for one in joints.values():
            pair = {one.one, one.two}
            if one.kind == "fixed" and pair & found and not pair <= found:
                found |= pair
                added = True
    return found


def outputs_of(motion: Motion) -> list[str]:
    """Bodies that turn about an axis in the frame and are not driven, in the order of their joints."""
    frame = fixed_to(GROUND, motion.joints)
    return [
        one.two
        for one in motion.joints.values()
        if one.kind == "revolute"
        and one.one in frame
        and not one.drives
        and np.ptp(motion.poses[one.two].rotation, axis=0).max() > TURNS
    ]


def output_of(motion: Motion, wanted: str) -> str:
    """The body that carries the load; raises DesignError where none is, or which one is not said."""
    found = outputs_of(motion)
    if wanted:
        if wanted in found:
            return wanted
        known = f"those that do: {', '.join(found)}" if found else "none does"
        raise DesignError(f"machine.output: no body {wanted!r} turns in the frame undriven; {known}")
    if not found:
        raise DesignError(
            "machine.load: no body turns in the frame besides the driven one, and none has a torque to bear; "
            "leave load out"
        )
    if len(found) > 1:
        raise MountingError(
            f"machine.output: {', '.join(found)} turn in the frame; name the one that bears the load",
            tuple({"machine.output": one} for one in found),
        )
    return found[0]
