"""What operations, controls, rules and tables of somebody else give is what their contracts declare."""

import dataclasses
import math
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from by_control import LINUXCNC
from planning_parts import LIBRARY
from shop import plate_job, plate_program

from mechwright.contracts import guard
from mechwright.contracts.declared import gives, unstated
from mechwright.contracts.plugin import Plugin, methods_of
from mechwright.contracts.surroundings import Place, Surroundings
from mechwright.contracts.table import Table
from mechwright.errors import MechwrightError
from mechwright.plugins.host import Registered, host
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.lookahead import Lookahead
from mechwright_cam.operations.contract import Hole, Operation, Task
from mechwright_cam.operations.steps import Steps
from mechwright_cam.operations.stock import Stock
from mechwright_cam.program.moves import Feed, Rapid
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.rules import Rule

MILL = next(tool for tool in LIBRARY.tools if tool.name == "mill-6")
JOB = plate_job(tools=(MILL,))
BORE = JOB.features[0]
TEXT = LINUXCNC.write(plate_program())
RUN = LINUXCNC.read(TEXT)
CONTRACTS = (Operation, Control, Rule, Table)


def of(contract: type[Plugin], does: Callable[..., Any]) -> Any:
    """A plugin of a contract that does the same in all of its methods and properties."""
    own: dict[str, Any] = {"name": "bad", "title": "Bad", "suffix": ".b"}
    for name in methods_of(contract):

        def method(self: Any, *arguments: Any, **named: Any) -> Any:
            return does(*arguments)

        own[name] = property(method) if isinstance(vars(contract)[name], property) else method
    return Registered(type("Bad", (contract,), own)(), "bad-mechanisms", "bad").item


ARGUMENTS: dict[str, tuple[Any, ...]] = {"claim": (BORE, JOB), "claim_copy": (BORE, JOB, None)}


def asked(plugin: Any, method: str, arguments: tuple[Any, ...]) -> Any:
    """What a method or a property gives."""
    found = getattr(plugin, method)
    return found(*arguments) if callable(found) else found


def told(contract: type[Plugin], method: str, does: Callable[..., Any]) -> str:
    """What is said where a method does that."""
    arguments = ARGUMENTS.get(method, (None, Stock(), Steps(JOB, 5.0)))
    bad = of(contract, does)
    with pytest.raises(MechwrightError) as caught:
        asked(bad, method, arguments)
    said = str(caught.value)
    call = method if isinstance(vars(contract)[method], property) else f"{method}()"
    who = f"plugin bad of bad-mechanisms: {contract.kind} bad: {call}: "
    assert said.startswith(who), said
    assert len(said.splitlines()) == 1
    return said.removeprefix(who)


METHODS = [(contract, name) for contract in CONTRACTS for name in methods_of(contract)]
TAKES_ALL = {(Table, "read"), (Table, "laid_over")}
"""What they give is for the table itself."""


@pytest.mark.parametrize(("contract", "method"), METHODS, ids=lambda one: getattr(one, "__name__", one))
def test_every_method_gives_what_is_declared(contract: type[Plugin], method: str) -> None:
    if (contract, method) in TAKES_ALL:
        return
    for junk in (object(), 3 + 1j, [None, None], ("q", 3), {3: object()}, np.float32(3), b"q"):
        assert "want" in told(contract, method, lambda *_, junk=junk: junk)


def raises(error: BaseException) -> Callable[..., Any]:
    def does(*_: object) -> None:
        raise error

    return does


@pytest.mark.parametrize(("contract", "method"), METHODS, ids=lambda one: getattr(one, "__name__", one))
def test_no_method_ends_the_program_or_fails_unnamed(contract: type[Plugin], method: str) -> None:
    assert told(contract, method, lambda *_: sys.exit(0)).startswith("ends the program by sys.exit(0)")
    for error in (GeneratorExit(), StopIteration(), AttributeError("q"), RecursionError(), AssertionError()):
        assert told(contract, method, raises(error)).startswith(type(error).__name__)


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="the system has no alarm")
@pytest.mark.parametrize("contract", CONTRACTS)
def test_every_method_has_a_time(contract: type[Plugin], monkeypatch: pytest.MonkeyPatch) -> None:
    def endless(*_: object) -> None:
        while True:
            pass

    monkeypatch.setenv(guard.LIMIT, "0.02")
    for method in methods_of(contract):
        assert told(contract, method, endless).startswith("takes more than 0.02 s; ")


