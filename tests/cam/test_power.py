"""Power and torque of cuts: against reference values, as simulated, and within what the spindle has."""

import json
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from by_control import BY_NAME, CONTROLS, asked, prove, simulated
from golden_operations import made
from shop import plate_job
from test_simulation import row

from mechwright.contracts.materials import Material, material
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.machining import Machined, machine
from mechwright_cam.operations.bending import bent
from mechwright_cam.program.moves import Operation, Program, ToolSection
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.power import WATTS, available, milling_force, slower
from mechwright_cam.shop.tool import CuttingChange

FACTS, RULES = json.loads(
    (Path(__file__).parents[1] / "data" / "cutting.json").read_text(encoding="utf-8")
).values()


def stuff(force: float, exponent: float) -> Material:
    return replace(material("steel"), force=force, force_exponent=exponent)


@pytest.mark.parametrize("fact", FACTS, ids=lambda fact: f"{fact['name']} {fact['inputs']['d']}")
def test_power_and_torque_are_those_of_the_exact_integral(fact) -> None:
    given = fact["inputs"]
    d, wide = given["d"], given["ae"]
    engagement = math.acos(1 - 2 * wide / d)
    removal = wide * given["ap"] * given["rpm"] * given["teeth"] * given["fz"] / 1000
    watts = removal * WATTS * float(milling_force(stuff(given["kc11"], given["mc"]), given["fz"], engagement))
    found = watts if fact["unit"] == "W" else watts / (2 * math.pi * given["rpm"] / 60)
    assert found == pytest.approx(fact["expected"], rel=1e-5)


def rules(name: str) -> list[dict[str, object]]:
    return [fact for fact in RULES if fact["name"] == name]


@pytest.mark.parametrize("fact", rules("cut.power_hm"), ids=lambda fact: f"{fact['inputs']['d']}")
def test_the_handbooks_rule_with_the_mean_chip_is_little_above_it(fact) -> None:
    given = fact["inputs"]
    d, wide, fz = given["d"], given["ae"], given["fz"]
    engagement = math.acos(1 - 2 * wide / d)
    removal = wide * given["ap"] * given["rpm"] * given["teeth"] * fz
    mean = 2 * wide * fz / (d * engagement)
    rule = removal * given["kc11"] * mean ** -given["mc"] / 6e4
    assert rule == pytest.approx(fact["expected"], rel=1e-9)
    ours = removal / 1000 * WATTS * float(milling_force(stuff(given["kc11"], given["mc"]), fz, engagement))
    assert 1.02 < rule / ours < 1.045


@pytest.mark.parametrize("fact", rules("cut.peak_tooth_force"), ids=lambda fact: f"{fact['inputs']['d']}")
def test_no_torque_is_above_that_of_all_teeth_at_their_peak(fact) -> None:
    given = fact["inputs"]
    d, engagement = given["d"], math.acos(1 - 2 * given["ae"] / given["d"])
    chip = given["fz"] * math.sin(min(engagement, math.pi / 2))
    peak = given["kc11"] * given["ap"] * chip ** (1 - given["mc"])
    assert peak == pytest.approx(fact["expected"], rel=1e-9)
    removal = given["ae"] * given["ap"] * given["teeth"] * given["fz"] / 1000  # in a turn, cm³
    force = float(milling_force(stuff(given["kc11"], given["mc"]), given["fz"], engagement))
    torque = removal * WATTS * force / (2 * math.pi) * 60
    engaged = given["teeth"] * engagement / (2 * math.pi)
    assert 0.3 < torque / (peak * engaged * d / 2000) < 1


@pytest.mark.parametrize("fact", rules("cut.deflection_end_load"), ids=lambda fact: f"{fact['inputs']['d']}")
def test_a_cutter_bends_as_a_rod_of_its_core(fact) -> None:
    given = fact["inputs"]
    length, core = given["L"], given["d_eff"] * given["d"]
    found = bent(given["F"], length, length, core, given["d"], given["E_MPa"])
    assert found == pytest.approx(fact["expected"], rel=1e-7)
    assert bent(given["F"], length, length / 2, core, given["d"], given["E_MPa"]) < found


def test_a_load_at_the_end_bends_more_than_one_along_the_cut() -> None:
    (fact,) = rules("cut.deflection_tip_distributed")
    given = fact["inputs"]
    length, deep, core = given["L"], given["ap"], given["d_eff"] * given["d"]
    at = length - deep + deep * (np.arange(2000) + 0.5) / 2000
    one = at**2 * (3 * length - at) / (6 * given["E_MPa"] * math.pi * core**4 / 64)
    assert given["F"] * one.mean() == pytest.approx(fact["expected"], rel=1e-6)
    assert bent(given["F"], length, length, core, given["d"], given["E_MPa"]) > 1.5 * fact["expected"]


