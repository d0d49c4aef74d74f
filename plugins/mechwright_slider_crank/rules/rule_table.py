"""The rules of a slider-crank in their order; strength, and the figures worth knowing."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from mechwright import Severity, Stage
from mechwright.contracts.procedure import Note
from mechwright.contracts.rule_list import Rules, all_of, in_turn
from mechwright.mechanics.strength.judging import RowStressRule, Stress, Way
from mechwright.mechanics.strength.turning_pair import (
    TurningPair,
    bush_stresses,
    eye_stresses,
    pin_stresses,
)
from mechwright_slider_crank.kinematics.course import ends_of, least_of
from mechwright_slider_crank.kinematics.forces import balance
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.parts.masses import bodies_of
from mechwright_slider_crank.parts.plates import layout_of
from mechwright_slider_crank.rules.loads import bears, carried, pairs_of
from mechwright_slider_crank.rules.motion_rules import MOTION, TURNING
from mechwright_slider_crank.rules.part_rules import PARTS
from mechwright_slider_crank.table import SliderCrankTable

Stresses = Callable[[tuple[TurningPair, ...]], list[Stress]]


def _load(m: Mechanism) -> str:
    most = max(pairs_of(m), key=lambda pair: pair.greatest)
    return f"{most.greatest:.4g} N at the {most.name.removeprefix('the ')}"


def _rule(
    code: str, stresses: Stresses, helps: Sequence[str], *, breaks: bool = False
) -> RowStressRule[Mechanism]:
    def ways(m: Any) -> list[Way]:
        more = [Way(key, getattr(m.dimensions if key != "thickness" else m.given, key)) for key in helps]
        return [*more, Way("load", m.given.load, up=False), Way("speed", m.given.speed, up=False)]

    return RowStressRule[Mechanism](
        code,
        lambda m: stresses(pairs_of(m)),
        ways,
        SliderCrankTable.of,
        _load,
        breaks=breaks,
        bears=bears,
    )


STRENGTH = all_of(
    _rule("slider-crank.pin", pin_stresses, ["pin"]),
    _rule("slider-crank.eye", eye_stresses, ["wall", "thickness"], breaks=True),
    _rule("slider-crank.bushing", bush_stresses, ["thickness"]),
)
"""Pins, the plates beside their bores, and bushings."""


def _stroke_message(m: Mechanism) -> str:
    ends = ends_of(m)
    sense = "away from the crank" if ends.slow_outward != m.given.clockwise else "towards the crank"
    return (
        f"stroke {ends.stroke:.6g} mm, time ratio {ends.time_ratio:.6g}"
        + (f", slower {sense}" if ends.time_ratio > 1 + 1e-9 else "")
        + f"; limits at crank angles {math.degrees(ends.far):.4f}° and {math.degrees(ends.near):.4f}°; least "
        f"transmission angle {math.degrees(least_of(m)):.4f}°"
    )


def _stack_message(m: Mechanism) -> str:
    layout = layout_of(m)
    layer, layers = layout.stack.layer, layout.stack.layers
    names = sorted(layer, key=lambda name: (layer[name], name))
    order = [
        " and ".join(name for name in names if layer[name] == number and name != "rail-2")
        for number in range(len(layers))
    ]
    words, top = ", ".join(order).replace("rail-1", "rails"), layers[-1]
    return f"layers from below: {words}; {top.bottom + top.thickness:.4g} mm high" + (
        "" if layout.heads else "; the pins end flush, secure the rod with rings or adhesive"
    )


def _torque(m: Mechanism) -> float:
    return float(np.abs(carried(m)[1].drive).max()) / 1e3


def _forces_message(m: Mechanism) -> str:
    found = carried(m)[1]
    joints = {name: np.abs(found.joints[name]).max() for name in ("crank-pin", "wrist-pin", "guide")}
    return (
        f"torque up to {_torque(m):.4g} N m, "
        + ", ".join(f"{name.replace('-', ' ')} {peak:.4g} N" for name, peak in joints.items())
        + f", shaking force {np.abs(found.shaking).max():.4g} N"
    )


def _on_crank(m: Mechanism) -> float:
    return float(abs(balance(m.given.crank, m.given.rod, bodies_of(m)).crank))


def _balance_message(m: Mechanism) -> str:
    masses = bodies_of(m)
    on_rod = abs(balance(m.given.crank, m.given.rod, masses).rod)
    return (
        f"moving masses {masses['crank'].mass * 1e3:.4g} g crank, {masses['rod'].mass * 1e3:.4g} g rod, "
        f"{masses['slider'].mass * 1e3:.4g} g slider; full force balance takes {on_rod:.4g} kg mm "
        f"on the rod behind the crank pin and {_on_crank(m):.4g} kg mm on the crank"
    )


NOTES = all_of(
    Note[Mechanism](
        "slider-crank.stroke", _stroke_message, lambda m: ends_of(m).stroke, "mm", stage=Stage.MOTION
    ),
    Note[Mechanism](
        "slider-crank.stack",
        _stack_message,
        lambda m: len(layout_of(m).stack.layers),
        stage=Stage.MOTION,
    ),
    Note[Mechanism]("slider-crank.forces", _forces_message, _torque, "N*m", stage=Stage.MOTION),
    Note[Mechanism]("slider-crank.balance", _balance_message, _on_crank, "kg*mm", stage=Stage.MOTION),
)

RULES: Rules[Mechanism] = in_turn(MOTION, TURNING, PARTS, STRENGTH, NOTES)


def buildable(table: Mechanism) -> Any:
    """Whether a design has no error; a column of a table."""
    if table.single:
        found = table.once("findings", lambda: RULES.findings(table, quick=True))
        return not any(one.severity is Severity.ERROR for one in found)
    stands = np.zeros((table.size, 1), bool)
    stands[RULES.allowed(table, Stage.PARTS, lambda *_: None)[1]] = True
    return stands
