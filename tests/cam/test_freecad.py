"""The add-on for FreeCAD: FreeCAD itself opens machines by it, and its panel writes what the command writes."""

import ast
import json
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night, in_ci

from mechwright_cad.freecad import install

ROOT = Path(__file__).parents[2]
HERE = Path(__file__).parent
FREECAD, CONSOLE, XVFB = shutil.which("freecad"), shutil.which("freecadcmd"), shutil.which("xvfb-run")
SYSTEM = "/usr/bin:/bin"
MACHINES = (
    "elliptic-pair-machine",
    "geneva-machine",
    "four-bar-machine",
    "cam-lever-machine",
    "figure-eight-machine",
)
needs_freecad = pytest.mark.skipif(
    CONSOLE is None, reason="FreeCAD is not installed (Debian package freecad)"
)
needs_window = pytest.mark.skipif(
    FREECAD is None or XVFB is None, reason="FreeCAD or Xvfb is not installed (Debian packages freecad, xvfb)"
)


def freecad(words, case, folder):
    """The answer of a script that runs inside FreeCAD, with FreeCAD's own Python and a home of its own."""
    (folder / "case.json").write_text(json.dumps(case))
    ours = {"PYTHONPATH", "VIRTUAL_ENV", "PYTHONHOME"}
    done = subprocess.run(
        words,
        env={
            **{key: value for key, value in os.environ.items() if key not in ours},
            "PATH": SYSTEM,
            "HOME": str(folder),
            "QTWEBENGINE_DISABLE_SANDBOX": "1",  # its start page will not run as root otherwise
            "MECHWRIGHT_FREECAD": str(folder / "case.json"),
        },
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=500,
        check=False,
    )
    answer = Path(case["answer"])
    assert answer.exists(), f"{done.stdout[-1000:]}{done.stderr[-1000:]}"
    return json.loads(answer.read_text())


def opened(folders, folder):
    case = {
        "addon": str(install.ADDON),
        "folders": [str(one) for one in folders],
        "answer": str(folder / "answer.json"),
    }
    return freecad([CONSOLE, str(HERE / "freecad_bodies.py")], case, folder)


def instances(step):
    """Names of the bodies in a STEP file, in order, by its own words."""
    return re.findall(r"NEXT_ASSEMBLY_USAGE_OCCURRENCE\(\s*'\d+',\s*'([^']*)'", step.read_text())


def modelled(command_line, name, folder):
    code, _, err = command_line("model", ROOT / "examples" / f"{name}.toml", "-o", folder, "--also", "glb")
    assert code == 0, err
    return folder


@in_ci
@needs_freecad
def test_the_gears_turn_about_their_foci(command_line, tmp_path):
    found = opened([modelled(command_line, "elliptic-pair", tmp_path / "pair")], tmp_path)[
        str(tmp_path / "pair")
    ]
    assert found["names"] == ["gear-2", "gear-4"] == instances(tmp_path / "pair" / "assembly.step")
    assert found["solids"] == [1, 1]
    (first, other), (turned, opposed) = np.array(found["centres"])
    # The driver turns evenly about the origin, the driven gear about (100, 0) the other way.
    angle = math.tau * found["share"]
    turn = np.array(
        [[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1]]
    )
    np.testing.assert_allclose(turned, turn @ first, atol=1e-3)
    assert np.linalg.norm(opposed - (100, 0, 5)) == pytest.approx(
        np.linalg.norm(other - (100, 0, 5)), abs=1e-3
    )
    way = math.atan2(opposed[1], opposed[0] - 100) - math.atan2(other[1], other[0] - 100)
    # tan(b/2) = (1 + e)/(1 - e) tan(a/2) of ellipses about their foci, with e = 0.4 and a = 0 where it is fastest.
    assert way == pytest.approx(-2 * math.atan(1.4 / 0.6 * math.tan(angle / 2)), abs=1e-4)


@by_night
@needs_freecad
def test_machines_have_all_their_bodies_under_their_names(command_line, tmp_path):
    folders = [modelled(command_line, name, tmp_path / name) for name in MACHINES]
    found = opened(folders, tmp_path)
    for folder in folders:
        one = found[str(folder)]
        names = instances(folder / "assembly.step")
        assert one["names"] == names
        assert len(names) == len(set(names)) > 30
        assert min(one["solids"]) == 1
        assert min(one["volumes"]) > 0
        still, moved = np.array(one["centres"])
        assert 0 < np.count_nonzero(np.linalg.norm(moved - still, axis=1) > 1e-6) < len(names)