@pytest.mark.parametrize(("over", "deep"), [(6.0, 2.0), (3.0, 2.0), (1.0, 3.0)])
def test_the_simulation_measures_the_power_of_a_cut(over: float, deep: float) -> None:
    """A slot, half of one, and a narrow cut beside one, which the first cut has made slowly."""
    of = plate_job()
    mill = load_library().get("mill-6").model_copy(update={"number": 9})
    first = Operation("o", tuple(row(-24, 24, 0, -deep, 20.0)) if over < 6 else ())
    second = Operation("p", tuple(row(-20, 20, over if over < 6 else 0, -deep, 1200.0)))
    sections = tuple(
        ToolSection(tool, 8000, "flood", (one,))
        for tool, one in ((of.tools[2], first), (mill, second))
        if one.moves
    )
    seen = simulated(
        LinuxCnc().write(Program("plate", "G54", 5.0, sections)), replace(of, tools=(*of.tools, mill))
    )
    (work,) = (work for work in seen.works if work.tool == 9)
    loads = seen.loads.only(seen.loads.tool == 9)
    steady = loads.only(loads.path >= 5).power[1:-1]
    aluminium, tooth = material("aluminium"), 1200 / 8000 / 3
    engagement = math.acos(1 - min(over, 6.0) / 3)
    wanted = min(over, 6.0) * deep * 1.2 * WATTS / 1000 * float(milling_force(aluminium, tooth, engagement))
    assert steady == pytest.approx(wanted, rel=0.06)
    assert work.torque == pytest.approx(work.power * 1000 / (2 * math.pi * 8000 / 60))
    assert work.share == pytest.approx(work.power / float(available(of.settings.machine, 8000.0)))


def test_torque_limits_below_the_base_speed_and_power_above() -> None:
    spindle = Machine(spindle_power=2.2, spindle_torque=0.88, spindle_efficiency=1.0)
    assert float(available(spindle, 6000.0)) == pytest.approx(0.553, abs=1e-3)
    assert float(available(spindle, 24000.0)) == pytest.approx(2.2, abs=0.012)
    assert float(available(spindle, 30000.0)) == 2.2
    assert slower(material("steel"), 2.0, 1.0) == pytest.approx(0.5 ** (1 / 0.83))


ROUTER = Machine(spindle_power=0.3, spindle_torque=0.3)


def weaker(one: Machined, spindle: Machine = ROUTER) -> Job:
    return replace(one.job, settings=one.job.settings.model_copy(update={"machine": spindle}))


@pytest.mark.parametrize("control", CONTROLS)
def test_a_cut_beyond_the_spindle_is_refused_and_the_advice_helps(control: str) -> None:
    (one,) = made("profile-outside", control)
    of, text = weaker(one), one.text
    proof = prove(text, of, BY_NAME[control])
    assert [check.name for check in proof.failures] == ["power"]
    seen = set()
    for _ in range(30):  # each line that is beyond it names the feed which does
        check = asked("power", text, of, BY_NAME[control])
        if check.passed:
            break
        said = re.match(
            r"line (\d+): T23 \(mill-8\) asks for [\d.]+ kW and [\d.]+ N m at S8754 in aluminium, the spindle of "
            r"three-axis mill has [\d.]+ kW there for the cut; lower F from (\d+) to (\d+), or cut [\d.]+ mm deep "
            r"instead of [\d.]+, at X",
            check.message,
        )
        assert said, check.message
        assert int(said[1]) == check.line
        assert (said[2], said[3]) not in seen
        seen.add((said[2], said[3]))
        text = re.sub(rf"F{said[2]}(?=[.\s])", f"F{said[3]}", text)
    assert check.passed
    assert check.value <= check.limit * 1.02


@pytest.mark.parametrize("control", ["linuxcnc", "grbl"])
def test_planning_slows_what_the_spindle_has_no_power_for_and_nothing_else(control: str) -> None:
    """The depth of passes is said: without that passes are less deep, and need no slower feed."""
    (one,) = made("profile-outside", control)
    cutting = {"mill-8": CuttingChange(step_down=0.5)}
    of = weaker(one)
    of = replace(of, settings=of.settings.model_copy(update={"cutting": cutting}))
    slow = machine(of, BY_NAME[control])
    assert slow.proof.ok
    assert slow.program.notes[
        -1
    ] == "feed lowered to the power of the spindle: outside: rough, bore: bore" or (
        slow.program.notes[-1].startswith("feed lowered to the power of the spindle: ")
    )
    assert "lowered to the power" in slow.text.lower()
    share = max(work.share for work in slow.scene.simulation.works)
    assert 0.9 < share <= 1.02  # no slower than it has to be
    before, after = (
        [move for section in item.program.sections for part in section.operations for move in part.moves]
        for item in (one, slow)
    )
    changed = [(a, b) for a, b in zip(before, after, strict=True) if a != b]
    assert changed
    assert all(replace(b, feed=a.feed) == a and b.feed < a.feed for a, b in changed)
    finishing = {
        move for s in slow.program.sections for o in s.operations if "finish" in o.name for move in o.moves
    }
    assert finishing <= set(before)
    assert slow.proof.time_estimate_s > one.proof.time_estimate_s


def test_a_strong_spindle_changes_no_program() -> None:
    (one,) = made("profile-outside", "linuxcnc")
    strong = weaker(one, Machine(spindle_power=100, spindle_torque=500))
    assert machine(strong, LinuxCnc()).text == one.text
