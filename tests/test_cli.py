"""The command line as a person meets it: exit codes, one-line errors, what is written and what is not."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

EXAMPLE = Path(__file__).parents[1] / "examples" / "elliptic-pair.toml"
Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def run(command_line: Run) -> Run:
    return command_line


def child(code: str) -> str:
    return subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout


HEAVY = {"numpy", "scipy", "shapely", "cadquery", "OCP", "ezdxf", "pydantic"}


def test_help_imports_nothing_heavy() -> None:
    loaded = child(
        "import sys\nsys.argv = ['mechwright', '--help']\nfrom mechwright.cli import main\n"
        "try:\n    main()\nexcept SystemExit:\n    pass\n"
        "print('MODULES', *{m.split('.')[0] for m in sys.modules})"
    )
    assert "build" in loaded
    assert not HEAVY & set(loaded.split("MODULES")[1].split())


def test_only_solids_import_the_cad_kernel(tmp_path: Path) -> None:
    """None of these commands does, also after the others."""
    lines = [
        ["families"],
        ["check", str(EXAMPLE)],
        ["solve", str(EXAMPLE), "-o", str(tmp_path / "solved")],
        ["cam", str(EXAMPLE), "-o", str(tmp_path / "cut")],
    ]
    done = child(
        f"import sys\nfrom mechwright.cli import main\nfor line in {lines!r}:\n"
        "    sys.argv = ['mechwright', *line]\n"
        "    try:\n        main()\n    except SystemExit as stop:\n        assert not stop.code, (line, stop.code)\n"
        "    found = {'cadquery', 'OCP'} & {m.split('.')[0] for m in sys.modules}\n"
        "    assert not found, (line, found)\n    print('CLEAN', line[0])"
    )
    assert done.count("CLEAN ") == len(lines)


def test_families_are_listed_with_their_distribution(run: Run) -> None:
    code, out, err = run("families")
    assert (code, err) == (0, "")
    assert "elliptic-gears  (mechwright)" in out
    assert "linuxcnc" in out
    code, out, _ = run("families", "--json")
    listing = json.loads(out)
    assert code == 0
    names = [
        "cam-follower",
        "elliptic-gears",
        "five-bar",
        "four-bar",
        "geneva",
        "linkage",
        "noncircular-gears",
        "plate",
        "slider-crank",
        "spherical",
        "spur-gears",
    ]
    assert [family["name"] for family in listing["families"]] == names
    assert {"step", "dxf", "stl", "3mf", "glb", "mjcf"} <= set(listing["formats"])


def test_a_new_design_file_builds_as_it_is(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "pair.toml"
    assert run("new", "elliptic-gears", "-o", path)[0] == 0
    code, out, err = run("check", path)
    assert (code, err) == (0, "")
    assert "can be built" in out
    code, _, err = run("new", "elliptic-gears", "-o", path)
    assert code == 2
    assert "is there already" in err
    assert run("new", "elliptic-gears")[1] == path.read_text()


def test_check_gives_every_finding_as_json(run: Run) -> None:
    code, out, _ = run("check", EXAMPLE, "--json")
    result = json.loads(out)
    assert code == 0
    assert result["ok"] is True
    assert {finding["severity"] for finding in result["findings"]} == {"note"}


def test_a_finding_of_severity_error_is_exit_code_1_and_writes_nothing(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "undercut.toml"
    path.write_text(EXAMPLE.read_text().replace("teeth = 25", "teeth = 13"))
    code, out, _ = run("check", path)
    assert code == 1
    assert "gear.undercut" in out
    assert "cannot be built" in out
    for command in ("model", "cam", "build"):
        code, _, err = run(command, path, "-o", tmp_path / "out")
        assert code == 1
        assert "gear.undercut" in err
        assert not (tmp_path / "out").exists()


BAD = {
    "unknown key": ("teeth = 25", "tooth = 25", "unknown key 'tooth'; did you mean 'teeth'?"),
    "wrong unit": ("semi_major = 50", "semi_major = '50 kg'", "'50 kg' cannot be read in mm"),
    "out of bounds": ("eccentricity = 0.4", "eccentricity = 1.5", "parameters.eccentricity: 1.5"),
    "broken TOML": ("teeth = 25", "teeth = ", "is no valid TOML"),
    "missing tool": ("[cam]", "[cam]\ntools = ['end-mill-7']", "bad.toml: cam.tools: no tool 'end-mill-7'"),
    "missing library": ("[cam]", "[cam]\ntool_library = 'none.toml'", "none.toml: cannot be read"),
    "unknown control": (
        "linuxcnc",
        "heidenhain",
        "cam.control: control 'heidenhain' is not installed; known: fanuc, grbl",
    ),
    "unknown family": ("elliptic-gears", "eliptic-gears", "family 'eliptic-gears' is not installed"),
    "unknown material": ("aluminium", "cheese", "'cheese'"),
}


@pytest.mark.parametrize(("old", "new", "said"), BAD.values(), ids=BAD.keys())
def test_bad_input_is_one_line_exit_code_2_and_nothing_written(
    run: Run, tmp_path: Path, old: str, new: str, said: str
) -> None:
    path = tmp_path / "bad.toml"
    assert old in EXAMPLE.read_text()
    path.write_text(EXAMPLE.read_text().replace(old, new, 1))
    code, out, err = run("build", path, "-o", tmp_path / "out")
    assert code == 2
    assert said in err
    assert len(err.splitlines()) == 1
    assert out == ""
    assert {entry.name for entry in tmp_path.iterdir()} == {"bad.toml"}


def test_an_unwritable_folder_is_one_line(run: Run, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("x")
    code, _, err = run("solve", EXAMPLE, "-o", tmp_path / "file" / "below")
    assert code == 2
    assert "cannot be written" in err
    assert len(err.splitlines()) == 1
    code, _, err = run("solve", EXAMPLE, "-o", tmp_path)
    assert code == 2
    assert "has not written" in err
    assert (tmp_path / "file").read_text() == "x"


def test_solve_honours_the_number_of_samples(run: Run, tmp_path: Path) -> None:
    assert run("solve", EXAMPLE, "-o", tmp_path / "o", "--samples", 9)[0] == 0
    lines = (tmp_path / "o" / "motion.csv").read_text().splitlines()
    assert len(lines) == 10
    assert lines[0].startswith("time [s],") or lines[0].startswith("theta2 [rad],")
    summary = json.loads((tmp_path / "o" / "summary.json").read_text())
    assert all({"value", "unit"} == set(entry) for entry in summary.values())


def test_a_build_is_complete_and_the_same_every_time(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where no second process makes the solids."""
    for folder, found in (("one", 2), ("two", 1)):
        monkeypatch.setattr("mechwright_cad.solid_models.available_cores", lambda found=found: found)
        code, _, err = run("build", EXAMPLE, "-o", tmp_path / folder)
        assert (code, err) == (0, "")
    one, two = tmp_path / "one", tmp_path / "two"
    names = sorted(path.name for path in one.iterdir())
    assert names == sorted(
        [
            "motion.csv",
            "motion.html",
            "tolerances.html",
            "as-made.html",
            "as-made.json",
            "gear-as-made.dxf",
            "summary.json",
            "gear.step",
            "assembly.step",
            "bill-of-materials.csv",
            "bill-of-materials.html",
            "assembly.html",
            "assembly-drawing.dxf",
            "assembly-drawing.pdf",
            "gear.dxf",
            "gear-drawing.dxf",
            "gear-drawing.pdf",
            "gear.nc",
            "tool.tbl",
            "proof.json",
            "gear.certificate.json",
            "gear.setup.html",
            "gear.job.html",
            "setup.html",
            "manifest.json",
        ]
    )
    for name in names:
        assert (one / name).read_bytes() == (two / name).read_bytes(), name
    proof = json.loads((one / "proof.json").read_text())["gear"]
    assert proof["gouge_max_mm"] <= 0.005
    assert proof["leftover_reachable_max_mm"] <= 0.010
    assert proof["rapids_in_stock"] == 0
    assert all(check["passed"] for check in proof["checks"].values())
    assert proof["time_estimate_s"] > 60


