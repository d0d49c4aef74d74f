"""What a plugin gives is of the kinds that its contract declares, down to the last field, before anybody reads it."""

import dataclasses
import functools
import math
import re
import signal
import sys
import time
import types
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Annotated, Any, TypeVar

import foreign_plugin
import numpy as np
import pytest
from procedural import Procedural
from test_guard import Size, moved, plate

from mechwright.contracts import guard
from mechwright.contracts.declared import Declared, shown
from mechwright.contracts.family import Family
from mechwright.contracts.finding import Finding
from mechwright.contracts.guard import CalledLater, UnsoundError
from mechwright.contracts.load import Load
from mechwright.contracts.motion import Channel, Curve, Motion, Poses, Scalar, Trace
from mechwright.contracts.part import Instance, Part
from mechwright.contracts.plugin import Plugin
from mechwright.contracts.synthesis import Candidate, Synthesis
from mechwright.contracts.target import Target
from mechwright.errors import GeometryError, MechwrightError, PluginFaultError
from mechwright.plugins.host import Registered

WHO = "plugin bad of bad-mechanisms: family bad: "


class Told(Procedural[Size]):
    """Gives what it is told to give, whatever it is asked."""

    name = "bad"
    title = "Bad"
    summary = "Gives what it is told to."
    Params = Size
    gives: Any = None

    def found(self, params: Size) -> Any:
        return self.gives

    def solve(self, params: Size, samples: int) -> Any:
        return self.gives

    def parts(self, params: Size) -> Any:
        return self.gives() if callable(self.gives) else self.gives

    def stretches(self, params: Size, samples: int) -> Any:
        return self.gives

    def mounting(self, params: Size) -> Any:
        return self.gives

    def transmission(self, params: Size) -> Any:
        return self.gives

    def settings(self, params: Size) -> Any:
        return self.gives

    def as_made(self, params: Size, made: Any) -> Any:
        return self.gives

    def tolerances(self, params: Size, tolerances: Any) -> Any:
        return self.gives

    def synthesise(self, kind: str, requirement: Any, progress: Any) -> Any:
        return self.gives

    def measures(self, params: Size) -> Any:
        return self.gives

    def targets(self, kind: str, requirement: Any) -> Any:
        return self.gives

    def breaks(self, params: Size) -> Any:
        return self.gives


ARGUMENTS: dict[str, tuple[Any, ...]] = {
    "solve": (Size(), 5),
    "stretches": (Size(), 5),
    "as_made": (Size(), {}),
    "tolerances": (Size(), None),
    "synthesise": ("kind", Size(), None),
    "targets": ("kind", Size()),
}


def family(gives: Any) -> Told:
    found = Registered(Told(), "bad-mechanisms", "bad").item
    found.gives = gives
    return found


def told(method: str, gives: Any) -> str:
    with pytest.raises(MechwrightError) as caught:
        getattr(family(gives), method)(*ARGUMENTS.get(method, (Size(),)))
    said = str(caught.value)
    assert said.startswith(f"{WHO}{method}(): "), said
    assert len(said.splitlines()) == 1
    return said.removeprefix(f"{WHO}{method}(): ")


def changed(**fields: Any) -> list[Part]:
    return [dataclasses.replace(plate(), **fields)]


class Wordless:
    def __repr__(self) -> str:
        raise ValueError