@in_ci
@needs_window
def test_the_panel_shows_the_design_and_writes_the_bytes_of_the_command(command_line, tmp_path):
    design = ROOT / "examples" / "elliptic-pair.toml"
    (tmp_path / "Mod").mkdir()
    assert command_line("freecad", tmp_path / "Mod")[0] == 0
    addon = tmp_path / "Mod" / install.NAME
    paths = [str(ROOT / one) for one in ("core", "cam", "plugins")]
    ours = f"import sys; sys.path[:0] = {paths}; from mechwright.__main__ import program; sys.exit(program())"
    (addon / install.COMMAND).write_text(json.dumps([sys.executable, "-c", ours]))
    case = {
        "addon": str(addon),
        "design": str(design),
        "output": str(tmp_path / "theirs"),
        "answer": str(tmp_path / "answer.json"),
        "picture": str(tmp_path / "panel.png"),
    }
    script = str(HERE / "freecad_panel.py")
    found = freecad([XVFB, "-a", "-s", "-screen 0 1280x900x24", FREECAD, script], case, tmp_path)
    assert "error" not in found, found["error"]
    assert found["commands"] == ["Mechwright_Design"]
    code, (said, end) = found["missing"]
    assert code == 2
    assert said.startswith(f"mechwright: {design}.none: cannot be read")
    assert end == "It ended with exit code 2; nothing was written."
    assert found["shown"] == 0
    assert found["names"] == ["gear-2", "gear-4"]
    assert found["colours"][0] != found["colours"][1]
    assert found["without a folder"] == "Choose a folder for the programs."
    assert found["written"] == 0
    assert command_line("cam", design, "-o", tmp_path / "ours")[0] == 0
    ours, theirs = (
        {one.name: one.read_bytes() for one in (tmp_path / name).iterdir()} for name in ("ours", "theirs")
    )
    assert ours == theirs
    assert (tmp_path / "panel.png").stat().st_size > 10_000


def test_the_add_on_is_installed_once_and_replaced_only_by_force(command_line, tmp_path):
    code, out, _ = command_line("freecad", tmp_path)
    assert (code, out) == (
        0,
        f"{tmp_path / 'Mechwright'}: written; start FreeCAD, and choose the workbench Mechwright\n",
    )
    names = {one.name for one in (tmp_path / "Mechwright").iterdir()}
    assert names == {one.name for one in install.ADDON.iterdir() if one.is_file()} | {install.COMMAND}
    said = json.loads((tmp_path / "Mechwright" / install.COMMAND).read_text())
    assert said == [sys.executable, "-m", "mechwright"]
    assert command_line("freecad", tmp_path)[0] == 0
    (tmp_path / "Mechwright" / "InitGui.py").write_text("# mine\n")
    code, _, err = command_line("freecad", tmp_path)
    assert (code, err) == (
        2,
        f"mechwright: {tmp_path / 'Mechwright'}: has another version (InitGui.py); --force to replace it\n",
    )
    assert command_line("freecad", tmp_path, "--force")[0] == 0
    assert (tmp_path / "Mechwright" / "InitGui.py").read_bytes() == (
        install.ADDON / "InitGui.py"
    ).read_bytes()


def test_a_folder_that_is_not_there_is_one_line(command_line, tmp_path, monkeypatch):
    code, _, err = command_line("freecad", tmp_path / "none")
    assert code == 2
    assert err.startswith(
        f"mechwright: {tmp_path / 'none'}: is no folder; start FreeCAD once, or name the folder Mod"
    )
    assert len(err.splitlines()) == 1


def test_the_users_own_folder_is_taken_by_default(command_line, tmp_path, monkeypatch):
    monkeypatch.setattr(install, "user_data_path", lambda name, **_: tmp_path / name)
    assert command_line("freecad")[0] == 2
    (tmp_path / "FreeCAD").mkdir()
    assert command_line("freecad")[0] == 0
    assert (tmp_path / "FreeCAD" / "Mod" / "Mechwright" / "InitGui.py").is_file()


def test_the_add_on_is_of_a_python_that_older_freecads_have():
    for path in sorted(install.ADDON.glob("*.py")):
        ast.parse(path.read_text(encoding="utf-8"), feature_version=(3, 8))