def test_verify_accepts_the_program_it_has_written(run: Run, tmp_path: Path) -> None:
    assert run("cam", EXAMPLE, "-o", tmp_path / "o")[0] == 0
    program = tmp_path / "o" / "gear.nc"
    code, _, err = run("verify", program, "--design", EXAMPLE, "--part", "gear")
    assert (code, err) == (0, "")
    code, _, err = run("verify", program, "--design", EXAMPLE, "--part", "wheel")
    assert code == 2
    assert "'wheel' is no part" in err
    assert "gear" in err
    code, _, err = run("verify", tmp_path / "none.nc", "--design", EXAMPLE, "--part", "gear")
    assert code == 2
    assert "cannot be read" in err


def test_verify_reads_the_files_of_one_program_in_order(run: Run, tmp_path: Path) -> None:
    path, out = tmp_path / "d.toml", tmp_path / "o"
    text = 'format = 1\nfamily = "geneva"\nname = "gen"\n[cam]\ncontrol = "grbl"\n[cam.machine]\n'
    path.write_text(text + "retract_z = -2\n")
    assert run("cam", path, "-o", out)[0] == 0
    files = sorted(out.glob("wheel-*.nc"))
    assert len(files) > 2
    rest = ("--design", path, "--part", "wheel")
    code, said, err = run("verify", *files, *rest)
    assert (code, err) == (0, "")
    assert said.splitlines()[-1] == f"{files[0]} to {files[-1]}: proven"
    assert run("verify", *files[:-1], *rest)[0] == 1
    code, _, err = run("verify", files[0], *files, *rest)
    assert code == 2
    assert "a file is named twice" in err
    files[1].write_text("G21\nG1 X1..2\nM30\n")
    code, _, err = run("verify", *files, *rest)
    assert code == 2
    assert err.startswith(f"mechwright: {files[1]}: line 2: "), err