PARTS: dict[str, tuple[list[Part], str]] = {
    "a height in words": (
        changed(instances=(Instance("b", "q"),)),
        "instances[0].z of what it gives is 'q'; a number",
    ),
    "no height": (changed(instances=(Instance("b", math.nan),)), "z of what it gives is nan; a number"),
    "far off": (
        changed(instances=(Instance("b", 1e30),)),
        "part 'plate' has something 1e+30 mm away from the origin",
    ),
    "copies that are words": (changed(instances=("b",)), "instances[0] of what it gives is 'b'; an Instance"),
    "no copies": (changed(instances=None), "instances of what it gives is None; a tuple"),
    "a list, which has no hash": (changed(instances=[Instance("b")]), "; a tuple of Instance is wanted"),
    "colours": (changed(colour=("a", 0.0, 0.0)), "colour[0] of what it gives is 'a'; a number"),
    "bright": (changed(colour=(7.0, 0.0, 0.0)), "part 'plate' has the colour (7.0, 0.0, 0.0)"),
    "two shares": (changed(colour=(0.0, 0.0)), "a tuple of 3"),
    "features": (
        changed(machined=("x",)),
        "machined[0] of what it gives is 'x'; a Profile or a Bore or a Pocket",
    ),
    "details": (
        changed(details=(3,)),
        "details[0] of what it gives is 3; a Chamfer or a Thread or an Engraving",
    ),
    "material": (changed(material="cheese"), "part 'plate' is of 'cheese'; materials are 1.4301, "),
    "short float": (changed(thickness=np.float32(5)), "a number of Python is wanted"),
    "complex": (changed(instances=(Instance("b", 1j),)), "is 1j; a number"),
    "wordless": (changed(marks=(Wordless(),)), "marks[0] of what it gives is a Wordless; "),
    "twins": ([plate(), plate()], "two parts are called 'plate'"),
}


@pytest.mark.parametrize("parts", PARTS)
def test_parts_are_such_in_every_field(parts: str) -> None:
    gives, words = PARTS[parts]
    assert words in told("parts", gives)


def of_motion(**more: Any) -> Motion:
    poses = {"b": Poses.planar(0.0, 0.0, np.zeros(5))}
    return dataclasses.replace(moved(5), poses=poses, **more)


MOTIONS: dict[str, tuple[Motion, str]] = {
    "label": (moved(5, scalars={"a": Scalar(1.0, 3)}), "scalars['a'].unit of what it gives is 3; a text"),
    "short": (moved(5, scalars={"a": Scalar(np.float32(1), "mm")}), "a number of Python"),
    "trace": (
        of_motion(traces={"p": Trace("b", (1.0, "x", 0.0))}),
        "traces['p'].point[1] of what it gives is 'x'",
    ),
    "curve": (
        of_motion(curves={"c": Curve("b", np.full((2, 3), np.nan))}),
        "points of what it gives is nan at",
    ),
    "masked": (
        dataclasses.replace(moved(5), channels={**moved(5).channels, "y": Channel(np.ma.zeros(5), "mm")}),
        "an array of numpy is wanted",
    ),
    "load": (of_motion(loads={"l": Load("b", share=np.zeros(5, complex))}), "is of the type complex128"),
    "far": (
        dataclasses.replace(moved(5), poses={"b": Poses.planar(1e9, 0.0, np.zeros(5))}),
        "body 'b' is 1e+09 mm away from the origin",
    ),
}


@pytest.mark.parametrize("motion", MOTIONS)
def test_motions_are_such_in_every_field(motion: str) -> None:
    gives, words = MOTIONS[motion]
    assert words in told("solve", gives)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("code", None),
        ("message", 3),
        ("value", math.inf),
        ("limit", np.int64(3)),
        ("stage", "parts!"),
        ("fix", 3),
    ],
)
def test_findings_are_such_in_every_field(field: str, value: Any) -> None:
    note = Finding.note("a.b", "x")
    object.__setattr__(note, field, value)
    assert f"[0].{field} of what it gives is " in told("check", [note])


@pytest.mark.parametrize(
    "method",
    ["mounting", "transmission", "settings", "as_made", "tolerances", "synthesise", "measures", "targets",
     "breaks", "stretches"],
)  # fmt: skip
@pytest.mark.parametrize(
    "junk", [3, "text", [None], {"a": object()}], ids=["a number", "a text", "a list", "a dictionary"]
)
def test_every_method_of_a_family_gives_what_is_declared(method: str, junk: object) -> None:
    assert "is wanted" in (said := told(method, junk)) or "are wanted" in said


