"""Machine files and known machines: their figures arrive, and their limits are kept."""

from pathlib import Path

import pytest
from by_control import asked
from planning_parts import LIBRARY, bore, job, plate
from shop import plate_job, plate_program

from mechwright.contracts.finding import Severity
from mechwright.designs.design import load
from mechwright.errors import MechwrightError
from mechwright.plugins.host import host
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.machining import machine as build
from mechwright_cam.planning import choose_tools
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.setup.limits import check_machine
from mechwright_cam.shop.machine import Machine, known_machines
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.table import settings_of
from mechwright_cam.shop.tool import MILLS

HEAD = 'family = "elliptic-gears"\n'
KNOWN = {name: figures for name, (figures, _) in known_machines().items()}


def machine_of(folder: Path, text: str) -> Machine:
    path = folder / "design.toml"
    path.write_text(HEAD + text)
    return settings_of(load(path, host())).cam.machine


@pytest.mark.parametrize("name", KNOWN)
def test_a_known_machine_has_its_figures(name: str, tmp_path: Path) -> None:
    found = machine_of(tmp_path, f'[cam]\nmachine = "{name}"\n')
    assert found.model == name
    assert found.model_dump(mode="json", include=set(KNOWN[name])) == KNOWN[name]


def test_single_keys_go_over_the_known_ones(tmp_path: Path) -> None:
    found = machine_of(tmp_path, '[cam.machine]\nmodel = "haas-vf-2"\nspindle_max = "6000 rpm"\n')
    assert (found.spindle_max, found.travel_x) == (6000, 762)


def test_a_machine_file_beside_the_design(tmp_path: Path) -> None:
    (tmp_path / "mill.toml").write_text('name = "old lady"\ntravel_x = "10 in"\nhome_x = 5\n')
    found = machine_of(tmp_path, '[cam]\nmachine = "mill.toml"\n')
    assert (found.name, found.travel_x, found.home_x) == ("old lady", 254, 5)


@pytest.mark.parametrize(
    ("file", "cam", "said"),
    [
        ("", 'machine = "haas-vf-3"', "unknown machine 'haas-vf-3'; did you mean 'haas-vf-2'?"),
        ("", 'machine = "none.toml"', "none.toml: cannot be read"),
        ("", 'machine = "../mill.toml"', "leads out of the folder"),
        ("", "machine = 5", "cam.machine: "),
        ("", "machine = { model = 5 }", "cam.machine.model: 5 should be"),
        ("travel = 5", 'machine = "mill.toml"', "mill.toml: machine: unknown key 'travel'"),
        ("travel_x = -5", 'machine = "mill.toml"', "mill.toml: machine.travel_x: -5 should be"),
        ('model = "haas-vf-2"', 'machine = "mill.toml"', "a machine file stands for itself"),
        (
            "low_x = 0\ntravel_x = 300\nhome_x = 301",
            'machine = "mill.toml"',
            "home_x is 301, and X travels from",
        ),
        ("spindle_min = 9000\nspindle_max = 80", 'machine = "mill.toml"', "spindle_min must be below"),
        ("x = [", 'machine = "mill.toml"', "mill.toml: is no valid TOML"),
    ],
)
def test_a_mistake_names_file_and_key(tmp_path: Path, file: str, cam: str, said: str) -> None:
    (tmp_path / "mill.toml").write_text(file)
    with pytest.raises(MechwrightError) as caught:
        machine_of(tmp_path, f"[cam]\n{cam}\n")
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_the_limits_of_the_machine_are_in_the_program() -> None:
    slow = {"spindle_max": 3000, "max_feed": 333}
    made = build(job(plate(bore(12.0)), "drill-8", "mill-6", machine=slow), LinuxCnc())
    speeds = {section.spindle for section in made.program.sections}
    assert max(speeds) <= 3000
    assert max(float(w[1:]) for w in made.text.split() if w[0] == "F" and w[1:2].isdigit()) == 333


def test_a_tool_too_long_for_the_room_below_the_spindle_is_found() -> None:
    low = job(plate(bore(12.0)), "drill-8", "mill-6", machine={"nose_to_table": 45})
    longest = max(low.tools, key=lambda tool: tool.flute_length)
    (found,) = check_machine(low)
    assert (found.code, found.severity) == ("cam.tool-too-long", Severity.ERROR)
    assert longest.name in found.message
    assert found.value > found.limit == 45
    assert (
        list(
            check_machine(job(plate(bore(12.0)), "drill-8", "mill-6", machine={"nose_to_table": found.value}))
        )
        == []
    )


@pytest.mark.parametrize("thickness", [8.0, 10.0])
@pytest.mark.parametrize("held", [{}, {"method": "bore", "clamp_diameter": 6, "clamp_height": 8}])
def test_cutters_are_chosen_that_get_over_the_part(thickness, held) -> None:
    small = CamSettings.model_validate({"machine": {"nose_to_table": 80}, "hold": held})
    of = plate(bore(12.0), bore(6.0, (20.0, 0.0)), thickness=thickness, material="steel")
    chosen = choose_tools(of, small, LIBRARY)
    low = make_job(of, small, chosen)
    assert list(check_machine(low)) == []
    assert any(tool.kind in MILLS for tool in chosen)
    assert "drill-10" in {tool.name for tool in choose_tools(of, CamSettings(), LIBRARY)}


def test_a_machine_too_low_for_any_mill_is_named() -> None:
    """One of 0.8 mm gets over the part, but cuts no 10 mm: the refusal is not about its length."""
    low = CamSettings.model_validate({"machine": {"nose_to_table": 50}})
    of = plate(bore(12.0), thickness=10.0)
    (found,) = check_machine(make_job(of, low, choose_tools(of, low, LIBRARY)))
    assert found.code == "cam.tool-too-long"


def test_more_tools_than_places_are_a_warning() -> None:
    few = job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6", machine={"pockets": 2})
    (found,) = check_machine(few)
    assert (found.code, found.severity, found.value, found.limit) == ("cam.pockets", Severity.WARNING, 3, 2)
    assert list(check_machine(job(plate(bore(12.0)), "drill-8", "mill-6", machine={"pockets": 2}))) == []


@pytest.mark.parametrize(
    ("measured", "axis", "beyond"),
    [
        ({"x": -250.0, "y": -150.0, "z": -200.0}, None, 0.0),
        ({"x": -470.0, "y": -150.0, "z": -200.0}, "X", 3.001),
        ({"x": -33.0, "y": -150.0, "z": -200.0}, "X", 0.001),
        ({"x": -250.0, "y": -380.0, "z": -200.0}, "Y", 3.001),
        ({"x": -250.0, "y": -150.0, "z": -399.0}, "Z", 8.0),
    ],
)
def test_every_move_is_within_the_travel_as_the_stock_is_clamped(measured, axis, beyond) -> None:
    ends = {"low_x": -500, "low_y": -400, "low_z": -400}
    placed = plate_job(machine=ends, measured=measured)
    tools = tuple(tool.model_copy(update={"length": 0.0}) for tool in placed.tools)
    placed = plate_job(machine=ends, measured=measured, tools=tools)
    found = asked("travel", LinuxCnc().write(plate_program()), placed)
    assert found.passed == (axis is None)
    if axis:
        assert f"leaves the travel of {axis} by" in found.message
        assert found.value == pytest.approx(beyond, abs=1e-3)
