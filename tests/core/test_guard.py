"""Plugins that do what their contract does not allow: one line says who, where, and what was wrong."""

import json
import signal
import subprocess
import sys
import threading
import time
import warnings
from pathlib import Path
from typing import Any

import foreign_plugin
import numpy as np
import pytest
from procedural import Procedural

from mechwright.cli import failure
from mechwright.contracts import guard
from mechwright.contracts.evaluation import Batch
from mechwright.contracts.exporter import Exporter
from mechwright.contracts.finding import Finding, Stage
from mechwright.contracts.motion import Channel, Motion, Poses, Scalar
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.part import Part
from mechwright.errors import GeometryError, KinematicsError, MechwrightError, PluginFaultError
from mechwright.geometry import Line, Loop, Outline
from mechwright.plugins.host import Registered


class Size(Parameters):
    size: float = 40.0
    list_of: tuple[float, ...] = (1.0,)


def moved(samples: int, values: Any = None, **more: Any) -> Motion:
    t = np.linspace(0.0, 1.0, samples)
    return Motion("t", {"t": Channel(t, "s"), "x": Channel(t if values is None else values, "mm")}, **more)


def plate(size: float = 40.0, high: float = 30.0, thick: float = 5.0, name: str = "plate") -> Part:
    return Part(name, Outline(Loop.polygon([(0, 0), (size, 0), (size, high), (0, high)])), thick, "aluminium")


class Bad(Procedural[Size]):
    """Does what it is told."""

    name = "bad"
    title = "Bad"
    summary = "Gives what it is told to."
    Params = Size
    does: Any = None

    def found(self, params: Size) -> Any:
        return self.does(params)

    def solve(self, params: Size, samples: int) -> Any:
        return self.does(params, samples)

    def parts(self, params: Size) -> Any:
        return self.does(params)


def told(method: str, does: Any, kind: type[Exception] = PluginFaultError) -> str:
    """What is said where a method of a plugin does that."""
    family = Registered(Bad(), "bad-mechanisms", "bad").item
    family.does = does
    asked = {"check": (Size(),), "solve": (Size(), 721), "parts": (Size(),)}[method]
    with pytest.raises(kind) as caught:
        getattr(family, method)(*asked)
    said = str(caught.value)
    where = f"plugin bad of bad-mechanisms: family bad: {method}(): "
    assert said.startswith(where), said
    assert len(said.splitlines()) == 1
    return said.removeprefix(where)


def leaves(code: object) -> Any:
    return lambda *_: sys.exit(code)


@pytest.mark.parametrize("code", [None, 0, 1, "no licence"])
@pytest.mark.parametrize("method", ["check", "solve", "parts"])
def test_a_plugin_cannot_end_the_program(method: str, code: object) -> None:
    assert f"ends the program by sys.exit({code!r})" in told(method, leaves(code))


def endless(*_: object) -> None:
    while True:
        try:
            time.sleep(0.01)
        except Exception:  # noqa: BLE001,S112,RUF100 - the worst that one can do
            continue


def deep(*_: object) -> Any:
    return deep()


def divides(*_: object) -> float:
    return 1 / 0


def test_errors_name_their_line() -> None:
    assert told("check", divides).startswith("ZeroDivisionError: division by zero (test_guard.py, line ")
    assert "RecursionError" in told("solve", deep)
    assert "NotImplementedError" in told("parts", lambda _: (_ for _ in ()).throw(NotImplementedError))


STUBBORN = """
import itertools
from mechwright.contracts import alarm
alarm.AGAIN, alarm.MOST_CAUGHT = 0.05, 3
with alarm.in_time(0.05, "plugin rude of rude-mechanisms: family rude: check()"):
    while True:
        try:  # nearly always inside: an alarm between two tries would not be caught, and end it honestly
            for _ in itertools.count():
                pass
        except BaseException:
            continue
"""


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="the system has no alarm")
def test_what_catches_whatever_ends_it_ends_the_program() -> None:
    done = subprocess.run(
        [sys.executable, "-c", STUBBORN], capture_output=True, text=True, check=False, timeout=60
    )
    assert done.returncode == 2
    who = "plugin rude of rude-mechanisms: family rude: check()"
    assert done.stderr == f"mechwright: {who}: takes more than 0.05 s and catches what ends it\n"


def test_the_name_of_an_error_is_in_its_line() -> None:
    kind = type("two\nlines", (Exception,), {})

    def raises(*_: object) -> None:
        raise kind("x")

    assert told("check", raises).startswith("two lines: x (test_guard.py, line ")


