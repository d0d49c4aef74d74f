"""The plugin host: what is broken becomes a warning with a name, and the rest goes on."""

import os
import signal
import subprocess
import sys
from importlib.metadata import Distribution, EntryPoint, entry_points
from pathlib import Path

import pytest

from mechwright.contracts import guard
from mechwright.contracts.exporter import Exporter
from mechwright.contracts.family import Family
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.plugin import HOOK_API, MOVING
from mechwright.errors import PluginError
from mechwright.plugins.host import DISABLE, GROUP, hook_points, load
from mechwright_cam.controls.contract import Control

FAMILY = """
from mechwright.contracts.family import Family
from mechwright.plugins.hookspecs import hookimpl
from mechwright.contracts.parameters import Parameters

class Cam(Family[Parameters]):
    name = "cam"
    title = "Cam"
    summary = "A cam."
    Params = Parameters
    def solve(self, params, samples): raise NotImplementedError
    def parts(self, params): return []

@hookimpl
def mechwright_register():
    return [Cam]
"""

OUTPUT = """
from mechwright.plugins.hookspecs import hookimpl
from mechwright.contracts.exporter import Exporter

from mechwright_cam.controls.contract import Control

class Mill(Control):
    name, title = "mill", "Mill"
    def write(self, program): return ""
    def read(self, program, **more): raise NotImplementedError
    def read(self, program, **settings): return None
    def tool_table(self, tools): return "", ""

class Stl(Exporter):
    name, suffix = "stl", ".stl"
    def part(self, part): return b""

@hookimpl
def mechwright_register():
    return iter([Mill, Stl])
"""


@pytest.fixture
def plugin(tmp_path, monkeypatch):
    """Write a plugin module, and give its distribution name and entry point."""
    monkeypatch.syspath_prepend(tmp_path)
    made = []

    def make(source, name="cam", distribution="third-party"):
        module = f"plugin_{tmp_path.name.replace('-', '_')}_{len(made)}"
        made.append(module)
        (tmp_path / f"{module}.py").write_text(source, encoding="utf-8")
        return distribution, EntryPoint(name, module, GROUP)

    yield make
    for module in made:
        sys.modules.pop(module, None)


def reasons(host):
    return [str(broken) for broken in host.broken]


def test_what_is_registered_can_be_looked_up(plugin):
    host = load([plugin(FAMILY), plugin(OUTPUT, "output")])
    assert host.broken == []
    assert isinstance(host.family("cam"), Family)
    assert host.of(Family)["cam"].distribution == "third-party"
    assert host.of(Family)["cam"].plugin == "cam"
    assert host.get(Control, "mill").title == "Mill"
    assert host.get(Exporter, "stl").suffix == ".stl"
    assert [one.name for one in host.all(Control)] == ["mill"]


@pytest.mark.parametrize(("what", "known"), [(Family, "cam"), (Control, "mill"), (Exporter, "stl")])
def test_what_is_not_installed_is_named_with_what_is(plugin, what, known):
    host = load([plugin(FAMILY), plugin(OUTPUT, "output")])
    with pytest.raises(PluginError, match=f"{what.kind} 'camm' is not installed; known: {known}"):
        host.get(what, "camm")
    with pytest.raises(
        PluginError, match="; did you mean 'cam'\\?$" if known == "cam" else f"known: {known}$"
    ):
        host.get(what, "camm")
    with pytest.raises(PluginError, match="known: none is installed"):
        load([]).get(what, "cam")