def test_the_real_command_in_a_pipe_shows_no_progress_bar(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "mechwright", "solve", str(EXAMPLE), "-o", str(tmp_path / "o")],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONWARNINGS": "error"},
    )
    assert done.stderr == ""
    assert "motion.csv" in done.stdout


def test_a_program_with_comments_of_an_older_encoding_is_read(run: Run, tmp_path: Path) -> None:
    program = tmp_path / "old.nc"
    program.write_bytes(b"(Fr\xe4ser 6 mm, 90\xb0)\nG21 G90\nM30\n")
    code, out, _ = run("verify", program, "--design", EXAMPLE, "--part", "gear")
    assert code == 1
    assert "does not cut the part" in out
    program.write_bytes(b"\x7fELF\x00\xff\x00")
    code, _, err = run("verify", program, "--design", EXAMPLE, "--part", "gear")
    assert code == 2
    assert "old.nc: is no UTF-8 text" in err
    program.write_text("G21\nG92 X0\nM30\n")
    code, _, err = run("verify", program, "--design", EXAMPLE, "--part", "gear")
    assert code == 2
    assert "old.nc: line 2: " in err


def test_verify_names_the_file_and_the_key_of_a_tool_that_is_not_there(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "d.toml"
    path.write_text(EXAMPLE.read_text().replace("[cam]", "[cam]\ntools = ['mill-7']"))
    (tmp_path / "p.nc").write_text("M30\n")
    code, _, err = run("verify", tmp_path / "p.nc", "--design", path, "--part", "gear")
    assert code == 2
    assert "d.toml: cam.tools: no tool 'mill-7'" in err


def test_a_finding_is_said_once(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "d.toml"
    path.write_text(EXAMPLE.read_text().replace("[cam]", "[cam]\ntools = ['drill-3']"))
    code, out, _ = run("check", path)
    assert code == 1
    said = [line for line in out.splitlines() if line.startswith("error")]
    assert said
    assert len(said) == len(set(said))


def test_the_help_of_no_command_is_cut_short(run: Run) -> None:
    code, out, _ = run("--help")
    assert code == 0
    assert "verify" in out
    assert not [line for line in out.splitlines() if line.endswith("...") and "Usage" not in line]


def test_a_folder_that_cannot_be_written_is_refused_before_the_work(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "foreign").write_text("x")
    monkeypatch.setattr("mechwright.designs.design.load", lambda *_: pytest.fail("worked"))
    monkeypatch.setattr("mechwright.pipeline.Build.findings", property(lambda _: pytest.fail("worked")))
    assert run("build", EXAMPLE, "-o", tmp_path)[0] == 2


def test_verify_reads_a_program_as_its_control_does(run: Run, tmp_path: Path) -> None:
    design = tmp_path / "pair.toml"
    design.write_text(EXAMPLE.read_text().replace('"linuxcnc"', '"fanuc"'))
    code, _, err = run("cam", design, "-o", tmp_path / "out")
    assert code == 0, err
    program = tmp_path / "out" / "gear.nc"
    assert program.read_text().startswith("%\nO0001 (GEAR)\n")
    assert run("verify", program, "--design", design, "--part", "gear")[0] == 0
    assert run("verify", program, "--design", EXAMPLE, "--part", "gear", "--control", "fanuc")[0] == 0
    code, _, err = run("verify", program, "--design", EXAMPLE, "--part", "gear")
    assert (code, "nothing bounds how far LinuxCNC leaves the path" in err) == (1, True)
    code, _, err = run("verify", program, "--design", EXAMPLE, "--part", "gear", "--control", "siemens")
    assert (code, "--control: 'siemens' is not known; one of: fanuc, grbl" in err) == (2, True)