def test_what_is_deep_in_a_synthesis_is_named() -> None:
    found = Synthesis((Candidate(Size(), Scalar(0.0, "mm"), {"a": 3}),))
    assert told("synthesise", found) == "candidates[0].figures['a'] of what it gives is 3; a Scalar is wanted"
    assert "place[1] of what it gives is 'y'" in told("targets", [Target("p", (1.0, "y"), dict)])


def test_stretches_are_motions() -> None:
    given = family(iter([moved(5), 3])).stretches(Size(), 10)
    next(given)
    with pytest.raises(PluginFaultError, match=r"family bad: stretches\(\): gives 3; a Motion is wanted"):
        next(given)


class Own(BaseException):
    """None of those that anybody expects."""


class MuteError(Exception):
    """Has no words."""

    def __str__(self) -> str:
        raise ValueError


@pytest.mark.parametrize("error", [GeneratorExit, Own, StopIteration, MuteError])
def test_no_kind_of_error_passes_by(error: type[BaseException]) -> None:
    def raises() -> None:
        raise error

    assert told("parts", raises).startswith(error.__name__)


def test_what_builds_a_solid_later_is_still_the_plugins() -> None:
    def given(function: Callable[[], Any]) -> Part:
        parts = family(lambda: [Part("knob", None, 0.0, "steel", build=function)]).parts(Size())
        return dataclasses.replace(parts[0], colour=(0.0, 0.0, 0.0))  # by somebody who adds to it

    with pytest.raises(
        PluginFaultError, match=r"family bad: parts\(\): the solid of part 'knob': ZeroDivisionError"
    ):
        given(lambda: 1 / 0).build()
    with pytest.raises(PluginFaultError, match=r"the solid of part 'knob': ends the program by sys.exit"):
        given(sys.exit).build()
    with pytest.raises(GeometryError, match=r"family bad: parts\(\): the solid of part 'knob': too thin"):
        given(lambda: (_ for _ in ()).throw(GeometryError("too thin"))).build()
    one, other = given(foreign_plugin.run), given(foreign_plugin.run)
    assert one == other
    assert hash(one) == hash(other)
    assert isinstance(Part("knob", None, 0.0, "steel", build=foreign_plugin.run).build, CalledLater)


@dataclasses.dataclass
class Odd:
    things: Mapping[str, tuple[int, ...]]
    what: "int | str | None"
    unknown: "NotThere"  # noqa: F821 - as imports for type checkers are


@pytest.mark.parametrize(
    ("value", "kind", "words"),
    [
        (1, float, None),
        (True, int, ("", "is True; a whole number is wanted")),
        (math.inf, float, ("", "is inf; a finite number is wanted")),
        (Odd({"a": (1, 2)}, None, 3), Odd, None),
        (Odd({"a": (1, "b")}, None, 3), Odd, (".things['a'][1]", "is 'b'; a whole number is wanted")),
        (Odd({}, 2.5, 3), Odd, (".what", "is 2.5; a whole number or a text or None is wanted")),
        ("text", Sequence[str], ("", "is 'text'; a sequence is wanted")),
        (3, Iterator[int], ("", "is 3; an iterator is wanted")),
        (3, Callable[[], int], ("", "is 3; something to call is wanted")),
    ],
)
def test_kinds(value: object, kind: Any, words: tuple[str, str] | None) -> None:
    assert Declared().fault(value, kind) == words


def test_words_of_a_value_are_few_and_come_whatever_it_does() -> None:
    assert len(shown("x" * 10_000)) == 80
    assert shown(Wordless()) == "a Wordless"
    assert Declared(finite=False).fault(math.inf, float) is None
    assert Declared(finite=False).fault(math.nan, float) == ("", "is nan; a number is wanted")


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="the system has no alarm")
def test_the_end_of_the_time_is_told_whatever_is_made_of_it(monkeypatch: pytest.MonkeyPatch) -> None:
    def waits() -> None:
        try:
            time.sleep(5)
        except BaseException:
            raise ImportError("initialization failed") from None

    monkeypatch.setenv(guard.LIMIT, "0.05")
    assert told("parts", waits).startswith("takes more than 0.05 s; ")