@pytest.mark.parametrize(
    ("source", "reason"),
    [
        ("import no_such_module", "ModuleNotFoundError: No module named 'no_such_module'"),
        (
            "from mechwright.build import Page",
            "ModuleNotFoundError: No module named 'mechwright.build'; it is called mechwright.pipeline now",
        ),
        ("def f(:", "SyntaxError: invalid syntax"),
        ("import sys; sys.exit('no licence')", "SystemExit: no licence"),
        ("raise SystemExit", "SystemExit"),
        ("raise RuntimeError('first line\\nsecond line')", "RuntimeError: first line"),
        ("raise KeyError('colour')", "KeyError: 'colour'"),
        ("raise GeneratorExit", "GeneratorExit"),
        ("class Own(BaseException): pass\nraise Own('mine')", "Own: mine"),
    ],
)
def test_a_plugin_that_cannot_be_imported(plugin, source, reason):
    host = load([plugin(source, "bad", "shaky"), plugin(FAMILY)])
    (said,) = reasons(host)
    assert said.startswith(f"plugin bad of shaky is not used: {reason}")
    assert "second line" not in said
    assert list(host.of(Family)) == ["cam"]


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="the system has no alarm")
@pytest.mark.parametrize(
    ("source", "where"),
    [
        ("while True: pass", ""),
        (FAMILY.replace("return [Cam]", "while True: pass"), "mechwright_register: "),
        (
            FAMILY.replace(
                "def solve(self", "def __init__(self):\n        while 1: pass\n    def solve(self"
            ),
            "Cam(): ",
        ),
    ],
    ids=["module", "hook", "class"],
)
def test_a_plugin_that_loads_without_an_end(plugin, monkeypatch, source, where):
    monkeypatch.setattr(guard, "LOADING", 0.2)
    host = load([plugin(source, "bad", "shaky"), plugin(FAMILY)])
    assert reasons(host) == [f"plugin bad of shaky is not used: {where}takes more than 0.2 s"]
    assert list(host.of(Family)) == ["cam"]


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        (
            "mechwright_register",
            "mechwright_register_families",
            "there is no hook mechwright_register_families; since hook API 2 one hook gives all classes: "
            "mechwright_register",
        ),
        (
            "mechwright_register",
            "mechwright_paint_it_black",
            "there is no hook mechwright_paint_it_black",
        ),
        (
            "@hookimpl\ndef mechwright_register",
            "def mechwright_register",
            "hook mechwright_register is not marked with mechwright.plugins.hookspecs.hookimpl",
        ),
        (
            "@hookimpl\ndef mechwright_register",
            "def mechwright_register_posts",
            "there is no hook mechwright_register_posts; since hook API 2",
        ),
        (
            "def mechwright_register()",
            "def mechwright_register(config)",
            "Plugin 'cam' for hook 'mechwright_register' hookimpl definition",
        ),
        ("return [Cam]", "pass", "mechwright_register: TypeError: it returns nothing"),
        ("return [Cam]", "return Cam", "it returns <class"),
        ("return [Cam]", "return 7", "it returns 7; return a list of classes"),
        ("return [Cam]", "return [Cam()]", "is no class of a contract, such as mechwright.Family"),
        ("return [Cam]", "return ['Cam']", "'Cam' is no class of a contract"),
        (
            "return [Cam]",
            "return [Family]",
            "Family is a contract itself; register classes that derive from it",
        ),
        ("return [Cam]", "raise ValueError('no')", "mechwright_register: ValueError: no"),
        ("return [Cam]", "raise SystemExit(3)", "mechwright_register: SystemExit: 3"),
        ("return [Cam]", "raise GeneratorExit", "mechwright_register: GeneratorExit"),
        ('name = "cam"', 'name = "cam"; api = 0', f"for hook API 0; this is {HOOK_API}: {MOVING} says how"),
        ('name = "cam"', 'name = "cam"; api = 99', f"Cam was written for hook API 99; this is {HOOK_API}"),
        ('name = "cam"', 'name = "cam"; api = 1.0', f"Cam was written for hook API 1.0; this is {HOOK_API}"),
        ('name = "cam"', 'name = "cam"; api = None', f"for hook API None; this is {HOOK_API}"),
        ('name = "cam"', "name = 7", "Cam has no name"),
        ('name = "cam"', 'name = "../cam"', "name '../cam' is not of lower-case letters"),
        ('name = "cam"', 'name = "Cam"', "name 'Cam' is not of lower-case letters"),
        ('title = "Cam"', "", "Cam has no title"),
        ('summary = "A cam."', "summary = None", "Cam: summary is None; a text is wanted"),
        (
            "Params = Parameters",
            "Params = dict",
            "Cam: Params is <class 'dict'>; a class of the kind Parameters is wanted",
        ),
        ("Params = Parameters", "", "Cam has no Params"),
        ("def parts(self", "def bits(self", "Cam(): TypeError: Can't instantiate abstract class Cam"),
        ("def solve(self", "def __init__(self): 1 / 0\n    def solve(self", "Cam(): ZeroDivisionError"),
        ("def solve(self", "def __init__(self): exit()\n    def solve(self", "Cam(): SystemExit"),
        (
            "def solve(self",
            "def __init__(self): raise GeneratorExit\n    def solve(self",
            "Cam(): GeneratorExit",
        ),
        (
            "def solve(self",
            "def __init__(self): self.solve = self.parts = print\n    def solve(self",
            "Cam(): sets parts, solve; a method stands in the class",
        ),
    ],
)
def test_a_broken_registration_is_named_and_the_rest_goes_on(plugin, old, new, reason):
    assert old in FAMILY
    host = load([plugin(FAMILY.replace(old, new), "cam", "shaky"), plugin(OUTPUT, "output")])
    (said,) = reasons(host)
    assert said.startswith("plugin cam of shaky is not used: ")
    assert reason in said
    assert "\n" not in said
    assert not host.of(Family)
    assert list(host.of(Control)) == ["mill"]


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ('".stl"', '"stl"', "Stl: suffix 'stl' is not a dot with lower-case letters and digits"),
        ('".stl"', '"/../x"', "Stl: suffix '/../x' is not a dot"),
        (', suffix = "stl", ".stl"', ' = "stl"', "Stl has no suffix"),
        (', title = "mill", "Mill"', ' = "mill"', "Mill has no title"),
    ],
)
def test_posts_and_exporters_are_looked_at_too(plugin, old, new, reason):
    assert old in OUTPUT
    host = load([plugin(OUTPUT.replace(old, new), "output")])
    (said,) = reasons(host)
    assert reason in said
    assert len(host.of(Control)) + len(host.of(Exporter)) == 1


