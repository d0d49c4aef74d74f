"""Tables [cam.part.NAME]: settings of one part over those of the job."""

import json

import pytest
from typer.testing import CliRunner

from mechwright.cli.app import make_app
from mechwright.designs.design import load
from mechwright.errors import DesignError
from mechwright.plugins.host import host
from mechwright_cam.shop.part_settings import WHOLE_JOB
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.table import settings_of

HEAD = 'format = 1\nfamily = "elliptic-gears"\nname = "pair"\n[parameters]\nteeth = 21\n'


def design(tmp_path, text):
    file = tmp_path / "pair.toml"
    file.write_text(HEAD + text)
    return file


OVERRIDES = {
    "sheet": {"revision": "B"},
    "fitting_marks": True,
    "probe": {"tool": 99, "diameter": 4.0},
    "setter": {"x": -10.0, "y": -20.0, "over": 40.0},
    "work_offset": "G57",
    "more_offsets": ["G58", "G59"],
    "origin": "corner",
    "tools": ["mill-3"],
    "operations": ["adaptive"],
    "cutting": {"mill-3": {"step_down": 0.3}},
    "climb": False,
    "coolant": "off",
    "clearance": 9.0,
    "breakthrough": 0.5,
    "stock_to_leave": 0.1,
    "floor_to_leave": 0.05,
    "compensation": "wear",
    "wear_limit": 0.05,
    "path": {"outer_tolerance": 0.005},
    "spring_passes": 2,
    "finish_step": 1.5,
    "ramp_angle": 2.0,
    "corner_mill": 3.0,
    "chip_thinning": False,
    "clearing": "adaptive",
    "outsides": "faster",
    "engagement": 70.0,
    "adaptive_depth": 1.0,
    "machine": {"rapid": 7777.0},
    "second_side": {"flip": "y"},
    "measured": {"lengths": {"mill-3": 60.0}},
    "stock": {"margin": 21.0},
    "hold": {"tabs": 3},
    "deburr": 0.2,
    "mark": "MW-25",
    "mark_height": 3.0,
    "mark_depth": 0.1,
    "mark_line": 0.5,
}


def toml(key, value, where):
    if isinstance(value, dict):
        inner = ", ".join(f"{k} = {toml_value(v)}" for k, v in value.items())
        return f"[{where}]\n{key} = {{ {inner} }}\n"
    return f"[{where}]\n{key} = {toml_value(value)}\n"


def toml_value(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {toml_value(v)}" for k, v in value.items()) + " }"
    return json.dumps(value)


def given_keys():
    return sorted(set(CamSettings.model_fields) - set(WHOLE_JOB))


@pytest.mark.parametrize("key", given_keys())
def test_every_key_holds_for_the_part_and_for_no_other(key, tmp_path):
    assert key in OVERRIDES, "a new key of [cam]: add a value that is not its default"
    text = toml(key, OVERRIDES[key], "cam.part.gear")
    found = load(design(tmp_path, text), host())
    own, job = settings_of(found).of("gear"), settings_of(found).of("another")
    assert job == CamSettings()
    assert getattr(own, key) != getattr(job, key)
    rest = {name for name in CamSettings.model_fields if name != key}
    assert all(getattr(own, name) == getattr(job, name) for name in rest)


def test_a_table_lies_over_the_job_key_by_key(tmp_path):
    text = "[cam]\nclearance = 8\n[cam.hold]\ntabs = 6\ntab_width = 1.5\n[cam.part.gear.hold]\ntabs = 3\n"
    found = load(design(tmp_path, text), host())
    assert (settings_of(found).of("gear").hold.tabs, settings_of(found).of("gear").hold.tab_width) == (3, 1.5)
    assert settings_of(found).of("gear").clearance == 8
    assert settings_of(found).cam.hold.tabs == 6


@pytest.mark.parametrize(
    ("job", "own", "left"),
    [
        ("margin = 30", "length = 200\nwidth = 210", (None, 200, 210)),
        ("length = 200\nwidth = 210", "margin = 30", (30, None, None)),
    ],
)
def test_a_margin_and_a_size_put_each_other_out(job, own, left, tmp_path):
    found = load(design(tmp_path, f"[cam.stock]\n{job}\n[cam.part.gear.stock]\n{own}\n"), host())
    stock = settings_of(found).of("gear").stock
    assert (stock.margin, stock.length, stock.width) == left


@pytest.mark.parametrize("key", WHOLE_JOB)
def test_keys_of_the_whole_job_are_refused(key, tmp_path):
    with pytest.raises(
        DesignError, match=rf"cam\.part\.gear\.{key}: holds for the whole job; set it in \[cam\]"
    ):
        load(design(tmp_path, f'[cam.part.gear]\n{key} = "x"\n'), host())


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "[cam.part.gear]\ncoolantt = 1\n",
            r"cam\.part\.gear: unknown key 'coolantt'; did you mean 'coolant'",
        ),
        (
            "[cam.part.gear.hold]\ntabs = 1\n",
            r"cam\.part\.gear\.hold\.tabs: 1 should be greater than or equal to 2",
        ),
        ("[cam]\npart = 3\n", r"cam\.part: is 3; write a table \[cam\.part\.NAME\]"),
        ("[cam.part]\ngear = 3\n", r"cam\.part\.gear: is 3; write a table"),
    ],
)
def test_mistakes_are_told_with_their_place(text, message, tmp_path):
    with pytest.raises(DesignError, match=message):
        load(design(tmp_path, text), host())


@pytest.mark.parametrize("command", ["check", "cam"])
def test_a_name_of_no_part_lists_the_parts(command, tmp_path):
    file = design(tmp_path, '[cam.part.wheel]\norigin = "corner"\n')
    words = [command, str(file)] + (["-o", str(tmp_path / "out")] if command == "cam" else [])
    done = CliRunner().invoke(make_app(), words)
    assert done.exit_code != 0
    message = done.output + str(done.exception or "")
    assert "cam.part.wheel: no plate part has this name; there is: gear" in message
    assert not (tmp_path / "out").exists()


def test_the_program_is_that_of_the_part(tmp_path):
    file = design(
        tmp_path, '[cam]\nwork_offset = "G54"\n[cam.part.gear]\nwork_offset = "G56"\norigin = "corner"\n'
    )
    done = CliRunner().invoke(make_app(), ["cam", str(file), "-o", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    program = (tmp_path / "out" / "gear.nc").read_text()
    assert "G56" in program
    assert "G54" not in program
    assert "origin: lower left corner of the stock" in program
    verified = CliRunner().invoke(
        make_app(), ["verify", str(tmp_path / "out" / "gear.nc"), "--design", str(file), "--part", "gear"]
    )
    assert verified.exit_code == 0, verified.output


def test_a_new_design_file_shows_the_table():
    done = CliRunner().invoke(make_app(), ["new", "elliptic-gears", "--all"])
    assert "# [cam.part.NAME]" in done.output
