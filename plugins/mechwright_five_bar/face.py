"""Width of the gears where a design leaves it out: it follows from what their teeth carry."""

import math

import numpy as np

from mechwright import MechwrightError
from mechwright.contracts.by_arrays import Designs
from mechwright.contracts.finding import errors
from mechwright.mechanics.strength.allowed import REVERSING_ROOT
from mechwright_five_bar.bounds import Bars, Gears, teeth_bear
from mechwright_five_bar.checks import sound
from mechwright_five_bar.hardware import turning_bore
from mechwright_five_bar.limits import USUAL_FACE
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.reach import bar_of, transmission_of, turns_fully
from mechwright_five_bar.strength_checks import root_stresses
from mechwright_five_bar.train import train_of

MOST_MODULES = 12.0
"""Face width, in modules, from which on a shaft that is a little askew loads one end of the teeth alone."""

SPARE = 1.02
"""Of the width: wider gears are heavier, and their inertia adds to the load."""

STEPS = 2
"""Of a millimetre: the width is rounded to halves."""


def face_of(params: FiveBarParams) -> float:
    """The usual face width, mm, or as much as teeth want that shall last.

    At most it is :data:`MOST_MODULES`. Where teeth break even so, and where something else speaks against the
    parts, it is the usual one.
    """
    usual = params.model_copy(update={"gear_thickness": USUAL_FACE})
    try:
        if _surely(usual) or errors(sound(usual)):
            return USUAL_FACE
        stresses, module = root_stresses(usual), train_of(usual).module
    except MechwrightError:
        return USUAL_FACE
    used = max(one.used for one in stresses)
    if used <= 1:
        return USUAL_FACE
    # A tooth's stress is to its width as one to it, and its load hardly changes with it.
    wanted = math.ceil(STEPS * SPARE * USUAL_FACE * used) / STEPS
    most = max(USUAL_FACE, math.floor(STEPS * MOST_MODULES * module) / STEPS)
    width = min(wanted, most)
    breaks = max(one.value / one.breaks for one in stresses if one.breaks is not None)
    return width if SPARE * USUAL_FACE * breaks <= width else USUAL_FACE


def _surely(params: FiveBarParams) -> bool:
    """Whether bounds of what teeth carry say that they last."""
    one = params.swing_from is None and params.setting_angle is None and not params.phases
    if not one or not turns_fully(bar_of(params)):
        return False
    designs, train = Designs(params, {"crank": np.array([params.crank])}), train_of(params)
    gears = Gears(np.array([train.module]), train.teeth, {})
    sine = np.sin(np.array([transmission_of(params)[0]]))
    omega = np.array([params.speed * math.tau / 60])
    bore = turning_bore(params)
    return bool(teeth_bear(designs, Bars.of(designs), gears, bore, sine, omega, REVERSING_ROOT).all())
