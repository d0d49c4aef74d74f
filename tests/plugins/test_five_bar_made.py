"""The five-bar as made: tolerances, play of the gears, plates as made, bending of teeth, every setting."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mechwright import Tolerances
from mechwright.contracts.finding import Severity
from mechwright.contracts.made_part import MadeHole
from mechwright.contracts.tolerance_settings import ToleranceSettings
from mechwright.designs.design import load
from mechwright.mechanics.linkage.made_error import EXACT
from mechwright.mechanics.strength.tooth_bending import form_factors
from mechwright.plugins.host import host
from mechwright.testing.tolerances import tolerance_faults
from mechwright_five_bar.as_made.tolerances import FiveBarTolerances
from mechwright_five_bar.defaults.complete_parameters import CompleteParams
from mechwright_five_bar.family import FiveBars
from mechwright_five_bar.kinematics.dimensions import bar_of
from mechwright_five_bar.kinematics.loads import loads_of
from mechwright_five_bar.kinematics.train import train_of
from mechwright_five_bar.rules.strength import root_stresses
from mechwright_five_bar.table import FiveBarTable

EXAMPLES = Path(__file__).parents[2] / "examples"


def example(name: str) -> CompleteParams:
    params = load(EXAMPLES / f"{name}.toml", host()).params
    assert isinstance(params, CompleteParams)
    return params


@pytest.mark.parametrize("name", ["five-bar-published", "five-bar-slots", "five-bar-three-phases"])
def test_sensitivities_are_derivatives_in_every_phase(name):
    params = example(name)
    with_input = Tolerances(ToleranceSettings(input=0.1))
    for phase in range(1, 2 + len(params.phases)):
        model = FiveBars().tolerances(params.model_copy(update={"phase": phase}), with_input)
        assert tolerance_faults(model) == []
        assert {"crank", "arm", "pin-c", "mesh-pinion-idler", "input"} <= {
            one.name for one in model.contributors
        }


def test_play_of_the_gears_is_an_angle_of_the_arm():
    """A play s of each mesh lets the arm run behind by 2 s over the wheel's radius."""
    params = CompleteParams()
    model, bar = FiveBarTolerances(FiveBarTable.of(params), EXACT), bar_of(params)
    at, play = np.array([0.3, 2.0, 5.0]), 1e-5
    rates = dict(
        zip(
            (one.name for one in model.contributors),
            model.sensitivities("coupler point", at),
            strict=True,
        )
    )
    moved = sum(rates[name][:, 0] for name in model.meshes) * play
    turn = 2 * play / train_of(params).radius("wheel")

    def point(offset: float) -> np.ndarray:
        bodies = replace(bar, offset=bar.offset + offset).at(at).bodies
        return bodies["coupler"].point(params.coupler_point).position

    wanted = (point(turn) - point(-turn)) / 2
    assert moved[0] + 1j * moved[1] == pytest.approx(wanted, rel=1e-6)


class Bored:
    """A plate whose bores are as drawn, or larger by ``more``."""

    corridor = 0.0

    def __init__(self, more: float = 0.0) -> None:
        self.more = more

    def hole_at(self, x, y, diameter):
        return MadeHole(x, y, diameter + self.more, diameter + self.more, 0.0)


def test_plates_as_drawn_leave_the_play_of_pins_and_gears():
    params = CompleteParams()
    plates = {name: [Bored()] for name in ("ground", "crank", "coupler", "rocker", "arm")}
    point, room = FiveBars().as_made(params, plates).figures
    assert (point.name, room.name) == ("point.error", "pin.room")
    assert point.made == pytest.approx(point.design, rel=1e-9)
    assert point.low == 0
    assert room.made == pytest.approx(params.running_fit)
    without = FiveBars().as_made(params.model_copy(update={"backlash": 0.0}), plates).figures[0]
    assert without.made < point.made
    assert FiveBars().as_made(params, {"crank": [Bored()]}).figures == ()


def test_a_bare_bore_as_made_too_small_is_refused_with_a_fit_that_works():
    params = CompleteParams(bushing_wall=0)
    plates = {name: [Bored(-0.05)] for name in ("ground", "crank", "coupler", "rocker", "arm")}
    (fault,) = FiveBars().as_made(params, plates).findings
    assert (fault.code, fault.parameter) == ("five-bar.as-made", "running_fit")


def test_a_coupler_that_is_set_counts_as_drawn():
    """Studs turn in crank and rocker, whose bores matter; the coupler's length is set by its scales."""
    plates = {name: [Bored()] for name in ("ground", "crank", "coupler", "rocker", "arm")}
    params = example("five-bar-slots").model_copy(update={"bushing_wall": 0.0})
    point, room = FiveBars().as_made(params, plates).figures
    assert point.made == pytest.approx(point.design, rel=1e-9)
    assert point.rule.endswith("A and C set as their scales say")
    assert room.made == pytest.approx(params.running_fit)
    for name, less in (("coupler", False), ("crank", True), ("rocker", True)):
        made = FiveBars().as_made(params, {**plates, name: [Bored(-0.05)]})
        assert bool(made.findings) == less
        assert (made.figures[0].made != point.made) == less


def test_a_coupler_with_bores_counts_as_made():
    params = example("five-bar-three-phases").model_copy(update={"bushing_wall": 0.0})
    plates = {name: [Bored()] for name in ("ground", "crank", "coupler", "rocker", "arm")}
    first = FiveBars().as_made(params, plates).figures[0]
    assert "scales" not in first.rule
    assert FiveBars().as_made(params, {**plates, "coupler": [Bored(0.1)]}).figures[0].made > first.made


def test_teeth_bear_by_the_formula_and_too_much_is_told_with_what_helps():
    params = CompleteParams(load_x=2000.0)
    train = train_of(params)
    (pinion,) = (one for one in root_stresses(FiveBarTable.of(params)) if "pinion" in one.what)
    force = loads_of(FiveBarTable.of(params)).peaks["tooth_force"].value
    form, stress = form_factors(20.0)
    # Force over face and module, with the factors of the rack and 1.5 for what is not known.
    assert pinion.value == pytest.approx(
        1.5 * force / (params.gear_thickness * train.module) * float(form * stress), rel=1e-6
    )
    (fault,) = [one for one in FiveBars().check(params) if one.code == "five-bar.root"]
    assert fault.severity is not Severity.NOTE
    assert fault.value > fault.limit
    assert fault.proposed
    for change in fault.proposed:
        (key, value), *_ = change.items()
        better = params.model_copy(update={key.removeprefix("parameters."): value})
        worst = max(one.used for one in root_stresses(FiveBarTable.of(better)))
        assert worst <= 1


def test_settings_are_the_other_phases():
    params = example("five-bar-three-phases")
    assert [one.phase for one in FiveBars().settings(params).values()] == [2, 3]
