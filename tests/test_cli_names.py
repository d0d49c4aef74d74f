"""Names of files that a shell or a terminal takes for something else: lines to type work, and no name steers."""

import re
import shlex
from collections.abc import Callable
from pathlib import Path

import pytest

from mechwright.contracts.finding import Finding
from mechwright.designs.design import load
from mechwright.errors import DesignError
from mechwright.plugins.host import host
from mechwright.shell import file_word
from mechwright_cad.live import building
from mechwright_cad.live.building import Building

Run = Callable[..., tuple[int, str, str]]
NAMES = (
    "my pair.toml",
    "-x.toml",
    "it's $HOME `a`.toml",
    "a\x1b[31mb.toml",
    "a\nb.toml",
    "a\u202eb.toml",
    "*;?.toml",
)
PLAIN = """family = "spur-gears"
[parameters]
teeth = 20
mate_teeth = 30
module = 2
"""


def given(name: str) -> str:
    """As somebody types it who has a file of this name in the working folder."""
    return f"./{name}" if name.startswith("-") else name


@pytest.fixture(params=NAMES)
def name(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    return str(request.param)


def test_no_name_steers_a_terminal(name: str, command_line: Run) -> None:
    code, out, err = command_line("new", "geneva", "-o", given(name))
    assert (code, err) == (0, "")
    assert all(line.isprintable() for line in out.split("\n")), out


def test_no_name_of_a_design_steers_a_terminal(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command_line: Run
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a\x1b[31m\nb.toml").write_text(PLAIN)
    _, out, err = command_line("check", "a\x1b[31m\nb.toml")
    assert r"a\x1b[31m\nb.toml: can be built" in out
    assert all(line.isprintable() for line in (out + err).split("\n"))


def test_what_new_says_to_type_is_taken(name: str, command_line: Run) -> None:
    """A line is what is printed: a name that cannot be printed is not typed either."""
    code, out, _ = command_line("new", "spur-gears", "-o", given(name))
    assert code == 0
    first = out.splitlines()[0]
    if not name.isprintable():
        return
    _, _, typed = first.partition("go on with: ")
    program, command, file, *_ = shlex.split(typed)
    assert (program, command, Path(file).exists()) == ("mechwright", "build", True)


@pytest.mark.parametrize("name", [one for one in NAMES if one.isprintable()])
def test_other_lines_to_type_are_taken(name: str, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_text('family = "four-bar"\n[study]\ncount = 3\n')
    with pytest.raises(DesignError, match="mechwright sweep") as caught:
        load(path, host())
    _, _, typed = str(caught.value).partition("sweep it by ")
    found = re.search(r"mechwright sweep (.*) -o FOLDER", typed)
    assert found is not None
    (file,) = shlex.split(found[1])
    assert (tmp_path / file).samefile(path)
    assert not file.startswith("-")


def test_a_page_builds_a_file_that_looks_like_an_option(monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[list[str]] = []
    monkeypatch.setattr(building.subprocess, "Popen", lambda words, **_: calls.append(words))
    Building(Path("-x.toml"))._started()
    assert calls[0][-5:] == ["build", "-o", "-x-build", "--", "-x.toml"]


def test_a_file_after_two_hyphens_is_a_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command_line: Run
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("-x.toml").write_text(PLAIN)
    assert file_word("-x.toml") == "./-x.toml"
    assert command_line("check", "--to", "motion", "--", "-x.toml")[0] == 0


def test_a_finding_with_a_foreign_text_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    from mechwright.cli.telling import tell

    tell(Finding.error("a.b", "c", "\x1b[2Jgone\nmore", 1.0, 2.0, "mm", ""))
    out = capsys.readouterr().out
    assert out.count("\n") == 1
    assert "\x1b" not in out
