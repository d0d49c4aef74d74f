"""Strength of the joints: pins, plates beside their bores, bushings and clamps, from forces over a period."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mechwright import Finding, Severity, Stage
from mechwright.contracts.finding import at_stage
from mechwright.contracts.procedure import Note
from mechwright.contracts.rule_list import all_of
from mechwright.mechanics.linkage.clamp_findings import clamped
from mechwright.mechanics.linkage.kinematics.forces import MILLI, period_forces
from mechwright.mechanics.linkage.rules import strength as of_linkages
from mechwright.mechanics.linkage.rules.strength import larger_bearings
from mechwright.mechanics.strength.bearings_life import SINTERED_PRESSURE, bush_pressure
from mechwright.mechanics.strength.judging import RowStressRule, Stress, Way
from mechwright.mechanics.strength.turning_pair import (
    TurningPair,
    bush_stresses,
    eye_stresses,
    pin_stresses,
)
from mechwright_four_bar.rules.force_bounds import bears
from mechwright_four_bar.rules.motion_rules import Fails, Proc, Rule
from mechwright_four_bar.table import FourBarTable


def pairs_of(m: FourBarTable) -> dict[str, TurningPair]:
    """Joint to the bearing that it is over a period."""

    def found() -> dict[str, TurningPair]:
        pairs = {pair.name.split()[1]: pair for pair in of_linkages.pairs_of(m)}
        names = {joint: f"{'pin' if joint in {'A', 'B'} else 'shaft'} {joint}" for joint in pairs}
        return {joint: replace(pair, name=names[joint]) for joint, pair in pairs.items()}

    return m.once("bearings", found)


def pins(m: FourBarTable) -> list[Stress]:
    """Of the pins of all joints."""
    return pin_stresses(pairs_of(m).values())


def eyes(m: FourBarTable) -> list[Stress]:
    """Of the plates beside all joints."""
    return eye_stresses(pairs_of(m).values())


def bushes(m: FourBarTable) -> list[Stress]:
    """Of all plain bearings."""
    return bush_stresses(pairs_of(m).values())


def _load(m: FourBarTable) -> str:
    most = max(pairs_of(m).values(), key=lambda pair: pair.greatest)
    return f"{most.greatest:.4g} N at {most.name}"


def _ways(m: FourBarTable, *names: str) -> list[Way]:
    params = m.params
    less = [Way("load_torque", params.load_torque, up=False), Way("speed", params.speed, up=False)]
    return [*(Way(name, getattr(params, name)) for name in names), *less]


STRENGTH = all_of(
    RowStressRule("four-bar.pin", pins, lambda m: _ways(m, "pin_diameter"), FourBarTable.of, _load),
    RowStressRule(
        "four-bar.eye",
        eyes,
        lambda m: _ways(m, "rim", "thickness"),
        FourBarTable.of,
        _load,
        breaks=True,
        bears=bears,
    ),
    RowStressRule("four-bar.bushing", bushes, lambda m: _ways(m, "thickness"), FourBarTable.of, _load),
)


def _most_pressed(m: FourBarTable) -> tuple[str, TurningPair]:
    """The joint with the greatest pressure on its projected area."""
    pairs = pairs_of(m)
    joint = max(("A", "B", "B0", "A0"), key=lambda one: pairs[one].greatest / pairs[one].width)
    return joint, pairs[joint]


def _pressure(m: FourBarTable) -> float:
    _, pair = _most_pressed(m)
    return bush_pressure(pair.greatest, pair.pin, pair.width)


def _pressed_message(f: Fails) -> str:
    joint, pair = _most_pressed(f.m)
    return f"joint {joint} carries up to {pair.greatest:.4g} N, {f.value:.4g} N/mm² on its bearing"


def _drive(m: FourBarTable) -> float:
    return float(np.abs(period_forces(m)[1].drive).max()) * MILLI


def _forces_message(m: FourBarTable) -> str:
    joint, pair = _most_pressed(m)
    return (
        f"the drive needs up to {_drive(m):.4g} N m; joint {joint} carries up to {pair.greatest:.4g} N, and "
        f"the moving masses shake the ground with up to {np.abs(period_forces(m)[1].shaking).max():.4g} N"
    )


BEARINGS = all_of(
    Rule(
        "four-bar.bearing-pressure",
        "pin_diameter",
        _pressed_message,
        value=_pressure,
        limit=SINTERED_PRESSURE,
        unit="N/mm^2",
        remedy="take thicker pins or plates, a smaller load or a lower speed",
        must_be="at most",
        severity=Severity.WARNING,
        proposed=lambda f: larger_bearings(f.m.params, f.value / f.limit, load="load_torque"),
    ),
    Note("four-bar.forces", _forces_message, _drive, "N*m"),
)


def _clamps(m: FourBarTable) -> Iterator[Finding]:
    """Whether friction holds more than what pulls."""
    for pin in m.layout.pins:
        if pin.clamp is not None:
            yield from clamped("four-bar.clamp", pin.eye, pin.clamp, pairs_of(m)[pin.eye].greatest)


CLAMPS = Proc(
    ("four-bar.clamp",),
    lambda m: at_stage(Stage.PARTS, _clamps(m)),
    when=lambda t: bool(t.params.phases),
    stage=Stage.PARTS,
)
