"""What a motor takes beside itself."""

import pytest
from test_machine_motor import drive
from test_machine_motor import settings as machine

from mechwright.machine import motor_of
from mechwright.machine.electrics import CURRENTS, FUSES, current_of, electrics_of, supply_of


def bought(**keys):
    asked = machine(**keys)
    found = drive(asked)
    choice = motor_of(found, asked)
    return choice, {one.name: one for one in electrics_of(found, asked, choice)}


def test_a_gear_motor_takes_a_limit_below_what_breaks_its_gearbox():
    choice, list_of = bought(motor="37D 131:1", load=0.3, direction="forwards", speed=40, speed_variation=50)
    limit = 0.2 + 5.3 * 250 / 450
    assert current_of(choice)[0] == pytest.approx(limit)
    assert supply_of(choice) == (12.0, pytest.approx(1.25 * limit))
    assert list_of["power supply"].order.startswith("power supply 12 V DC, 4 A")
    assert "current limit" in list_of["driver"].order
    assert "set the limit to 3.1 A" in list_of["driver"].note
    assert "direction switch" not in list_of["controller"].order
    assert f"{choice.speed.voltage:.3g} V" in list_of["controller"].note


def test_a_fast_gear_motor_stalls_before_its_gearbox_breaks():
    choice, list_of = bought(motor="37D 18.75:1", load=0.02, speed=100, speed_variation=100)
    assert current_of(choice)[0] == 5.5
    assert supply_of(choice)[1] == pytest.approx(6.875)
    assert list_of["power supply"].order.startswith("power supply 12 V DC, 8 A")
    assert "current limit" not in list_of["driver"].order
    assert list_of["controller"].order.endswith("and a direction switch")


def test_the_fuse_bears_one_and_a_half_of_the_rms_current():
    choice, list_of = bought(motor="37D 131:1", load=0.3, speed=40, speed_variation=50)
    rms = 0.2 + 5.3 * choice.demand.rms / choice.motor.stall_torque
    assert current_of(choice)[1] == pytest.approx(rms)
    fuse = min(one for one in FUSES if one >= 1.5 * rms)
    assert f"slow, {fuse:g} A" in list_of["fuse"].order


def test_a_stepper_takes_both_phases_and_pulses():
    choice, list_of = bought(motor="NEMA 23 - 76", load=0.02, voltage=36, speed=60)
    assert supply_of(choice) == (36.0, pytest.approx(0.7 * 2 * 2.8 * 1.25))
    assert "5 A" in list_of["power supply"].order
    assert "2.8 A a phase, 36 V" in list_of["driver"].order
    rate = choice.demand.speed / 60 * 200 * 8
    assert f"{rate:.0f} pulses/s" in list_of["controller"].order
    assert "4 x 0.75" in list_of["cable"].order


def test_a_motor_that_no_frame_carries_is_on_the_list_with_what_couples_it():
    _, list_of = bought(motor="37D 131:1", load=0.3, speed=30, speed_variation=50, gear=1.6)
    assert list_of["motor"].order == "gear motor 37D, 12 V, 131:1, 76 rev/min"
    assert "1.6 to 1" in list_of["belt drive"].order
    _, carried = bought(motor="37D 131:1", load=0.3, speed=40, speed_variation=50, frame="base")
    assert not {"motor", "coupling", "belt drive"} & set(carried)


def test_everybody_gets_a_stop_a_switch_and_a_fuse():
    for name in ("37D 131:1", "NEMA 23 - 76"):
        _, list_of = bought(motor=name, load=0.02, speed=40, speed_variation=100)
        assert {
            "power supply",
            "driver",
            "controller",
            "main switch",
            "emergency stop",
            "fuse",
            "cable",
        } <= set(list_of)
        assert all(one.note and one.order for one in list_of.values())
    assert list(CURRENTS) == sorted(CURRENTS)
