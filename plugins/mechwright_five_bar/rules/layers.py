"""Rules of the layers: whether the plates can be stacked so that they keep off each other.

With crank and arm in one layer, the rocker above them and the coupler on top, all is apart if

* crank and arm, seen as discs about their shafts, do not reach each other;
* pin A stays clear of the rocker, and the head of pin B1 of the coupler: with μ the transmission angle, A is
  c sin μ off the line from B1 to C, and B1 is l sin μ off the line from A to C.

Between two samples of the motion a plate moves on; half of that is added, as where it is measured.
"""

import math
from collections.abc import Iterator
from itertools import permutations
from typing import Any

import numpy as np

from mechwright import Finding, GeometryError, Stage
from mechwright.contracts.finding import at_stage
from mechwright.contracts.procedure import Note, Procedure
from mechwright.contracts.rule_list import all_of
from mechwright.mechanics.gearing.usual import chosen
from mechwright.mechanics.linkage.stacking import STACK_SAMPLES
from mechwright.mechanics.linkage.turned import HEAD
from mechwright.mechanics.linkage.usual import told
from mechwright_five_bar.defaults.limits import USUAL_FACE
from mechwright_five_bar.defaults.teeth import USUAL, USUAL_TEETH
from mechwright_five_bar.parameters import FiveBarParams
from mechwright_five_bar.table import FiveBarTable

APART = 0.2
"""mm. What is called clear in plan besides the clearance: chords of the outlines that are compared."""

BEND = 1.1
"""A path between two samples over its chord, at most; as where plates are compared."""

STEP = math.tau / (STACK_SAMPLES - 1)
"""Turn of the crank between two samples, rad, at most."""


def layers_are_sure(m: FiveBarTable) -> Any:
    """Whether bounds say that the plates stand apart in the flattest order: a truth value or a column."""
    return (
        m.once("layers are sure", lambda: _links_are_apart(m) & _gears_are_apart(m))
        if not m.params.phases
        else False
    )


def _links_are_apart(m: FiveBarTable) -> Any:
    params, bar, ratio = m.params, m.bar, abs(m.bar.ratio)
    half, limit = m.bore / 2 + params.rim, params.clearance + APART
    sine = np.sin(m.transmission[0])
    turned = (bar.crank + ratio * bar.arm) / sine  # of coupler and rocker with the crank, times their lengths
    spread = np.maximum(bar.coupler, np.abs(params.coupler_point)) + half
    crank, arm = bar.crank + half, ratio * (bar.arm + half)
    rocker = ratio * bar.arm + turned / bar.rocker * (bar.rocker + half)
    coupler = bar.crank + turned / bar.coupler * spread
    beside = np.maximum(-np.sign(bar.branch) * params.coupler_point_y, 0.0)
    pin, head = params.pin_diameter / 2, HEAD * params.pin_diameter / 2
    return (
        (bar.ground - bar.crank - bar.arm - 2 * half > limit + _slack(crank + arm))
        & (bar.coupler * sine - half > limit + pin + _slack(rocker + bar.crank))
        & (bar.rocker * sine - half - beside > limit + head + _slack(coupler + ratio * bar.arm))
    )


def _gears_are_apart(m: FiveBarTable) -> Any:
    """Whether gears leave walls about their bores, and clear the shafts of others."""
    params, train = m.params, m.train
    limit, pin = params.clearance + APART, params.pin_diameter / 2
    sure = np.asarray(True)
    for name in train.places:
        sure = sure & (train.root(name) - m.bore / 2 >= params.rim)
    for name, other in permutations(train.places, 2):
        away = np.abs(train.places[name] - train.places[other])
        sure = sure & (away - train.tip(name) > limit + pin + _slack(train.tip(name)))
        sure = sure & (away >= m.bore + params.rim)
    if "idler" in train.places:
        tips = train.tip("pinion") + train.tip("wheel")
        sure = sure & (params.ground - tips > limit + _slack(tips))
    return sure


def _slack(moved: Any) -> Any:
    return BEND * STEP * moved / 2


def _order(m: FiveBarTable) -> Iterator[Finding]:
    try:
        m.layout  # noqa: B018 - it raises
    except GeometryError as error:
        remedy = (
            "make crank and arm shorter than the ground, pins, rims or webs smaller, or the swing shorter"
        )
        yield _named(error, remedy)


def _named(error: GeometryError, remedy: str) -> Finding:
    """An error whose message begins with the parameter that it is about, and may end in what to do."""
    parameter, _, said = str(error).partition(": ")
    if parameter not in FiveBarParams.model_fields:
        parameter, said = "crank", str(error)
    message, _, own = said.partition("; ")
    return Finding.error("five-bar.layers", parameter, message, remedy=own or remedy, stage=Stage.PARTS)


def _defaults(m: FiveBarTable) -> Iterator[Finding]:
    """Sizes that the design leaves out and that are not the default ones."""
    yield from told("five-bar.sizes", USUAL, m.params)
    yield from chosen("five-bar.chosen", m.params, {**USUAL_TEETH, "gear_thickness": USUAL_FACE})


def _height(m: FiveBarTable) -> float:
    return max(high for _, high in m.layout.stack.spans.values())


def _stack_message(m: FiveBarTable) -> str:
    stack = m.layout.stack
    order = sorted(stack.layer.items(), key=lambda item: (item[1], item[0]))
    return f"{len(stack.layers)} layers, {_height(m):.4g} mm high: " + ", ".join(
        f"{name} in {number}" for name, number in order
    )


LAYERS = Procedure[FiveBarTable](("five-bar.layers",), _order, when=lambda m: ~np.asarray(layers_are_sure(m)))
LAYERS_NOTES = all_of(
    Procedure[FiveBarTable](
        ("five-bar.sizes", "five-bar.chosen"), lambda m: at_stage(Stage.PARTS, _defaults(m)), slow=True
    ),
    Note[FiveBarTable]("five-bar.stack", _stack_message, _height, "mm"),
)
