"""Libraries that are not installed: said before any work, with a line to type that works here."""

import json
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Callable, Mapping
from importlib.metadata import PackageNotFoundError
from pathlib import Path
from typing import Any

import pytest

from mechwright import extras
from mechwright.cli.command import Command
from mechwright.errors import PluginError
from mechwright.extras import EXTRAS, install_line, require
from mechwright.plugins.host import COMMANDS, load

ROOT = Path(__file__).parents[1]
HIDE = """\
import sys
class Hidden:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {hidden!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)
sys.meta_path.insert(0, Hidden())
"""
NONE = "import sys\nfor name in {hidden!r}: sys.modules[name] = None\n"


def without(
    folder: Path, hidden: str, how: str, *call: str, **more: str
) -> "subprocess.CompletedProcess[str]":
    """A command line in a process of its own in which a library is hidden."""
    (folder / "sitecustomize.py").write_text(how.format(hidden=[hidden]))
    path = os.pathsep.join([str(folder), *filter(None, (os.environ.get("PYTHONPATH"),))])
    environment = {**os.environ, "PYTHONPATH": path, **more}
    words = [sys.executable, "-m", "mechwright", *call]
    return subprocess.run(words, env=environment, capture_output=True, text=True, check=False, cwd=folder)


@pytest.mark.parametrize(
    ("library", "call", "by"),
    [
        ("pyarrow", ("sweep", "none.toml", "-o", "out"), "sweep"),
        ("distributed", ("sweep", "none.toml", "-o", "out", "--scheduler", "tcp://a:1"), "--scheduler"),
        ("uvicorn", ("live", "none.toml"), "live"),
        ("starlette", ("live", "none.toml", "--no-open"), "live"),
    ],
)
@pytest.mark.parametrize("how", [HIDE, NONE], ids=["finder", "none"])
def test_a_command_says_what_is_missing_before_any_work(
    tmp_path: Path, library: str, call: tuple[str, ...], by: str, how: str
) -> None:
    """The file that it names is not there, and nobody has looked."""
    if library == "distributed":
        pytest.importorskip("pyarrow")  # a sweep asks for that first
    done = without(tmp_path, library, how, *call)
    assert done.returncode == 2
    extra = EXTRAS[library]
    said = f"mechwright: {by}: {library} is not installed, which the extra {extra} brings: {install_line(extra)}\n"
    assert done.stderr == said
    assert done.stdout == ""
    assert [path.name for path in tmp_path.iterdir() if path.name != "__pycache__"] == ["sitecustomize.py"]