def task(**changes: Any) -> Task:
    whole = Task(BORE, of(Operation, lambda *_: None), (MILL,), 0.0, -6.5, shapely.box(0, 0, 9, 9))
    return dataclasses.replace(whole, **changes)


BOW_TIE = shapely.Polygon([(0, 0), (9, 9), (9, 0), (0, 9)])
TASKS: dict[str, tuple[Task, str]] = {
    "feature": (task(feature="bore"), "feature of what it gives is 'bore'; a Profile or a Bore"),
    "another one": (task(feature=dataclasses.replace(BORE, name="b")), "claims 'b'; it is asked about 'bore'"),
    "operation": (task(operation="cut"), "operation of what it gives is 'cut'; an Operation"),
    "a list": (task(tools=[MILL]), "; a tuple of Tool is wanted"),
    "tools": (task(tools=("mill",)), "tools[0] of what it gives is 'mill'; a Tool"),
    "made up": (task(tools=(MILL.model_copy(update={"diameter": 7.0}),)), "takes 'mill-6', which is no tool"),
    "in words": (task(tools=(MILL.model_copy(update={"diameter": "q"}),)), "tools[0].diameter of what it"),
    "hole": (task(hole=Hole(MILL, (math.nan, 0.0))), "hole.place[0] of what it gives is nan; a number"),
    "top": (task(top=math.nan), "top of what it gives is nan"),
    "bottom": (task(bottom=-math.inf), "bottom of what it gives is -inf; a finite number"),
    "no number": (task(bottom=None), "bottom of what it gives is None; a number"),
    "region": (task(region=None), "region of what it gives is None; a Geometry"),
    "nowhere": (task(region=shapely.Point(math.nan, 1)), "region of what it gives has a corner that is at no"),
    "bow tie": (task(region=BOW_TIE), "region of what it gives is no area: Self-intersection"),
}  # fmt: skip


@pytest.mark.parametrize("claimed", TASKS)
def test_tasks_are_such_in_every_field(claimed: str) -> None:
    given, words = TASKS[claimed]
    assert words in told(Operation, "claim", lambda *_: given)
    assert of(Operation, lambda *_: None).claim(BORE, JOB) is None


def cuts(write: Callable[[Any], object]) -> Callable[..., Stock]:
    def does(_: object, stock: Stock, steps: Steps) -> Stock:
        steps.add("bore: mill", MILL, write)
        return stock

    return does


def without_others(_: object, stock: Stock, steps: Steps) -> Stock:
    steps.cuts.clear()
    return stock


@pytest.mark.parametrize(
    ("does", "words"),
    [
        (cuts(lambda pen: pen.moves.append("G0")), "cut [0].moves[0] of those it adds is 'G0'; a Rapid or a Feed"),
        (cuts(lambda pen: pen.moves.append(Feed(math.nan, 0.0, 0.0, 9.0))), "moves[0].x of those it adds is nan"),
        (cuts(lambda pen: pen.moves.append(Feed(0.0, 0.0, 0.0, math.inf))), "moves[0].feed of those it adds is inf"),
        (cuts(lambda pen: pen.sink("deep")), "TypeError"),
        (cuts(lambda pen: pen.nothing()), "AttributeError"),
        (lambda _, stock, steps: steps.cuts.append("cut") or stock, "cut [0] of those it adds is 'cut'; a Cut"),
        (lambda _, stock, steps: dataclasses.replace(stock, over="q"), "over of what it gives is 'q'; a number"),
        (lambda _, stock, steps: dataclasses.replace(stock, gone=[]), "gone of what it gives is []; a tuple"),
    ],
)  # fmt: skip
def test_cuts_are_such_in_every_move(does: Callable[..., Any], words: str) -> None:
    assert words in told(Operation, "cut", does)


