"""The version of the contracts that a plugin states: the one before is used for one minor version, with a warning."""

import sys
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

import mechwright
from mechwright.cli.hosting import warn_broken
from mechwright.contracts.exporter import Exporter
from mechwright.contracts.plugin import HOOK_API, HOOK_API_SINCE, MOVING
from mechwright.plugins.host import GROUP, load

PLUGIN = f"""
from mechwright import Exporter, hookimpl

class Stl(Exporter):
    api = {HOOK_API - 1}
    name, suffix = "stl", ".stl"
    def part(self, part): return b""

@hookimpl
def mechwright_register():
    return [Stl]
"""
SAID = f"plugin old of third-party: Stl was written for hook API {HOOK_API - 1}; this is {HOOK_API}"


@pytest.fixture
def found(tmp_path, monkeypatch):
    """The host with that plugin alone, in a version of this program."""
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "older_contracts.py").write_text(PLUGIN, encoding="utf-8")

    def make(version):
        monkeypatch.setattr(mechwright, "__version__", version)
        sys.modules.pop("older_contracts", None)
        return load([("third-party", EntryPoint("old", "older_contracts", GROUP))])

    yield make
    sys.modules.pop("older_contracts", None)


MAJOR, MINOR = map(int, HOOK_API_SINCE.split("."))
NEXT = f"{MAJOR}.{MINOR + 1}"


@pytest.mark.parametrize("version", [f"{HOOK_API_SINCE}.0", f"{HOOK_API_SINCE}.7"])
def test_the_contracts_before_are_read_in_the_version_that_raised_them(found, version):
    host = found(version)
    assert list(host.of(Exporter)) == ["stl"]
    said = f"{SAID}, and {NEXT} refuses {HOOK_API - 1}: {MOVING} says how to move"
    assert [str(one) for one in host.outdated] == [said]
    assert host.broken == []


@pytest.mark.parametrize("version", [f"{NEXT}.0", f"{MAJOR + 1}.{MINOR}.0"])
def test_the_next_version_refuses_them(found, version):
    host = found(version)
    assert not host.of(Exporter)
    assert host.outdated == []
    assert [str(one) for one in host.broken] == [
        SAID.replace("third-party:", "third-party is not used:") + f": {MOVING} says how to move"
    ]


def test_the_command_line_warns(found, capsys):
    warn_broken(found(f"{HOOK_API_SINCE}.0"))
    assert capsys.readouterr().err.startswith(f"mechwright: warning: {SAID}, and {NEXT} refuses ")


FAMILY = """
from mechwright import Family, Parameters, hookimpl

class Cam(Family[Parameters]):
    name, title, summary, Params = "cam", "Cam", "A cam.", Parameters
    {own}
    def solve(self, params, samples): raise NotImplementedError
    def parts(self, params): return []

@hookimpl
def mechwright_register():
    return [Cam]
"""


@pytest.mark.parametrize(
    ("own", "name"),
    [
        ("def check(self, params): return []", "check"),
        ("def judge(self, params): return []", "judge"),
        ("def evaluate(self, batch, columns, stage=None): return None", "evaluate"),
        ("check = judge = 7", "check"),
        ("@__import__('functools').wraps(Family.check)\n    def check(self, params): return []", "check"),
    ],
)
def test_a_family_that_overrides_what_follows_from_its_rules_is_refused_by_name(found, tmp_path, own, name):
    (tmp_path / "older_contracts.py").write_text(FAMILY.format(own=own), encoding="utf-8")
    said = f"Cam overrides {name}, which is derived since hook API 3; {MOVING} says how to move"
    assert [one.reason for one in found(f"{HOOK_API_SINCE}.0").broken] == [said]
    assert (Path(__file__).parents[2] / MOVING).is_file()