def test_a_scheduler_of_the_environment_is_named_by_its_variable(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")  # a sweep asks for that first
    call = ("sweep", "none.toml", "-o", "out")
    done = without(tmp_path, "distributed", HIDE, *call, DASK_SCHEDULER_ADDRESS="tcp://a:1")
    assert done.stderr.startswith("mechwright: DASK_SCHEDULER_ADDRESS: distributed is not installed")


def test_a_sweep_without_a_scheduler_needs_no_more_than_it_uses(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    done = without(tmp_path, "distributed", HIDE, "sweep", "none.toml", "-o", "out")
    assert "none.toml: cannot be read" in done.stderr


@pytest.mark.parametrize("library", ["pandas", "plotly"])
def test_tables_and_plots_name_theirs_in_the_same_words(tmp_path: Path, library: str) -> None:
    (tmp_path / "sitecustomize.py").write_text(HIDE.format(hidden=[library]))
    ask = {"pandas": "to_dataframe()", "plotly": "plot('omega4')"}[library]
    words = f"import mechwright as mw; mw.design('elliptic-gears').motion.{ask}"
    path = os.pathsep.join([str(tmp_path), *filter(None, (os.environ.get("PYTHONPATH"),))])
    done = subprocess.run(
        [sys.executable, "-c", words],
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr.endswith(
        f"PluginError: {library} is not installed, which the extra data brings: {install_line('data')}\n"
    )


def test_the_help_of_every_such_command_ends_with_what_to_type(
    command_line: Callable[..., tuple[int, str, str]],
) -> None:
    needing = {one.name: one for one in load(group=COMMANDS).all(Command) if one.libraries}
    assert set(needing) == {"live", "mcp", "sweep"}
    table = (ROOT / "docs" / "reference" / "commands.md").read_text(encoding="utf-8")
    for name, command in needing.items():
        extra = EXTRAS[command.libraries[0]]
        code, out, _ = command_line(name, "--help")
        assert code == 0
        assert f"It needs the extra {extra}." in out
        assert out.endswith(f"  The extra is installed by\n    {install_line(extra)}\n")
        row = next(line for line in table.splitlines() if line.startswith(f"| `mechwright {name} "))
        assert f"needs the extra `{extra}`" in row
        assert f'pip install -e ".[{extra}]"' in row


def test_extras_are_those_of_the_distribution() -> None:
    import tomllib

    said = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    declared = said["project"]["optional-dependencies"]
    for library, extra in EXTRAS.items():
        assert any(re.match(rf"{library}\b", one) for one in declared[extra])


def test_a_command_of_a_library_that_no_extra_brings_is_refused() -> None:
    class Odd(Command):
        name = "odd"
        libraries = ("numpy",)

        def run(self) -> None:
            """Nothing."""

    assert "'numpy' is of no extra" in Odd.fault()


class Installed:
    """A distribution that says where it is from."""

    def __init__(self, said: Mapping[str, Any] | str | None) -> None:
        self._said = said if said is None or isinstance(said, str) else json.dumps(said)

    def read_text(self, name: str) -> str | None:
        assert name == "direct_url.json"
        return self._said


@pytest.mark.parametrize(
    ("said", "what"),
    [
        ({"url": "{folder}", "dir_info": {"editable": True}}, '-e "{path}[scale]"'),
        ({"url": "{folder}", "dir_info": {}}, '"{path}[scale]"'),
        ({"url": "file:///none", "dir_info": {"editable": True}}, '"mechwright[scale]"'),
        ({"url": "{wheel}", "archive_info": {}}, '"mechwright[scale] @ {wheel}"'),
        ({"url": "file:///none.whl", "archive_info": {}}, '"mechwright[scale]"'),
        (
            {"url": "https://a.example/m", "vcs_info": {"vcs": "git", "commit_id": "ab"}},
            '"mechwright[scale] @ git+https://a.example/m@ab"',
        ),
        (None, '"mechwright[scale]"'),
        ("{{", '"mechwright[scale]"'),
        ("[]", '"mechwright[scale]"'),
    ],
)
def test_the_line_is_that_of_the_installation(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, said: Any, what: str
) -> None:
    folder, wheel = tmp_path / "a folder", tmp_path / "m.whl"
    folder.mkdir()
    wheel.write_bytes(b"")
    names = {"{folder}": folder.as_uri(), "{wheel}": wheel.as_uri(), "{path}": str(folder)}

    def filled(text: str) -> str:
        for name, value in names.items():
            text = text.replace(name, value)
        return text

    known = {**said, "url": filled(said["url"])} if isinstance(said, dict) else said
    monkeypatch.setattr(extras, "distribution", lambda _: Installed(known))
    monkeypatch.setattr(sys, "executable", "/a/python")
    assert install_line("scale") == f"/a/python -m pip install {filled(what)}"
    shlex.split(install_line("scale"))


def test_sources_that_nobody_has_installed_are_a_checkout(monkeypatch: pytest.MonkeyPatch) -> None:
    def none(name: str) -> Any:
        raise PackageNotFoundError(name)

    monkeypatch.setattr(extras, "distribution", none)
    monkeypatch.setattr(sys, "executable", "/a python")
    assert install_line("live") == f"'/a python' -m pip install -e \"{ROOT}[live]\""


def test_what_is_there_is_not_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(extras, "_installed", lambda _: True)
    require(*EXTRAS)
    monkeypatch.setattr(extras, "_installed", lambda _: False)
    with pytest.raises(PluginError, match=r"^--scheduler: distributed is not installed"):
        require("distributed", by="--scheduler")
