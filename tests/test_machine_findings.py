"""What is found of a machine, what is written of it, and what is said of mistakes in its table."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import pytest

from mechwright import Build, host
from mechwright.contracts.finding import Severity
from mechwright.designs.design import load
from mechwright.errors import DesignError
from mechwright.machine.inspection import MachineDrive
from mechwright.machine.page import FIGURES, DrivePage
from mechwright.machine.table import MachineTable
from mechwright.pipeline import LOOK, Run
from mechwright.remedies import proposed_tried

Command = Callable[..., tuple[int, str, str]]
ROOT = Path(__file__).parents[1]


def build_of(folder: Path, example: str, table: str) -> Build:
    path = folder / "design.toml"
    said = (ROOT / "examples" / f"{example}.toml").read_text(encoding="utf-8")
    path.write_text(f"{said}\n[machine]\n{table}\n", encoding="utf-8")
    return Build(path, host())


def found(build: Build) -> dict[str, str]:
    return {one.code: one.message for one in MachineDrive().findings(build)}


FOUR_BAR, SLIDER, TRAIN = "crank-rocker-three-poles", "slider-crank-quick-return", "figure-eight-variable"


def test_a_design_without_the_table_is_as_before(tmp_path: Path) -> None:
    for table in ("", "margin = 1.5"):
        build = build_of(tmp_path, FOUR_BAR, table)
        assert MachineDrive().findings(build) == ()
        assert DrivePage().files(build) == {}
    assert MachineTable().text(build_of(tmp_path, FOUR_BAR, "").design.table(MachineTable)) == []


def test_torque_flywheel_and_motor_are_told(tmp_path: Path) -> None:
    build = build_of(tmp_path, FOUR_BAR, 'load = 0.05\nmotor = "auto"\nup = "y"')
    notes = MachineDrive().findings(build)
    assert {one.severity for one in notes} == {Severity.NOTE}
    said = {one.code: one for one in notes}
    assert {
        "machine.torque",
        "machine.flywheel",
        "machine.motor",
        "machine.shaft",
        "machine.coupling",
    } <= set(said)
    data = json.loads(DrivePage().files(build)["drive.json"])
    assert said["machine.torque"].value == pytest.approx(abs(data["figures"]["peak_torque"]["value"]))
    assert said["machine.flywheel"].value == pytest.approx(data["figures"]["flywheel"]["value"])
    assert said["machine.motor"].value == pytest.approx(data["figures"]["motor_cover"]["value"])
    assert data["motor"] in said["machine.motor"].message
    assert "flexible coupling" in said["machine.coupling"].message


def test_the_page_draws_each_part_of_the_torque_and_says_it_the_same_way_twice(tmp_path: Path) -> None:
    def page() -> str:
        build = build_of(tmp_path, FOUR_BAR, 'load = 0.05\nmotor = "NEMA 17 - 40"\nup = "y"\nspeed = 90')
        return str(DrivePage().files(build)["drive.html"])

    html = page()
    assert html == page()
    for words in ("accelerated masses", "weights", "resistance", "Motor NEMA 17 - 40", "backwards", "y up"):
        assert words in html
    assert "given loads" not in html
    pictures = [piece.partition("</svg>")[0] + "</svg>" for piece in html.split("<svg")[1:]]
    assert len(pictures) == 5
    for picture in pictures:
        drawn = ElementTree.fromstring("<svg" + picture)  # noqa: S314 - our own
        assert len(drawn) > 10
        height = float(drawn.attrib["viewBox"].split()[3])
        words = [one for one in drawn.iter() if one.tag.endswith("text")]
        assert words
        for one in words:
            size, y = float(one.attrib["font-size"]), float(one.attrib["y"])
            assert size < y < height - size / 4, f"{one.text} is cut off at {y} of {height}"
    build = build_of(tmp_path, FOUR_BAR, "speed = 90\nload = 0.05")
    figures = json.loads(DrivePage().files(build)["drive.json"])["figures"]
    assert figures.keys() < FIGURES.keys()
    assert figures["greatest_speed"]["value"] == pytest.approx(90)
    swings = 2 * build.motion.scalars["swing"].value * 90 / 60
    assert figures["mean_power"]["value"] == pytest.approx(0.05 * swings, rel=1e-4)


@pytest.mark.parametrize(
    ("table", "fixed"),
    [
        ('load = 0.3\nmotor = "NEMA 17 - 34"', "machine.gear"),
        ('load = 0.6\nmotor = "37D 18.75:1"\nspeed = 30', "machine.gear"),
        ('speed = 3000\nmotor = "NEMA 23 - 76"\nup = "y"', "machine.speed"),
        ('load = 40\nmotor = "NEMA 23 - 76"\nspeed = 60', "machine.load"),
    ],
)
def test_a_motor_that_is_too_weak_says_what_works(tmp_path: Path, table: str, fixed: str) -> None:
    build = build_of(tmp_path, FOUR_BAR, table)
    inspection = MachineDrive()
    (fault,) = (one for one in inspection.findings(build) if one.severity is Severity.ERROR)
    assert fault.code == fault.parameter == "machine.motor"
    assert fault.value is not None
    assert fault.limit is not None
    assert fault.value < fault.limit
    assert f"{fault.limit - fault.value:.3g} N·m are missing" in fault.message
    (told,) = (
        one for one in proposed_tried(Run(build, LOOK), inspection, [fault]) if one.code == "machine.motor"
    )
    assert told.fix is not None
    assert list(told.fix) == [fixed]
    motors = ["machine.motor" in change for change in fault.proposed]
    assert motors == sorted(motors)  # another motor is what is proposed last
    changed = build.design.changed(told.fix)
    again = MachineDrive().findings(Build(changed, host()))
    assert not [one for one in again if one.severity is Severity.ERROR]


@pytest.mark.parametrize(
    ("example", "table", "fixed"),
    [
        (FOUR_BAR, 'load = 0.05\nspeed = 60\nmotor = "37D 18.75:1"', "machine.motor"),
        ("elliptic-pair", 'motor = "37D 18.75:1"\nspeed = 60\nload = 0.1', "machine.motor"),
        ("elliptic-pair", 'motor = "37D 150:1"\nspeed = 60\nload = 0.1', None),
        ("geneva-straight", 'speed = 45\nmotor = "auto"\nload = 0.3', None),
    ],
)
def test_a_motor_that_turns_unevenly_is_an_error_whose_remedy_works(
    tmp_path: Path, example: str, table: str, fixed: str | None
) -> None:
    """At the voltage that it says; typed, the remedy leaves no error of the speed."""
    build, inspection = build_of(tmp_path, example, table), MachineDrive()
    (said,) = (one for one in inspection.findings(build) if one.code == "machine.speed")
    data = json.loads(DrivePage().files(build)["drive.json"])["figures"]
    least, mean, most, volts = (
        data[name]["value"]
        for name in ("least_driven_speed", "mean_driven_speed", "greatest_driven_speed", "motor_voltage")
    )
    assert f"at {volts:.3g} V" in said.message
    assert f"{least:.4g} to {most:.4g} rev/min" in said.message
    assert said.value == pytest.approx(max(most - mean, mean - least) / mean)
    if fixed is None:
        return
    assert said.severity is Severity.ERROR
    (told,) = (
        one for one in proposed_tried(Run(build, LOOK), inspection, [said]) if one.code == "machine.speed"
    )
    assert told.fix is not None
    assert list(told.fix) == [fixed]
    changed = Build(build.design.changed(told.fix), host())
    (again,) = (one for one in inspection.findings(changed) if one.code == "machine.speed")
    assert again.severity is Severity.NOTE


def test_the_page_draws_the_speed_of_a_gear_motor_and_says_the_voltage(tmp_path: Path) -> None:
    build = build_of(tmp_path, FOUR_BAR, 'load = 0.05\nspeed = 60\nmotor = "37D 131:1"')
    html = str(DrivePage().files(build)["drive.html"])
    assert "Speed of the input" in html
    assert "V (nominal 12 V) turns the input at" in html


def test_the_speed_of_the_parameters_is_changed_where_the_table_has_none(tmp_path: Path) -> None:
    build = build_of(tmp_path, "crank-rocker-three-poles", 'motor = "37D 150:1"')
    build = Build(build.design.changed({"parameters.speed": 400.0}), host())
    (fault,) = (one for one in MachineDrive().findings(build) if one.severity is Severity.ERROR)
    assert {"parameters.speed"} in [set(change) for change in fault.proposed]


def test_a_stepper_that_feels_too_much_inertia_is_told(tmp_path: Path) -> None:
    build = build_of(tmp_path, FOUR_BAR, 'motor = "NEMA 17 - 34"\nspeed = 25')
    told = {one.code: one for one in MachineDrive().findings(build)}
    warned = told["machine.inertia"]
    assert warned.severity is Severity.WARNING
    assert warned.value > warned.limit == 10
    assert "machine.resonance" in told
    assert "machine.braking" in told
    (tried,) = proposed_tried(Run(build, LOOK), MachineDrive(), [warned])
    assert tried.fix is not None


def test_the_key_of_the_driven_shaft_is_pressed(tmp_path: Path) -> None:
    light = build_of(tmp_path, TRAIN, 'load = 0.5\noutput = "gear-5"')
    said = found(light)["machine.key-pressure"]
    assert "the key 4 x 4 x 10" in said
    assert "aluminium" in said
    heavy = build_of(tmp_path, TRAIN, 'load = 12\noutput = "gear-5"\ndirection = "forwards"')
    warned = {one.code for one in MachineDrive().findings(heavy) if one.severity is Severity.WARNING}
    assert warned == {"machine.key-pressure", "machine.shaft"}


@pytest.mark.parametrize(
    ("example", "table", "said"),
    [
        (SLIDER, "load = 0.3", "machine.load: no body turns in the frame besides the driven one"),
        (TRAIN, "load = 0.3", "machine.output: gear-3, gear-5 turn in the frame"),
        (FOUR_BAR, 'output = "crank"', "machine.output: no body 'crank' turns .* those that do: follower"),
    ],
)
def test_what_the_mechanism_has_not_is_an_error_of_its_key(
    tmp_path: Path, example: str, table: str, said: str
) -> None:
    (fault,) = MachineDrive().findings(build_of(tmp_path, example, table))
    assert fault.severity is Severity.ERROR
    key, _, words = said.partition(": ")
    assert fault.parameter == key
    assert re.search(words, f"{fault.message}; {fault.remedy}")


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ('motor = "NEMA 17 -40"', "machine.motor: 'NEMA 17 -40' is no motor; did you mean 'NEMA 17 - 40'?"),
        ('motor = "steam"', "'steam' is no motor; one of: "),
        ("speed = 0", "machine.speed: 0 should be greater than or equal to 0.001"),
        ("speed = inf", "machine.speed: inf should be"),
        ("load = nan", "machine.load: nan should be a finite number"),
        ("margin = 0.5", "machine.margin: 0.5 should be greater than or equal to 1"),
        ('up = "w"', "machine.up: 'w' should be"),
        ("torque = 1", "unknown key 'torque'"),
        ("gear = 0", "machine.gear: 0 should be greater"),
    ],
)
def test_a_wrong_key_is_told_in_one_line(tmp_path: Path, table: str, said: str) -> None:
    with pytest.raises(DesignError) as caught:
        load(build_of(tmp_path, FOUR_BAR, table).path, host())
    assert said in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


def test_check_tells_it_as_json_with_a_change_that_was_tried(tmp_path: Path, command_line: Command) -> None:
    path = build_of(tmp_path, FOUR_BAR, 'load = 0.3\nmotor = "NEMA 17 - 34"').path
    code, out, _ = command_line("check", path, "--json")
    assert code == 1
    findings = {one["code"]: one for one in json.loads(out)["findings"]}
    assert findings["machine.motor"]["severity"] == "error"
    assert list(findings["machine.motor"]["fix"]) == ["machine.gear"]  # the motor is at hand
    assert findings["machine.torque"]["stage"] == "assembly"


@pytest.mark.parametrize(
    ("example", "table", "keys"),
    [
        (FOUR_BAR, 'motor = "37D 131:1"\nvoltage = 6', ["voltage"]),
        (FOUR_BAR, 'motor = "auto"\nvoltage = 6', []),
        (FOUR_BAR, 'motor = "NEMA 23 - 56"\nvoltage = 6\ngear = 2', []),
        (FOUR_BAR, "speed = 60\ngear = 2\nvoltage = 12\nmargin = 2", ["gear", "voltage"]),
        (FOUR_BAR, 'output = "follower"\nspeed = 60', ["output"]),
        (FOUR_BAR, 'output = "follower"\nload = 0.1\nmargin = 1.5\ngear = 1', []),
        (
            SLIDER,
            'bearing = "62"\nbearing_arrangement = "locating-free"\nplate_thickness = 20\nplate_material = "steel"\ncover = true\nguard = true\n'
            "axial_gap = 4\nplates = [10]",
            [
                "bearing",
                "bearing_arrangement",
                "plate_thickness",
                "plate_material",
                "cover",
                "guard",
                "axial_gap",
            ],
        ),
    ],
)
def test_a_key_that_changes_nothing_is_warned_of_by_its_name(
    tmp_path: Path, example: str, table: str, keys: list[str]
) -> None:
    build = build_of(tmp_path, example, table)
    warned = [one for one in MachineDrive().findings(build) if one.code == "machine.key"]
    assert sorted(one.parameter for one in warned) == sorted(f"machine.{key}" for key in keys)
    for one in warned:
        key = one.parameter.partition(".")[2]
        assert one.severity is Severity.WARNING
        assert one.remedy == f"leave {key} out"
        assert one.proposed == ({one.parameter: None},)
    left = build.design.content["machine"].keys() - keys
    kept = "\n".join(line for line in table.splitlines() if line.partition(" ")[0] in left)
    clean = build_of(tmp_path, example, kept)
    assert "machine.key" not in found(clean)


def test_speed_variation_says_nothing_of_a_lever(tmp_path: Path) -> None:
    table = "[machine]\nspeed = 20\nspeed_variation = 10\n\n[cam]"
    path = tmp_path / "lever.toml"
    said = (ROOT / "examples" / "five-bar-machine.toml").read_text(encoding="utf-8")
    path.write_text(re.sub(r"(?s)\[machine\].*?\[cam\]", table, said, count=1), encoding="utf-8")
    assert "speed_variation changes nothing" in found(Build(path, host()))["machine.key"]


@pytest.mark.parametrize(
    ("example", "free"),
    [("four-bar-machine", "none"), ("spherical-machine", "none"), ("geneva-machine", "plates")],
)
def test_a_frame_that_couples_its_motor_refuses_a_gear(tmp_path: Path, example: str, free: str) -> None:
    path = tmp_path / "design.toml"
    said = (ROOT / "examples" / f"{example}.toml").read_text(encoding="utf-8")
    path.write_text(said.replace("[machine]\n", "[machine]\ngear = 2\n", 1), encoding="utf-8")
    design = Build(path, host()).design
    (fault,) = (one for one in design.check() if one.severity is Severity.ERROR)
    assert (fault.code, fault.parameter, fault.value) == ("frame.gear", "machine.gear", 2.0)
    assert f'leave gear out, or set frame = "{free}"' in fault.remedy
    for change in fault.proposed:
        assert not [one for one in design.changed(change).check() if one.severity is Severity.ERROR]


def test_no_remedy_proposes_a_gear_where_the_frame_couples_the_motor(tmp_path: Path) -> None:
    path = tmp_path / "design.toml"
    said = (ROOT / "examples" / "four-bar-machine.toml").read_text(encoding="utf-8")
    for frame in ("base", "none"):
        table = said.replace('motor = "auto"', 'motor = "NEMA 17 - 34"').replace('"base"', f'"{frame}"')
        path.write_text(table, encoding="utf-8")
        (fault,) = (one for one in MachineDrive().findings(Build(path, host())) if one.proposed)
        assert ("gear it down" in fault.remedy) == (frame == "none")
        assert any("machine.gear" in change for change in fault.proposed) == (frame == "none")


def test_the_motor_that_is_proposed_for_a_weak_one_turns_evenly(tmp_path: Path) -> None:
    path = tmp_path / "design.toml"
    said = (ROOT / "examples" / "four-bar-machine.toml").read_text(encoding="utf-8")
    path.write_text(said.replace('motor = "auto"', 'motor = "37D 18.75:1"'), encoding="utf-8")
    build = Build(path, host())
    (fault,) = (one for one in MachineDrive().findings(build) if one.code == "machine.motor")
    changed = Build(build.design.changed(fault.proposed[-1]), host())
    assert {one.severity for one in MachineDrive().findings(changed)} == {Severity.NOTE}


@pytest.mark.parametrize("gap", [2, 4])
def test_a_motor_on_a_flange_has_no_axial_gap(tmp_path: Path, gap: int) -> None:
    path = tmp_path / "design.toml"
    said = (ROOT / "examples" / "spherical-machine.toml").read_text(encoding="utf-8")
    path.write_text(said.replace("[machine]\n", f"[machine]\naxial_gap = {gap}\n", 1), encoding="utf-8")
    warned = [one for one in Build(path, host()).design.check() if one.code == "machine.key"]
    assert [one.parameter for one in warned] == (["machine.axial_gap"] if gap == 4 else [])


@pytest.mark.parametrize("name", ["37D 50:1", "NEMA 17 - 34"])
def test_no_motor_is_proposed_that_its_flange_has_no_room_for(tmp_path: Path, name: str) -> None:
    """Of the motors that turn 0.6 N m evenly the only one is a NEMA 23, and the pillars stand too near."""
    path = tmp_path / "design.toml"
    said = (ROOT / "examples" / "spherical-machine.toml").read_text(encoding="utf-8")
    table = said.replace('motor = "auto"\nload = 0.2', f'motor = "{name}"\nload = 0.6')
    path.write_text(table, encoding="utf-8")
    build = Build(path, host())
    (fault,) = (
        one
        for one in MachineDrive().findings(build)
        if one.code in {"machine.speed", "machine.motor"} and one.proposed
    )
    assert "NEMA 23" not in fault.remedy
    assert fault.proposed
    for change in fault.proposed:
        assert not [one for one in build.design.changed(change).check() if one.severity is Severity.ERROR]


def test_a_mean_power_that_is_rounding_is_0_in_the_figures_as_in_the_finding(tmp_path: Path) -> None:
    """The crank of a slider with a constant force gets back in one half of the turn what it gives in the other."""
    build = Build(ROOT / "examples" / "slider-crank-machine.toml", host())
    assert json.loads(DrivePage().files(build)["drive.json"])["figures"]["mean_power"]["value"] == 0
    assert ", 0 W in the mean" in found(build)["machine.torque"]