def test_of_many_warnings_the_first_are_said(capsys: pytest.CaptureFixture[str]) -> None:
    with failure.errors_in_lines():
        for number in range(failure.MOST_WARNINGS + 50):
            failure.warned(f"number {number}", UserWarning, "a.py", 1)
    said = capsys.readouterr().err.splitlines()
    assert len(said) == failure.MOST_WARNINGS + 1
    assert said[-1] == "mechwright: warning: there are more warnings, which are omitted"


def test_an_error_in_a_thread_is_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    with failure.errors_in_lines():
        for name in ("first", "second"):
            thread = threading.Thread(target=divides, name=name)
            thread.start()
            thread.join()
    first, second = capsys.readouterr().err.splitlines()
    assert first.startswith("mechwright: warning: the thread 'first' ended by an error: ZeroDivisionError: ")
    assert "'second'" in second


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="the system has no alarm")
def test_an_endless_call_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(guard.LIMIT, "0.2")
    assert told("solve", endless).startswith("takes more than 0.2 s; MECHWRIGHT_PLUGIN_SECONDS ")
    assert signal.getitimer(signal.ITIMER_REAL)[0] == 0
    for wrong in ("x", "0", "-1", "nan", "inf"):
        monkeypatch.setenv(guard.LIMIT, wrong)
        with pytest.raises(MechwrightError, match="is no time in seconds above 0"):
            Bad().check(Size())


