"""Programs on their way to the machine: those alone whose certificates hold, whole, and read back."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from certificates import written
from machine_servers import Card, Loader, serving

from mechwright import extras
from mechwright.errors import DesignError
from mechwright_cam.senders import certified as held
from mechwright_cam.senders.target import target

WRITTEN = "profile-outside"


@pytest.fixture
def made(tmp_path):
    """A Grbl program with its certificate; the folder has nothing else."""
    folder = tmp_path / "out"
    folder.mkdir()
    certificate = written(folder, WRITTEN, "grbl")
    return sorted(folder.glob("*.nc")), certificate


@pytest.fixture
def watched(tmp_path):
    folder = tmp_path / "watched"
    folder.mkdir()
    return folder


@pytest.fixture
def sent(command_line):
    def call(*words):
        code, out, err = command_line("send", *words)
        return code, out, [line for line in err.splitlines() if not line.startswith("note: ")]

    return call


def held_alike(folder: Path, programs: list[Path]) -> bool:
    return {one.name: one.read_bytes() for one in folder.iterdir()} == {
        one.name: one.read_bytes() for one in programs
    }


def test_a_folder_gets_the_bytes_of_the_program_and_nothing_else(made, watched, sent):
    programs, certificate = made
    code, out, err = sent(certificate, "--to", watched)
    assert (code, err) == (0, [])
    assert out.splitlines() == [f"{watched / one.name}: written" for one in programs]
    assert held_alike(watched, programs)
    assert sent(*programs, "--to", watched)[1] == "".join(
        f"{watched / one.name}: is there already\n" for one in programs
    )


def test_another_file_of_that_name_is_replaced_only_by_force(made, watched, sent):
    programs, _ = made
    (watched / programs[0].name).write_text("G0 X0\nM30\n")
    code, _, err = sent(programs[0], "--to", watched)
    assert (code, len(err)) == (2, 1)
    assert "--force to replace it" in err[0]
    assert (watched / programs[0].name).read_text() == "G0 X0\nM30\n"
    assert sent(programs[0], "--to", watched, "--force")[0] == 0
    assert held_alike(watched, programs[:1])


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda nc, _: nc.write_bytes(nc.read_bytes().replace(b"X1", b"X2", 1)), "its hash is another"),
        (lambda _, one: one.write_text(one.read_text().replace('"gouge":5', '"gouge":6', 1)), "its seal"),
        (lambda _, one: one.write_text(one.read_text()[:100]), "is no whole certificate"),
        (lambda _, one: one.unlink(), "beside it names it"),
    ],
)
def test_nothing_is_sent_whose_certificate_does_not_hold(made, watched, sent, spoil, said):
    programs, certificate = made
    spoil(programs[0], certificate)
    code, out, err = sent(programs[0], "--to", watched)
    assert code != 0
    assert out == ""
    assert len(err) == 1
    assert "not sent" in err[0]
    assert said in err[0]
    assert not list(watched.iterdir())


def test_what_the_checker_cannot_check_is_not_sent(tmp_path, watched, sent):
    certificate = written(tmp_path, WRITTEN, "grbl", lambda content: content.update(unchecked=["threads"]))
    code, _, err = sent(certificate, "--to", watched)
    assert code != 0
    assert err[0].endswith("not checkable: the certificate does not hold threads")
    assert not list(watched.iterdir())


def test_a_program_that_changes_after_the_check_is_not_sent(made, watched, sent, monkeypatch):
    programs, certificate = made
    check = held._checked

    def checked(*words):
        said = check(*words)
        programs[0].write_bytes(programs[0].read_bytes() + b"G0 X999\n")
        return said

    monkeypatch.setattr(held, "_checked", checked)
    code, _, err = sent(certificate, "--to", watched)
    assert (code, err) == (
        2,
        [f"mechwright: {certificate}: not sent: program or certificate changed meanwhile; try again"],
    )
    assert not list(watched.iterdir())


def test_a_checker_that_is_missing_is_named_with_the_line_that_installs_it(made, watched, sent, monkeypatch):
    monkeypatch.setattr(held, "find_spec", lambda _: None)
    monkeypatch.setattr(held.shutil, "which", lambda _: None)
    code, _, err = sent(made[1], "--to", watched)
    line = extras.distribution_line("mechwright-check", "cam/mechwright_check")
    assert (code, err) == (
        2,
        [f"mechwright: send: mechwright-check, which checks certificates, is not installed: {line}"],
    )
    folder = Path(line.split()[-1])
    assert (folder / "pyproject.toml").is_file()


def test_a_checker_on_the_path_serves_as_well(made, watched, sent, monkeypatch):
    monkeypatch.setattr(held, "find_spec", lambda _: None)
    monkeypatch.setattr(held.shutil, "which", lambda _: sys.executable)
    code, _, err = sent(made[1], "--to", watched)
    assert code != 0
    assert "the checker says: exit code" in err[0]  # an interpreter that is given JSON


@pytest.mark.skipif(
    sys.platform == "win32" or os.geteuid() == 0, reason="rights of POSIX, which root does not mind"
)
def test_a_folder_that_is_read_only_is_an_error(made, watched, sent):
    watched.chmod(0o500)
    code, _, err = sent(made[1], "--to", watched)
    assert (code, err) == (2, [f"mechwright: --to: {watched}: cannot be written; name a folder of yours"])


@pytest.mark.parametrize(
    ("where", "said"),
    [
        ("none", "none: is no folder"),
        ("ftp://host", "ftp:// is not known"),
        ("fluidnc://", "write fluidnc://HOST"),
        ("fluidnc://host:x", "write fluidnc://HOST"),
        ("fluidnc://host/../localfs", "'..' is no name of a folder"),
        ("fluidnc://host/a%0d%0ab", "is no name of a folder"),
        ("cncjs://me:secret@host", "write cncjs://HOST"),
        ("cncjs://host?x=1", "write cncjs://HOST"),
    ],
)
def test_an_address_that_is_wrong_is_one_line(made, sent, where, said):
    code, _, err = sent(made[1], "--to", where)
    assert (code, len(err)) == (2, 1)
    assert said in err[0]


def test_a_port_is_only_of_cncjs(tmp_path):
    with pytest.raises(DesignError, match="--port: only with"):
        target(str(tmp_path), "COM3")


def test_a_drive_is_no_scheme():
    with pytest.raises(OSError, match="is no folder"):
        target("C://programs")


def test_a_program_of_another_control_does_not_go_to_a_grbl_machine(tmp_path, sent):
    code, _, err = sent(written(tmp_path, WRITTEN, "linuxcnc"), "--to", "fluidnc://127.0.0.1:1")
    assert code == 2
    assert "is for the control linuxcnc; fluidnc://127.0.0.1:1 reads programs for grbl" in err[0]


def test_a_machine_that_is_off_is_one_line(made, sent):
    for scheme, name in (("fluidnc", "FluidNC"), ("cncjs", "cncjs")):
        code, _, err = sent(made[0][0], "--to", f"{scheme}://127.0.0.1:1")
        assert (code, err) == (2, [f"mechwright: 127.0.0.1:1: {name} cannot be reached: Connection refused"])


def test_fluidnc_gets_the_file_on_its_card(made, sent):
    program = made[0][0]
    with serving(Card, files={}, room=10**9) as (card, address):
        where = f"fluidnc://{address}/jobs/a b"
        code, out, err = sent(program, "--to", where)
        assert (code, err) == (0, [])
        assert out == f"{address}/sd/jobs/a b/{program.name}: written\n"
        assert card.files == {f"/jobs/a b/{program.name}": program.read_bytes()}
        assert "is there already" in sent(program, "--to", where)[1]
        card.files[f"/jobs/a b/{program.name}"] = b"M30\n"
        code, _, err = sent(program, "--to", where)
        assert code == 2
        assert "--force to replace it" in err[0]
        assert card.files == {f"/jobs/a b/{program.name}": b"M30\n"}
        assert sent(program, "--to", where, "--force")[0] == 0
        assert card.files == {f"/jobs/a b/{program.name}": program.read_bytes()}


@pytest.mark.parametrize(
    ("fault", "said"),
    [
        ("no card", "FluidNC refuses it: No SD card"),
        ("locked", "FluidNC asks for a name and a password, or refuses them"),
        ("short", "FluidNC holds another file than was sent: do not run it"),
    ],
)
def test_what_fluidnc_refuses_or_spoils_is_one_line(made, sent, fault, said):
    with serving(Card, files={}, room=10**9, fault=fault) as (_, address):
        code, out, err = sent(made[0][0], "--to", f"fluidnc://{address}")
    assert (code, out, len(err)) == (2, "", 1)
    assert said in err[0]


def test_a_card_that_is_full_is_one_line(made, sent):
    with serving(Card, files={}, room=10) as (_, address):
        code, _, err = sent(made[0][0], "--to", f"fluidnc://{address}")
    assert (code, err) == (2, [f"mechwright: {address}: FluidNC refuses it: Upload failed"])


def test_another_server_is_told_from_the_machine(made, sent):
    with serving(Card, files={"/api/signin": b""}, room=1) as (_, address):
        code, _, err = sent(made[0][0], "--to", f"cncjs://{address}")
        assert (code, err) == (2, [f"mechwright: {address}: cncjs refuses it: HTTP 404"])
    with serving(Loader, loaded={"/dev/ttyUSB0": ("", "")}, user="") as (_, address):
        code, _, err = sent(made[0][0], "--to", f"fluidnc://{address}")
        assert (code, err) == (2, [f"mechwright: {address}: FluidNC refuses it: HTTP 404"])


def test_cncjs_loads_one_file_on_the_machine_that_is_open(made, sent):
    program = made[0][0]
    with serving(Loader, loaded={"/dev/ttyUSB0": ("", "")}, user="") as (cncjs, address):
        code, out, err = sent(program, "--to", f"cncjs://{address}")
        assert (code, err) == (0, [])
        assert out == f"{address}: {program.name} loaded on /dev/ttyUSB0\n"
        name, text = cncjs.loaded["/dev/ttyUSB0"]
        assert name == program.name
        assert text.startswith(program.read_text())
        assert "is loaded already" in sent(program, "--to", f"cncjs://{address}")[1]
        cncjs.loaded["/dev/ttyUSB0"] = ("other.nc", "M30\n")
        code, _, err = sent(program, "--to", f"cncjs://{address}")
        assert code == 2
        assert err[0].endswith(
            "other.nc is loaded on /dev/ttyUSB0; unload it there, or --force to replace it"
        )
        assert sent(program, "--to", f"cncjs://{address}", "--force")[0] == 0
        assert cncjs.loaded["/dev/ttyUSB0"][0] == program.name


@pytest.mark.parametrize(
    ("state", "words", "said"),
    [
        ({"loaded": {}}, (), "has no machine open: open its port there first"),
        ({"loaded": {"a": ("", ""), "b": ("", "")}}, (), "add --port with one of: a, b"),
        ({"loaded": {"a": ("", "")}}, ("--port", "c"), "has c not open; open are: a"),
        ({"loaded": {"a": ("", "")}, "user": "me:secret"}, (), "set MECHWRIGHT_CNCJS=NAME:PASSWORD"),
        ({"loaded": {"a": ("", "")}, "fault": "short"}, (), "gives back another program"),
    ],
)
def test_what_cncjs_refuses_or_spoils_is_one_line(made, sent, state, words, said):
    with serving(Loader, **{"user": "", **state}) as (_, address):
        code, out, err = sent(made[0][0], "--to", f"cncjs://{address}", *words)
    assert (code, out, len(err)) == (2, "", 1)
    assert said in err[0]


def test_cncjs_with_users_and_machines(made, sent, monkeypatch):
    monkeypatch.setenv("MECHWRIGHT_CNCJS", "me:secret")
    loaded = {"a": ("", ""), "b": ("", "")}
    with serving(Loader, loaded=loaded, user="me:secret") as (cncjs, address):
        assert sent(made[0][0], "--to", f"cncjs://{address}", "--port", "b")[0] == 0
        assert [name for name, _ in cncjs.loaded.values()] == ["", made[0][0].name]
        monkeypatch.setenv("MECHWRIGHT_CNCJS", "me")
        assert "write NAME:PASSWORD" in sent(made[0][0], "--to", f"cncjs://{address}")[2][0]


def test_a_program_of_several_files_goes_to_a_folder_whole_and_to_cncjs_by_file(tmp_path, watched, sent):
    certificate = written(tmp_path, "rest", "grbl")
    names = [file["name"] for file in json.loads(certificate.read_text())["files"]]
    assert len(names) > 1
    code, _, err = sent(certificate, "--to", "cncjs://127.0.0.1:1")
    assert code == 2
    assert err[0].endswith(f"takes one file at a time; name one of: {', '.join(names)}")
    assert sent(certificate, "--to", watched)[0] == 0
    assert sorted(one.name for one in watched.iterdir()) == sorted(names)


@pytest.mark.skipif(
    "MECHWRIGHT_CNCJS_URL" not in os.environ, reason="no cncjs with an open port (MECHWRIGHT_CNCJS_URL)"
)
def test_the_real_cncjs_loads_a_program(made, sent):
    code, out, err = sent(made[0][0], "--to", os.environ["MECHWRIGHT_CNCJS_URL"], "--force")
    assert (code, err) == (0, [])
    assert "loaded on" in out


def test_nothing_of_the_current_folder_is_run(made, watched, tmp_path):
    (tmp_path / "shapely.py").write_text("raise SystemExit('run')")
    done = subprocess.run(
        [sys.executable, "-P", "-m", "mechwright", "send", str(made[1]), "--to", str(watched)],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