def test_a_method_is_guarded_whatever_it_is_and_wherever_from() -> None:
    """Under another name, in a cache, of a base that is no plugin, static, or an object that can be called."""

    def elsewhere(self: object, params: object) -> Any:
        return 3

    class Mixed:
        def parts(self, params: Size) -> Any:
            return 3

    class Called:
        def __call__(self, params: object) -> Any:
            return 3

    def made(*bases: type, **own: Any) -> Any:
        check = {"check": lambda self, params: [], "solve": lambda self, params, n: moved(n)}
        cls = type("Odd", (*bases, Family), {**vars_of(Told), **check, **own})
        return Registered(cls(), "bad-mechanisms", "bad").item

    for family in (
        made(parts=elsewhere),
        made(parts=functools.cache(elsewhere)),
        made(Mixed),
        made(parts=staticmethod(lambda params: 3)),
        made(parts=Called()),
        made(parts=functools.partialmethod(elsewhere)),
    ):
        with pytest.raises(
            PluginFaultError, match=rf"^{re.escape(WHO)}parts\(\): gives 3; a sequence of Part is wanted"
        ):
            family.parts(Size())
    with pytest.raises(PluginFaultError, match=rf"^{re.escape(WHO)}parts\(\): TypeError"):
        made(parts=None).parts(Size())


def vars_of(cls: type[Told]) -> dict[str, Any]:
    return {name: getattr(cls, name) for name in ("name", "title", "summary", "Params")}


class TypeAliasType:
    """What Python 3.12 has of this name."""

    def __init__(self, value: Any) -> None:
        self.__value__ = value

    def __getitem__(self, kinds: Any) -> Any:
        return types.GenericAlias(self, kinds)  # type: ignore[arg-type]


def test_a_name_for_a_kind_is_the_kind() -> None:
    """From Python 3.12 on numpy has its arrays so."""
    width = TypeVar("width")
    several = TypeAliasType(tuple[width, ...])
    named = TypeAliasType(Mapping[str, np.ndarray[Any, np.dtype[np.float64]]])
    for kind in (several, several[float]):
        assert Declared().fault((1.0, 2.0), kind) is None
        assert Declared().fault([1.0], kind) == ("", "is [1.0]; a tuple is wanted")
    assert Declared().fault((1.0, "x"), several[float]) == ("[1]", "is 'x'; a number is wanted")
    number = TypeVar("number", bound=np.generic)
    array = TypeAliasType(np.ndarray[Any, np.dtype[number]])
    assert Declared().fault(np.zeros(2, dtype=bool), array[np.bool_]) is None
    said = "is of the type float64; True and False are wanted"
    assert Declared().fault(np.zeros(2), array[np.bool_]) == ("", said)
    assert Declared().fault({"a": np.zeros(2)}, named) is None
    assert Declared().fault({"a": (0.0,)}, named) == ("['a']", "is (0.0,); an array of numpy is wanted")


def at_least(answer: float, least: float) -> None:
    if answer < least:
        raise UnsoundError(f"gives {answer}; {least} is the least")


def test_a_contract_says_all_of_an_answer_in_its_annotation() -> None:
    class Process(Plugin):
        def kerf(self, least: float) -> Annotated[float, Declared(finite=False), at_least]:
            return least

    laser: Any = type("Laser", (Process,), {"width": math.inf, "kerf": lambda self, _: self.width})()
    assert laser.kerf(0.2) == math.inf
    for laser.width, words in ((0.1, "gives 0.1; 0.2 is the least"), ("q", "gives 'q'; a number is wanted")):
        with pytest.raises(PluginFaultError, match=words):
            laser.kerf(0.2)