def test_cuts_of_others_stay() -> None:
    steps, moves = Steps(JOB, 5.0), [Rapid(0.0, 0.0, 5.0)]
    fine = of(Operation, cuts(lambda pen: pen.moves.extend(moves)))
    fine.cut(None, Stock(), steps)
    fine.cut(None, Stock(), steps)
    assert len(steps.cuts) == steps.held == 2
    with pytest.raises(MechwrightError, match=r"cut\(\): takes away 2 of the cuts that are not its own"):
        of(Operation, without_others).cut(None, Stock(), steps)


def run(**changes: Any) -> Any:
    return dataclasses.replace(RUN, **changes)


RUNS: dict[str, tuple[Any, str]] = {
    "a text": ("G0", "gives 'G0'; a Run is wanted"),
    "kinds of a float": (run(kind=RUN.kind.astype(float)), "kind of what it gives is of the type float64; whole"),
    "lists": (run(feed=[1.0]), "; an array of numpy is wanted"),
    "pieces": (run(piece=np.zeros(len(RUN))), "piece of what it gives is of the type float64; True and False"),
    "no kind": (run(kind=RUN.kind + 10), "kind of what it gives is 13 at step 0; 10 are there, from 0 on"),
    "short": (run(feed=RUN.feed[1:]), f"feed of what it gives has the shape ({len(RUN) - 1},); ({len(RUN)},)"),
    "flat": (run(start=RUN.feed), "start of what it gives has the shape"),
    "deep": (run(kind=RUN.kind[None]), "kind of what it gives has the shape (1, "),
    "no state": (run(state=-RUN.state - 1), "state of what it gives is -3 at step 0"),
    "no states": (run(states=()), "state of what it gives is 2 at step 0; 0 are there"),
    "a state": (run(states=(3,)), "states[0] of what it gives is 3; a State"),
    "the coolant": (run(states=(dataclasses.replace(RUN.states[0], coolant="q"),)), "states[0].coolant of what"),
    "no file": (run(file=np.ones(len(RUN), int)), "file of what it gives is 1 at step 0; 1 are"),
    "remarks": (run(remarks=("q",)), "remarks[0] of what it gives is 'q'; a Remark"),
}  # fmt: skip


@pytest.mark.parametrize("run_of", RUNS)
def test_runs_are_such_in_every_array(run_of: str) -> None:
    given, words = RUNS[run_of]
    assert words in told(Control, "read", lambda *_: given)
    assert len(of(Control, lambda *_: RUN).read(TEXT)) == len(RUN)


def test_files_of_a_control_have_names_and_texts() -> None:
    assert "'../a' is no plain file name" in told(Control, "files", lambda *_: {"../a": "G0"})
    assert "'a/b' is no plain file name" in told(Control, "tool_table", lambda *_: ("a/b", ""))
    assert "cannot be written: surrogates not allowed" in told(Control, "write", lambda *_: "\ud800")
    assert of(Control, lambda *_: ("", "")).tool_table(()) == ("", "")


class Fast(Lookahead):
    """Has no time."""

    def __init__(self, gives: Any) -> None:
        self.gives = gives

    def motion(self, run: Any, machine: Any) -> Any:
        return self.gives() if callable(self.gives) else self.gives


@pytest.mark.parametrize(
    ("gives", "words"), [(3, "gives 3; a Motion is wanted"), (sys.exit, "ends the program by sys.exit")]
)
def test_a_lookahead_is_still_the_plugins(gives: Any, words: str) -> None:
    found = of(Control, lambda *_: Fast(gives)).lookahead
    with pytest.raises(MechwrightError) as caught:
        found.motion(RUN, JOB.settings.machine)
    said = f"plugin bad of bad-mechanisms: control bad: lookahead: motion(): {words}"
    assert str(caught.value).startswith(said)