def test_a_call_in_another_thread_has_no_alarm(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(guard.LIMIT, "0.05")
    found = []
    family = Bad()
    family.does = lambda _: time.sleep(0.2) or []
    thread = threading.Thread(target=lambda: found.append(family.check(Size())))
    thread.start()
    thread.join()
    assert found == [()]


MOTIONS: dict[str, tuple[Any, str]] = {
    "none": (lambda n: None, "gives None; a Motion is wanted"),
    "junk": (lambda n: "x" * 500, "a Motion is wanted"),
    "seven samples": (lambda n: moved(7), "gives 7 samples; 721 are asked for"),
    "nan": (lambda n: moved(n, np.full(n, np.nan)), "channel 'x' is nan at sample 0"),
    "inf": (lambda n: moved(n, np.r_[np.zeros(n - 1), np.inf]), "channel 'x' is inf at sample 720"),
    "objects": (lambda n: moved(n, np.full(n, "a", dtype=object)), "of the type object"),
    "complex": (lambda n: moved(n, np.zeros(n, complex)), "of the type complex128"),
    "a list": (lambda n: moved(n, [0.0] * n), "AttributeError"),
    "figure": (lambda n: moved(n, scalars={"most": Scalar(np.nan, "mm")}), "figure 'most' is nan"),
    "pose": (
        lambda n: moved(n, poses={"b": Poses.planar(0.0, np.inf, np.zeros(n))}),
        "the pose of body 'b' is inf",
    ),
    "rotation": (
        lambda n: moved(n, poses={"b": Poses(np.zeros((n, 3)), np.tile(2 * np.eye(3), (n, 1, 1)))}),
        "the rotations of body 'b' are no rotations: off by 3",
    ),
}


@pytest.mark.parametrize("motion", MOTIONS)
def test_a_motion_is_what_was_asked_for(motion: str) -> None:
    made, words = MOTIONS[motion]
    assert words in told("solve", lambda _, samples: made(samples))


def test_a_shape_that_does_not_fit_names_the_plugin() -> None:
    assert "channel x: shape (3,)" in told("solve", lambda _, n: moved(n, np.zeros(3)), KinematicsError)


@pytest.mark.parametrize(
    "name",
    [
        "",
        "a,b",
        "a\nb",
        'a"b',
        "=cmd|'/c calc'!A1",
        "+x",
        "-x",
        "@x",
        "\tx",
        "a;b",
        " =x",
        "\uff1dx",
        "x ",
        "x" * 101,
    ],
)
def test_a_channel_is_named_so_that_it_can_head_a_column(name: str) -> None:
    def solve(_: object, n: int) -> Motion:
        t = np.linspace(0.0, 1.0, n)
        return Motion("t", {"t": Channel(t, "s"), name: Channel(t, "mm")})

    assert f"the channel {name!r} [mm] cannot head a column: it " in told("solve", solve, KinematicsError)
    assert "has ','" in told(
        "solve", lambda _, n: Motion("t", {"t": Channel(np.arange(n), "s,")}), KinematicsError
    )


@pytest.mark.parametrize("junk", [None, 3, "text", [None], [3], [Finding], {"a": 1}])
def test_findings_are_findings(junk: object) -> None:
    assert " wanted" in told("check", lambda _: junk)
    note = Finding.note("a.b", "wrong", float("nan"))
    assert "'a.b' has a figure that is not a number" in told("check", lambda _: [note])


def bow_tie(_: object) -> list[Part]:
    corners = [(0.0, 0.0), (40.0, 0.0), (0.0, 30.0), (30.0, 90.0)]
    return [Part("tie", Outline(Loop.polygon(corners)), 5.0, "aluminium")]


def unclosed(_: object) -> list[Part]:
    return [Part("open", Outline(Loop((Line((0.0, 0.0), (1.0, 0.0), "a"),))), 5.0, "aluminium")]


@pytest.mark.parametrize("size", [1e-3, 1e9])
def test_parts_can_be_made(size: float) -> None:
    assert told("parts", lambda _: None).startswith("gives None; a sequence of Part is wanted")
    assert told("parts", lambda _: [plate(), 3]).startswith("[1] of what it gives is 3; a Part is wanted")
    assert f"part 'plate' is {size:.3g} mm wide; a part has 0.01 to 100,000 mm" in told(
        "parts", lambda _: [plate(size, 30.0)]
    )
    assert "mm thick" in told("parts", lambda _: [plate(thick=size)])
    assert "part 'tie': the outline cuts itself" in told("parts", bow_tie)
    assert "the outline is open at (1.000000, 0.000000)" in told("parts", unclosed, GeometryError)


def test_parameters_stay_as_they_are() -> None:
    def spoils(params: Size) -> list[Finding]:
        object.__setattr__(params, "size", 1.0)
        return []

    assert told("check", spoils).startswith("changes the parameters")


def test_what_is_given_one_by_one_is_guarded_too() -> None:
    class Pieces(Exporter):
        name = "pieces"
        suffix = ".p"

        def part(self, *_: object) -> Any:
            yield b"one"
            sys.exit(0)

    found = Pieces().part()
    assert next(found) == b"one"
    with pytest.raises(PluginFaultError, match=r"exporter pieces: part\(\): ends the program"):
        next(found)


def test_a_want_of_memory_passes() -> None:
    """As the keyboard does, see ``test_stops.py``."""
    family = Bad()
    family.does = lambda _: (_ for _ in ()).throw(MemoryError)
    with pytest.raises(MemoryError):
        family.check(Size())
    assert guard.now() == ""


def test_prints_go_aside(capsys: pytest.CaptureFixture[str]) -> None:
    family = Bad()
    family.does = lambda _: sys.stdout.write("loud\n") and []
    family.check(Size())
    sys.stdout.write("{}\n")
    assert capsys.readouterr() == ("{}\n", "loud\n")


def test_warnings_are_a_line_that_says_whose_they_are(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    family = Registered(Bad(), "bad-mechanisms", "bad").item
    family.does = lambda _: warnings.warn("divide\nby \x1b[31mzero", RuntimeWarning, stacklevel=1) or []
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        monkeypatch.setattr(warnings, "showwarning", failure.warned)
        family.check(Size())
    said = capsys.readouterr().err
    assert said.startswith("mechwright: warning: plugin bad of bad-mechanisms: family bad: check(): ")
    assert "RuntimeWarning: divide by \\x1b[31mzero (test_guard.py, line " in said
    assert len(said.splitlines()) == 1


def test_a_study_is_stopped_by_a_fault_and_not_by_a_refusal() -> None:
    """A fault of the plugin is no property of a design; the design that showed it is told."""
    family = Registered(Bad(), "bad-mechanisms", "bad").item
    batch = Batch(Size, {}, {"size": np.array([1.0, 2.0])})

    def does(params: Size, samples: int = 0) -> Any:
        if not samples or params.size < 2:
            return moved(samples) if samples else []
        raise wrong

    family.does = does
    wrong: Exception = KinematicsError("does not reach")
    assert family.evaluate(batch, ["x.least"], Stage.MOTION).counts == {"motion": 1}
    wrong = ZeroDivisionError("by nothing")
    with pytest.raises(PluginFaultError, match=r"solve\(\): ZeroDivisionError: by nothing .* for size = 2.0"):
        family.evaluate(batch, ["x.least"], Stage.MOTION)


def test_the_command_line_with_a_rude_plugin(tmp_path: Path) -> None:
    loud = 'print("loud")\nimport warnings\nwarnings.warn("odd", RuntimeWarning)'
    design = foreign_plugin.installed(tmp_path, loud)
    checked = foreign_plugin.run(tmp_path, "check", design, "--json")
    assert json.loads(checked.stdout)["ok"] is True
    assert checked.stderr.splitlines()[0] == "loud"
    assert f"warning: {foreign_plugin.WHO}: family rude: check(): RuntimeWarning: odd" in checked.stderr
    solved = foreign_plugin.run(tmp_path, "solve", design, "-o", tmp_path / "out")
    assert solved.returncode == 2
    assert solved.stderr.splitlines()[-1].startswith(
        f"mechwright: {design}: {foreign_plugin.WHO}: family rude: solve(): ends the program by sys.exit(0)"
    )
    assert not (tmp_path / "out").exists()
