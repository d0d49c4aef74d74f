"""Width of the gears where a design leaves it out: it follows from what their teeth carry."""

from mechwright import MechwrightError
from mechwright.contracts.finding import errors
from mechwright.mechanics.strength.allowed import REVERSING_ROOT
from mechwright.standards.stock import plate_or_block, plate_within
from mechwright_five_bar.defaults.limits import USUAL_FACE
from mechwright_five_bar.parameters import FiveBarParams
from mechwright_five_bar.rules.motion import RUNS
from mechwright_five_bar.rules.rule_table import SHAPES
from mechwright_five_bar.rules.strength import bears_at_most, root_stresses
from mechwright_five_bar.table import FiveBarTable

MOST_MODULES = 12.0
"""Face width, in modules, from which on a shaft that is a little askew loads one end of the teeth alone."""

SPARE = 1.02
"""Of the width: wider gears are heavier, and their inertia adds to the load."""


def face_of(params: FiveBarParams) -> float:
    """The usual face width, mm, or as much as teeth want that shall last.

    It is that of a plate that is sold, at most :data:`MOST_MODULES`. Where teeth break even so, and where
    something else speaks against the parts, it is the usual one.
    """
    usual = params.model_copy()
    usual.__dict__.update({"gear_thickness": USUAL_FACE, "phase": 1})  # it still counts as left out
    m = FiveBarTable.of(usual)
    try:
        if errors(RUNS.findings(m, quick=True)) or bears_at_most(m, REVERSING_ROOT):
            return USUAL_FACE
        if errors(SHAPES.findings(m, quick=True)):
            return USUAL_FACE
        stresses, module = root_stresses(m), m.train.module
    except MechwrightError:
        return USUAL_FACE
    used = max(one.used for one in stresses)
    if used <= 1:
        return USUAL_FACE
    # A tooth's stress is to its width as one to it, and its load hardly changes with it.
    most = max(USUAL_FACE, plate_within(MOST_MODULES * module, params.material) or 0.0)
    wanted = min(SPARE * USUAL_FACE * used, most)
    width = plate_or_block(wanted, params.material)
    breaks = max(one.value / one.breaks for one in stresses if one.breaks is not None)
    return width if SPARE * USUAL_FACE * breaks <= width else USUAL_FACE