def test_one_bad_class_does_not_take_the_good_ones_with_it(plugin):
    host = load([plugin(OUTPUT.replace('".stl"', '"stl"'), "output")])
    assert list(host.of(Control)) == ["mill"]
    assert not host.of(Exporter)


KIND = """
from mechwright.contracts.plugin import Plugin
from mechwright.plugins.hookspecs import hookimpl

class Process(Plugin):
    kind, plural = "process", "processes"
    @classmethod
    def fault(cls): return "" if cls.name != "bad" else "it is bad"

class Laser(Process):
    name, title = "laser", "Laser"

class Bad(Process):
    name, title = "bad", "Bad"

class Fast(Laser):
    name = "fast-laser"

@hookimpl
def mechwright_register():
    return [Laser, Bad, Fast]
"""


def test_a_new_kind_of_plugin_needs_nothing_of_the_host(plugin):
    host = load([plugin(KIND, "laser")])
    (contract,) = host.registered
    assert contract.plural == "processes"
    assert list(host.of(contract)) == ["laser", "fast-laser"]
    assert reasons(host) == ["plugin laser of third-party is not used: Bad: it is bad"]


def test_a_lazy_attribute_that_fails_is_no_hook(plugin):
    source = (
        FAMILY
        + "\ndef __getattr__(name): raise RuntimeError(name)\ndef __dir__(): return ['x', *globals()]\n"
    )
    host = load([plugin(source)])
    assert host.broken == []
    assert list(host.of(Family)) == ["cam"]


