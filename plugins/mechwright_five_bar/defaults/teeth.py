"""Numbers of teeth, and sizes of the joints, where a design leaves them out."""

import math
from collections.abc import Callable, Container, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.mechanics.linkage.usual import Fits, JointSizes
from mechwright.tolerances import falls_short
from mechwright_five_bar.defaults.limits import LEAST_TEETH, MOST_TEETH

USUAL = JointSizes(8.0, 4.0, 1.0, 12.0)
"""mm: the defaults of the table."""

ADDENDUM, DEDENDUM = 1.0, 1.25
"""Height of the teeth over the pitch circle, and depth below it, in modules: ISO 53, profile A."""

IN_LINE = 1e-9
"""Share of the ground by which a train may miss it: rounding of the module."""

_DIGITS = 9
"""Of a number of teeth: beyond these is the rounding of a division."""

APART = 1.0
"""Modules between the tips of the gears of crank and arm that turn the same way."""

USUAL_TEETH = {"crank_teeth": 20, "idler_teeth": 20, "arm_teeth": 40}
"""The defaults of the table."""

TEETH = tuple(USUAL_TEETH)

Table = Callable[[str], Any]
"""Parameters by their names."""


def modules(ground: float, crank: int, idler: int, arm: int) -> tuple[float, float]:
    """Between which modules, mm, gears of so many teeth reach over the ground, and stand clear of each other.

    At the least one all stand in line. Without an idler both are the same.
    """
    least = 2 * ground / (crank + 2 * idler + arm)
    if not idler:
        return least, least
    return least, ground / ((crank + arm) / 2 + 2 * ADDENDUM + APART)


def teeth_left_out(table: Table, given: Container[str]) -> dict[str, Any]:
    """The usual numbers of teeth, or with a module those with which the gears reach over the ground.

    Where crank and arm both leave theirs out the arm keeps its usual speed. Gears stay as large as they are
    without a module where that can be; where no numbers do, they are as near to it as teeth can be cut.
    Designs (n, 1) that differ in module or ground have columns of them.

    Examples
    --------
    >>> teeth_left_out({"module": 1.0, "ground": 105.0}.__getitem__, ())
    {'crank_teeth': 42, 'idler_teeth': 42, 'arm_teeth': 84}
    """
    module, ground = np.asarray(table("module")), np.asarray(table("ground"))
    if module.dtype != object and (module.ndim or ground.ndim):
        return _of_each(table, given, *np.broadcast_arrays(module, ground))
    now = {name: table(name) if name in given else usual for name, usual in USUAL_TEETH.items()}
    if table("module") is not None and not _reach(table, now):
        trains = sorted(_trains(table, now, given), key=lambda one: _unlike(table, one))
        now = next((one for one in trains if _reach(table, one)), trains[0])
    return {name: count for name, count in now.items() if name not in given}


def _of_each(
    table: Table, given: Container[str], module: NDArray[Any], ground: NDArray[Any]
) -> dict[str, Any]:
    """The same of designs one after the other."""

    def one_of(own: Mapping[str, float]) -> Mapping[str, int]:
        return teeth_left_out(lambda name: own[name] if name in own else table(name), given)

    pairs = zip(module.ravel().tolist(), ground.ravel().tolist(), strict=True)
    found = [one_of({"module": one, "ground": two}) for one, two in pairs]
    return {name: np.array([[one[name]] for one in found]) for name in found[0]}


def _reach(table: Table, teeth: Mapping[str, int]) -> bool:
    """Whether gears of the module that is given do."""
    module, ground = table("module"), table("ground")
    least, most = modules(ground, *(teeth[name] for name in TEETH))
    slack = IN_LINE * (least if teeth["idler_teeth"] else ground)
    return bool(least - slack <= module <= most + (0 if teeth["idler_teeth"] else slack))


def _unlike(table: Table, teeth: Mapping[str, int]) -> tuple[float, float]:
    """By how much the gears of crank and idler are other than in line and without a module, in teeth."""
    share = modules(table("ground"), *USUAL_TEETH.values())[0] / table("module")
    crank, idler = (abs(teeth[name] - share * USUAL_TEETH[name]) for name in ("crank_teeth", "idler_teeth"))
    return crank, idler


def _trains(table: Table, now: Mapping[str, int], given: Container[str]) -> Iterator[dict[str, int]]:
    """Numbers of teeth that may do: idlers only just reach."""
    total = 2 * table("ground") / table("module")
    pairs = [(now["crank_teeth"], now["arm_teeth"])]
    if "crank_teeth" not in given and "arm_teeth" not in given:
        ratio = USUAL_TEETH["arm_teeth"] // USUAL_TEETH["crank_teeth"]
        pairs = [(count, ratio * count) for count in range(LEAST_TEETH, MOST_TEETH // ratio + 1)]
    elif "arm_teeth" not in given and not now["idler_teeth"]:
        pairs = [(now["crank_teeth"], _cut(total - now["crank_teeth"]))]
    elif "crank_teeth" not in given and not now["idler_teeth"]:
        pairs = [(_cut(total - now["arm_teeth"]), now["arm_teeth"])]
    for crank, arm in pairs:
        least = _cut(math.ceil(round((total - crank - arm) / 2, _DIGITS)))
        idler = now["idler_teeth"] if "idler_teeth" in given else least
        yield {"crank_teeth": crank, "idler_teeth": idler, "arm_teeth": arm}


def _cut(teeth: float) -> int:
    """The nearest number of teeth that can be cut."""
    return min(max(round(teeth), LEAST_TEETH), MOST_TEETH)


def fits(table: Table) -> Fits:
    """Whether sizes leave a rim about the bores of links and gears, of parameters by their names."""

    def answer(one: JointSizes) -> Any:
        pin, rim, wall = one.pin_diameter, one.rim, np.asarray(one.bushing_wall)
        turning = pin + np.where(wall > 0, 2 * wall, table("running_fit"))
        short: Any = falls_short(table("crank"), pin + rim) | falls_short(table("arm"), pin + rim)
        short = short | falls_short(table("rocker"), (turning + pin) / 2 + rim)
        short = short | falls_short(table("coupler"), turning + rim)
        for along in (table("coupler_point_x"), table("coupler_point_x") - table("coupler")):
            short = short | falls_short(np.hypot(along, table("coupler_point_y")), (turning + pin) / 2 + rim)
        crank, idler, arm = (np.asarray(table(name)) for name in TEETH)
        module = table("module")
        if module is None:
            module = 2 * table("ground") / (crank + 2 * idler + arm)
        for teeth, bore in ((crank, pin), (idler, turning), (arm, pin)):
            wanting = falls_short(module * (teeth / 2 - DEDENDUM), bore / 2 + rim)
            short = short | wanting & (teeth > 0)
        return ~np.asarray(short)

    return answer
