"""The drive of each family: what it has in a channel of its own, or a reference has, by virtual power again."""

import json
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night

from mechwright import Load, host
from mechwright.designs.design import load
from mechwright.machine import MachineSettings, drive_of
from mechwright.machine.course import over_time
from mechwright.machine.drive import SAMPLES
from mechwright.testing.frames import mounting_faults
from mechwright_elliptic_gears.family import EllipticGears

ROOT = Path(__file__).parents[2]
FACTS = {
    fact["name"]: fact
    for fact in json.loads((ROOT / "tests/data/machine.json").read_text())["facts"]
    if fact["name"].startswith(("drive.", "flywheel."))
}


def solved(name, **changes):
    found = load(ROOT / "examples" / f"{name}.toml", host())
    family = found.family
    params = type(found.params).model_validate(found.params.model_dump(exclude_none=True) | changes)
    return family.solve(params, SAMPLES), family.parts(params)


FOUR_BAR, SLIDER, GENEVA = "crank-rocker-three-poles", "slider-crank-quick-return", "geneva-straight"
CASES = [
    (FOUR_BAR, {"load_torque": 3.5, "speed": 400.0}, 1.0),
    (FOUR_BAR, {"load_torque": 3.5, "speed": 400.0, "direction": "cw"}, 1.0),
    (FOUR_BAR, {"acceleration_ratio": 0.5, "speed": 40.0}, 1.0),
    (SLIDER, {"load": -40.0, "speed": 300.0, "clockwise": True, "slide_direction": -20.0}, 1.0),
    (SLIDER, {"acceleration_ratio": -0.3}, 1.0),
    ("four-bar-double-rocker", {"load_torque": 1.0}, 1.0),
    (GENEVA, {"load_torque": 0.5}, 1.0),
    (GENEVA, {"load_torque": 0.5, "driver_direction": "backwards"}, 1.0),
    ("geneva-cycloidal", {}, 1.0),
]


@pytest.mark.parametrize(
    ("name", "changes", "share"),
    [pytest.param(*case, marks=by_night) if n in {1, 4, 8} else case for n, case in enumerate(CASES)],
)
def test_the_drive_is_the_familys_own_torque(name, changes, share):
    motion, parts = solved(name, **changes)
    drive = drive_of(motion, parts, MachineSettings())
    own = next(one.values for key, one in motion.channels.items() if key.endswith("_torque"))
    sense = 1.0 if drive.course.rocks else np.sign(np.diff(drive.course.angle[:2]))
    found = drive.runs[0].torque * sense
    np.testing.assert_allclose(found, own, rtol=0, atol=1e-6 * share * np.abs(own).max())


@pytest.mark.parametrize(
    "changes",
    [
        {"driver_law": "accelerating", "driver_acceleration": 20.0, "driver_direction": "backwards"},
        {"driver_law": "from-rest", "driver_acceleration": 20.0},
        {"driver_law": "harmonic", "driver_variation": 0.4},
    ],
)
def test_a_geneva_driver_that_varies_also_asks_for_its_own_inertia(changes):
    """Equation (7): the wheel by the family's contact; the driver itself, whose J α the contact has not."""
    motion, parts = solved(GENEVA, **changes)
    drive = drive_of(motion, parts, MachineSettings())
    sense = np.sign(np.diff(drive.course.angle[:2]))
    rest = sense * drive.runs[0].torque - motion.channels["crank_torque"].values
    alpha = motion.channels["alpha_d"].values
    turned = np.abs(alpha) > 0
    felt = drive.reflected[drive.reflected.argmin()]  # while the wheel rests
    np.testing.assert_allclose(rest[turned], felt * alpha[turned], rtol=1e-6, atol=1e-9)


def elliptic(**load):
    wanted = FACTS["drive.peak_inertia_torque"]["inputs"]
    params = EllipticGears.Params(eccentricity=wanted["e"], speed=wanted["n2"])
    motion = EllipticGears().solve(params, SAMPLES)
    carried = {"load": Load("gear-4", inertia=wanted["J4_kgm2"])}
    return drive_of(replace(motion, loads=carried), [], MachineSettings(speed_variation=2.5, **load))


def near(name, value, relative=2e-6):
    assert value == pytest.approx(FACTS[name]["expected"], rel=relative)


def test_the_published_elliptic_pair():
    drive = elliptic()
    peak, at, _ = drive.peak()
    near("drive.peak_inertia_torque", abs(peak))
    wanted = FACTS["drive.peak_angle"]["expected"]
    assert min(math.degrees(at), 360 - math.degrees(at)) == pytest.approx(wanted, abs=1e-3)
    near("drive.rms_inertia_torque", drive.rms)
    near("flywheel.energy_swing", drive.swing, 1e-5)
    near("flywheel.inertia", drive.flywheel(0.025), 1e-5)


def test_the_published_elliptic_pair_under_load():
    drive = elliptic(load=0.3, direction="forwards")
    near("drive.peak_torque_with_load", abs(drive.peak()[0]))
    near("drive.rms_torque_with_load", drive.rms)
    near("drive.mean_torque_with_load", drive.mean_of(drive.runs[0].torque))


def test_exact_rates_are_those_of_the_poses():
    """Of every body of a Geneva drive that varies; the cycloidal law has no jump, only its jerk has."""
    motion, _ = solved("geneva-cycloidal", driver_law="harmonic", driver_variation=0.3)
    time = motion.channels["time"].values
    for poses in motion.poses.values():
        for exact, found in zip(
            (poses.rates.first, poses.rates.second), over_time(poses.frames, time), strict=True
        ):
            off = np.abs(exact - found).max(axis=(1, 2))
            assert np.quantile(off, 0.95) < 1e-6 * np.abs(exact).max()
            assert off.max() < 0.05 * np.abs(exact).max()


def test_the_script_of_the_manual_prints_what_it_says(monkeypatch, capsys):
    monkeypatch.chdir(ROOT)
    text = (ROOT / "docs" / "drive-and-frame.md").read_text(encoding="utf-8")
    (code,) = (block for block in re.findall(r"```python\n(.*?)```", text, re.S) if "drive_of" in block)
    exec(code, {})  # noqa: S102 - our own
    assert capsys.readouterr().out.strip() == code.rpartition("# ")[2].strip()


@pytest.mark.parametrize("name", ["elliptic-pair"])
def test_a_spindle_that_is_no_axis_of_its_body_or_whose_hub_is_elsewhere_is_told(name):
    found = load(ROOT / "examples" / f"{name}.toml", host())
    mounting, parts, motion = found.family.mounting(found.params), found.parts(), found.solve(9)
    assert list(mounting_faults(mounting, parts, motion)) == []
    one, *others = mounting.spindles
    x, y = one.point
    for wrong, said in (
        (replace(one, hub=replace(one.hub, low=one.hub.low - 500)), "no part of it"),
        (replace(one, hub=replace(one.hub, high=one.hub.high + 500)), "no part of it"),
        (replace(one, point=(x, y + 1.0)), "turns 1 mm off"),
        (replace(one, body="nobody"), "no body 'nobody'"),
    ):
        (told,) = mounting_faults(replace(mounting, spindles=(wrong, *others)), parts, motion)
        assert said in told
