"""Whether the teeth of the gears bear what arm and rocker put on them."""

from collections.abc import Iterator

from mechwright import Finding, GeometryError, Stage, kept, of_stage
from mechwright.mechanics.strength.allowed import REVERSING_ROOT, ROOT_SAFETY, allowed
from mechwright.mechanics.strength.judging import Stress, Way, judged
from mechwright.mechanics.strength.tooth_bending import root_stress
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.peaks import loads_of
from mechwright_five_bar.train import train_of


@of_stage(Stage.PARTS)
def teeth_bear(params: FiveBarParams) -> Iterator[Finding]:
    """Bending at the roots of the teeth, over a period with load and inertia."""
    yield from _teeth(params, advise=True)


@of_stage(Stage.PARTS)
def teeth_judged(params: FiveBarParams) -> Iterator[Finding]:
    """The same without what would bear more."""
    yield from _teeth(params, advise=False)


def _teeth(params: FiveBarParams, *, advise: bool) -> Iterator[Finding]:
    ways = [Way("gear_thickness", params.gear_thickness), Way("speed", params.speed, up=False)]
    if params.module is not None:
        ways.insert(1, Way("module", params.module))
    yield from judged("five-bar.root", params, root_stresses, ways, advise=advise)


@kept
def root_stresses(params: FiveBarParams) -> tuple[Stress, ...]:
    """Of each gear at the wheel's greatest tooth force; one tooth carries alone, at its tip.

    What the idler's own inertia adds between it and the pinion is left out. Teeth of an idler are bent both
    ways in every turn, those of the others where the arm's torque changes its sign.
    """
    try:
        train = train_of(params)
    except GeometryError:
        return ()
    loads = loads_of(params)
    force = loads.peaks["tooth_force"].value
    bears = allowed(params.material).root
    found = []
    for name, teeth in train.teeth.items():
        value = float(root_stress(force, params.gear_thickness, train.module, float(teeth)))
        limit = bears * (REVERSING_ROOT if loads.reverses or name == "idler" else 1.0)
        what = f"teeth of the {name} are bent at their roots by {force:.4g} N with"
        found.append(Stress(what, value, limit, ROOT_SAFETY * bears))
    return tuple(found)
