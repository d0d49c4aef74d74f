"""Whether the teeth of the gears bear what arm and rocker put on them."""

from collections.abc import Callable, Iterator

from mechwright import Finding, GeometryError, Stage, kept, of_stage
from mechwright.mechanics.strength.allowed import REVERSING_ROOT, ROOT_SAFETY, allowed
from mechwright.mechanics.strength.judging import Stress, Way, judged
from mechwright.mechanics.strength.tooth_bending import root_stress
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.peaks import Loads, loads_of, roughly_loaded
from mechwright_five_bar.train import train_of


@of_stage(Stage.PARTS)
def teeth_bear(params: FiveBarParams) -> Iterator[Finding]:
    """Bending at the roots of the teeth, over a period with load and inertia."""
    yield from _teeth(params, root_stresses, advise=True)


@of_stage(Stage.PARTS)
def teeth_judged(params: FiveBarParams) -> Iterator[Finding]:
    """The same without what would bear more, and with loads from fewer positions."""
    yield from _teeth(params, rough_stresses, advise=False)


def _teeth(
    params: FiveBarParams, stresses: Callable[[FiveBarParams], tuple[Stress, ...]], *, advise: bool
) -> Iterator[Finding]:
    ways = [Way("gear_thickness", params.gear_thickness), Way("speed", params.speed, up=False)]
    if params.module is not None:
        ways.insert(1, Way("module", params.module))
    yield from judged("five-bar.root", params, stresses, ways, advise=advise)


@kept
def root_stresses(params: FiveBarParams) -> tuple[Stress, ...]:
    """Of each gear at the wheel's greatest tooth force; one tooth carries alone, at its tip.

    What the idler's own inertia adds between it and the pinion is left out. Teeth of an idler are bent both
    ways in every turn, those of the others where the arm's torque changes its sign.
    """
    return _stresses(params, loads_of)


def rough_stresses(params: FiveBarParams) -> tuple[Stress, ...]:
    """The same from loads of fewer positions."""
    return _stresses(params, roughly_loaded)


def _stresses(params: FiveBarParams, loads_under: Callable[[FiveBarParams], Loads]) -> tuple[Stress, ...]:
    try:
        train = train_of(params)
    except GeometryError:
        return ()
    loads = loads_under(params)
    force = loads.peaks["tooth_force"].value
    bears = allowed(params.material).root
    found = []
    for name, teeth in train.teeth.items():
        value = float(root_stress(force, params.gear_thickness, train.module, float(teeth)))
        limit = bears * (REVERSING_ROOT if loads.reverses or name == "idler" else 1.0)
        what = f"teeth of the {name} are bent at their roots by {force:.4g} N with"
        found.append(Stress(what, value, limit, ROOT_SAFETY * bears))
    return tuple(found)