def test_hookspecs_may_be_imported_by_name(plugin):
    host = load([plugin("from mechwright.plugins.hookspecs import *\n" + OUTPUT, "output")])
    assert host.broken == []


def test_a_name_that_is_taken_names_both(plugin):
    host = load([plugin(FAMILY, "cam", "first"), plugin(FAMILY, "other", "second")])
    assert reasons(host) == [
        "plugin other of second is not used: family 'cam' is already registered by cam of first"
    ]
    assert host.of(Family)["cam"].distribution == "first"


def test_a_family_and_a_control_may_share_a_name(plugin):
    host = load([plugin(FAMILY), plugin(OUTPUT.replace('"mill"', '"cam"'), "output")])
    assert host.broken == []
    assert host.family("cam").name == host.get(Control, "cam").name


def test_plugins_are_switched_off_by_name(plugin, monkeypatch):
    points = [plugin(FAMILY), plugin("raise ImportError", "bad"), plugin(OUTPUT, "output")]
    monkeypatch.setenv(DISABLE, " bad, cam ,,")
    host = load(points)
    assert (host.of(Family), host.broken, list(host.of(Control))) == ({}, [], ["mill"])
    assert list(load(points, frozenset({"bad"})).of(Family)) == ["cam"]


class Installed(Distribution):
    """A distribution as it would be found on the path."""

    def __init__(self, name, entry_points):
        self.files_by_name = {
            "METADATA": f"Name: {name}\n" if name else None,
            "entry_points.txt": entry_points,
        }

    def read_text(self, filename):
        return self.files_by_name.get(filename)

    def locate_file(self, path):
        return Path(path)


def found(*distributions):
    points, broken = hook_points(distributions)
    return [(name, point.name) for name, point in points], broken


def test_built_in_plugins_go_first_and_the_order_is_that_of_names():
    third = Installed("a-third-party", "[mechwright]\nzeta = z\nalpha = a\n")
    own = Installed("mechwright", "[console_scripts]\nmechwright = m:main\n[mechwright]\ncam = c\n")
    other = Installed("b", "[mechwright]\ncam = other\n")
    wanted = [("mechwright", "cam"), ("a-third-party", "alpha"), ("a-third-party", "zeta"), ("b", "cam")]
    assert found(other, third, own) == (wanted, [])
    assert found(own, other, third) == (wanted, [])


def test_an_editable_install_that_is_listed_twice_counts_once():
    own = Installed("mechwright", "[mechwright]\ncam = c\n")
    assert found(own, own) == ([("mechwright", "cam")], [])


def test_distributions_without_entry_points_or_name():
    assert found(Installed("a", None), Installed("b", "")) == ([], [])
    assert found(Installed("", "[mechwright]\ncam = c\n"))[0] == [("unknown", "cam")]


def test_entry_points_that_cannot_be_read_are_a_warning():
    points, broken = found(
        Installed("torn", "[mechwright]\nno equals sign\n"), Installed("b", "[mechwright]\nx = y\n")
    )
    assert points == [("b", "x")]
    assert len(broken) == 1
    assert str(broken[0]).startswith("plugin entry_points.txt of torn is not used: ")


def test_broken_entry_points_of_others_are_none_of_our_business():
    assert found(Installed("torn", "[console_scripts]\nno equals sign\n")) == ([], [])


def test_the_host_needs_no_numbers():
    code = "import sys, mechwright.plugins.host as h; h.host(); print(*sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, DISABLE: ",".join(entry.name for entry in entry_points(group=GROUP))},
        capture_output=True,
        text=True,
        check=True,
    )
    assert not {"numpy", "scipy", "shapely", "cadquery", "pint"} & set(done.stdout.split())


def test_params_base_is_strict():
    assert Parameters.model_config["extra"] == "forbid"
    assert Parameters.model_config["frozen"] is True
