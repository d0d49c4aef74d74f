"""Rules of the gears: whether they reach over the ground, stay apart, and have tips."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import GeometryError, Stage, refuse
from mechwright.contracts.design_rule import DesignRule, Failure, no_figures
from mechwright.contracts.design_table import column
from mechwright.contracts.finding import Change
from mechwright.contracts.procedure import Note
from mechwright.contracts.rule_list import Rules, in_turn
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright_five_bar.defaults.teeth import IN_LINE
from mechwright_five_bar.kinematics.train import Train, greatest_backlash, modules_of, train_of

_THOUSANDTHS = 1000
"""Of a millimetre: a module that is proposed is rounded so."""

Rule = DesignRule[AnyPlanarTable]
Fails = Failure[AnyPlanarTable]


def _train(m: AnyPlanarTable) -> Train:
    return train_of(m.params)


def _nearest(f: Fails) -> Iterator[Change]:
    """The module nearest to the one that is given with which the gears stand, and none."""
    least, most = modules_of(f.m.params)
    if f.m.params.module is None:
        return
    if least < most:
        up = f.m.params.module < least
        step = math.ceil(least * _THOUSANDTHS) if up else math.floor(most * _THOUSANDTHS)
        yield {"parameters.module": step / _THOUSANDTHS}
    yield {"parameters.module": None}


LEAST_MODULE = Rule(
    "five-bar.gears",
    "module",
    lambda f: f"gears of {f.value:g} mm do not reach over the ground of {f.m.params.ground:g} mm",
    value=lambda m: _train(m).module,
    limit=lambda m: modules_of(m.params)[0] * (1 - IN_LINE),
    remedy=lambda f: f"their module is at least {modules_of(f.m.params)[0]:.6g} mm",
    when=lambda m: bool(m.params.idler_teeth),
    reported=no_figures,
    proposed=_nearest,
)
MOST_MODULE = LEAST_MODULE.but(
    message="with {value:.6g} mm the gears of crank and arm meet, which turn the same way",
    limit=lambda m: modules_of(m.params)[1],
    remedy="it is at most {limit:.6g} mm, or give the idler more teeth",
    must_be="at most",
)
IN_A_LINE = LEAST_MODULE.but(
    message=lambda f: (
        f"without an idler the gears fill the ground of {f.m.params.ground:g} mm with a module of "
        f"{modules_of(f.m.params)[0]:g} mm, not {_train(f.m).module:g}"
    ),
    value=lambda m: np.abs(_train(m).module - modules_of(m.params)[0]),
    limit=lambda m: IN_LINE * m.params.ground,
    remedy="leave module out, or give an idler",
    must_be="at most",
    when=lambda m: not m.params.idler_teeth,
)


def _backlashes(m: AnyPlanarTable) -> Any:
    """The greatest ones (k,) or (n, k) of the gears."""
    found = [column(greatest_backlash(_train(m), name), m.size) for name in _train(m).teeth]
    return np.concatenate(found, axis=1)[0 if m.single else slice(None)]


TIPS = LEAST_MODULE.but(
    parameter="backlash",
    message=lambda f: (
        f"{f.m.params.backlash:g} mm take the tips of the {list(_train(f.m).teeth)[f.item]}'s teeth, of a "
        f"module of {_train(f.m).module:.4g} mm"
    ),
    value=lambda m: m.params.backlash + 0 * _backlashes(m),
    limit=_backlashes,
    remedy=lambda f: f"use at most {math.floor(1000 * f.limit) / 1000:g} mm",
    must_be="at most",
    when=None,
    each=False,
)


def _gears_message(m: AnyPlanarTable) -> str:
    train = _train(m)
    sizes = ", ".join(f"{name} {count}" for name, count in train.teeth.items())
    return (
        f"gears of module {train.module:.6g} mm with teeth {sizes}: the arm turns {m.params.ratio:g} times "
        "as far as the crank"
    )


GEARS: Rules[Any] = in_turn(IN_A_LINE, LEAST_MODULE, MOST_MODULE, TIPS)
"""What keeps the gears from being cut and put together, in order."""

GEARS_NOTE = Note[Any]("five-bar.gears", _gears_message, lambda m: _train(m).module, "mm")


def require_gears(m: AnyPlanarTable) -> None:
    """Raise GeometryError where the gears of a design cannot be."""
    refuse(GEARS.findings(m, quick=True), Stage.PARTS, GeometryError)
