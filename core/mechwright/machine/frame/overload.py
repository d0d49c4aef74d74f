"""A torque that no coupling carries: how much one does, and the speed at which it would."""

import math

from mechwright.contracts.finding import Change, Finding, Stage
from mechwright.machine.frame.decided import Wanted
from mechwright.standards.couplings import OverloadError

LESS = 0.95
"""Of the speed at which torques of inertia alone would just be carried."""


def overloaded(error: OverloadError, wanted: Wanted) -> Finding:
    """The refusal, with a slower machine and one without a motor as what to try."""
    slower = float(f"{LESS * wanted.speed * math.sqrt(error.most / wanted.torque):.2g}")
    changes: tuple[Change, ...] = ({"machine.speed": slower}, {"machine.motor": "none"})
    return Finding.error(
        "frame.coupling",
        "machine.motor",
        f"the largest coupling for these shafts carries {error.most:g} N·m, and the input asks for "
        f"{wanted.torque:.3g} N·m with its margin",
        wanted.torque,
        error.most,
        "N*m",
        'run it slower, load it less, or set motor = "none" and drive the shaft by other means',
        Stage.PARTS,
        changes,
    )