@pytest.mark.parametrize(
    ("check", "words"),
    [
        (None, "gives None; a Check is wanted"),
        (Check("no", "q"), "passed of what it gives is 'no'; True or False"),  # type: ignore[arg-type]
        (Check(np.bool_(True), "q"), "; True or False of Python is wanted"),  # type: ignore[arg-type]
        (Check(True, 3), "message of what it gives is 3; a text"),  # type: ignore[arg-type]
        (Check(True, "a\nb"), "one line is wanted"),
        (Check(True, "a", value="q"), "value of what it gives is 'q'; a number or None"),  # type: ignore[arg-type]
        (Check(True, "a", at=(0.0, 1.0)), "a tuple of 3"),  # type: ignore[arg-type]
    ],
)
def test_checks_are_such_in_every_field(check: Any, words: str) -> None:
    assert words in told(Rule, "check", lambda *_: check)


SCHEMAS: dict[str, tuple[Any, str]] = {
    "no JSON": ({"default": {1, 2}}, "it['default'] is {1, 2}; something of JSON"),
    "a key": ({"a": {3: 4}}, "it['a'] has the key 3; a text"),
    "no names": ({"properties": [3]}, "it['properties'] is [3]; schemas by name"),
    "no schema": ({"properties": {"a": 3}}, "it['properties']['a'] is 3; a schema"),
    "nowhere": ({"items": {"$ref": "#/$defs/a"}}, "it['items'] refers to '#/$defs/a', which is not"),
    "alternatives": ({"anyOf": [3]}, "it['anyOf'][0] is 3; a schema"),
}
ENDLESS: dict[str, Any] = {}
ENDLESS["items"] = ENDLESS


@pytest.mark.parametrize("schema", SCHEMAS)
def test_schemas_are_some(schema: str) -> None:
    given, words = SCHEMAS[schema]
    assert words in told(Table, "schema", lambda *_: given)
    assert "without an end" in told(Table, "file_schema", lambda *_: ENDLESS)


def test_lines_and_parts_of_a_table_are_some() -> None:
    assert "gives lines that are no TOML: " in told(Table, "text", lambda *_: ["[bad", "a = 1"])
    assert "among its lines, which is several" in told(Table, "first", lambda *_: ["a = 1\nb = 2"])
    assert "[0] of what it gives is 3; a Part is wanted" in told(Table, "parts", lambda *_: [3])
    around = Surroundings(places={"p": Place((0.0, 0.0))})  # type: ignore[arg-type]
    assert "places['p'].origin of what it gives is (0.0, 0.0); a tuple of 3" in told(
        Table, "surroundings", lambda *_: around
    )
    assert "[1]['a'] of what it gives is 'b'; a Path" in told(Table, "carried", lambda *_: (3, {"a": "b"}))
    assert of(Table, lambda *_: {"a": Path("a")}).inputs(3, Path("d.toml")) == {"a": Path("a")}


ATTRIBUTES = [
    (Control, "offsets", 3, "offsets is 3; an OffsetTables is wanted"),
    (Control, "taps", ["rigid"], "taps is ['rigid']; a frozenset is wanted"),
    (Control, "tolerances", (0.1, "q"), "tolerances[1] is 'q'; a number is wanted"),
    (Control, "units", "furlong", "units is 'furlong'; one of 'mm', 'inch' is wanted"),
    (Control, "decimals", 2.5, "decimals is 2.5; a whole number is wanted"),
    (Table, "settings", int, "settings is <class 'int'>; a class of the kind Parameters or None is wanted"),
    (Table, "lender", "yes", "lender is 'yes'; True or False is wanted"),
]


@pytest.mark.parametrize(("contract", "name", "value", "words"), ATTRIBUTES)
def test_attributes_are_what_the_contract_declares(contract: Any, name: str, value: Any, words: str) -> None:
    own = {"name": "bad", "title": "Bad", "suffix": ".b", name: value}
    assert unstated(contract, type("Bad", (contract,), own)) == words


def test_whatever_is_built_in_is_so_too_and_nothing_is_left_out() -> None:
    for contract, registered in host().registered.items():
        if contract.guarded:
            assert [unstated(contract, type(one.item)) for one in registered.values()] == [""] * len(
                registered
            )
            assert all(gives(contract, method) is not None for method in methods_of(contract))
