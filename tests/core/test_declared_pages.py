"""What pages, inspections and exporters of somebody else give is what their contracts declare."""

import sys
from collections.abc import Iterator
from typing import Any

import pytest

from mechwright.contracts.exporter import Exporter
from mechwright.contracts.finding import Finding, Stage
from mechwright.contracts.plugin import Plugin
from mechwright.errors import PluginFaultError
from mechwright.pipeline.inspection import Inspection
from mechwright.pipeline.page import Page
from mechwright.plugins.host import Registered


class Files(Page):
    name = "files"
    commands = frozenset({"solve"})
    gives: Any = None

    def files(self, build: Any) -> Any:
        return self.gives


class Looks(Inspection):
    name = "looks"
    stage = Stage.PARTS
    gives: Any = None

    def findings(self, build: Any) -> Any:
        return self.gives


class Shapes(Exporter):
    name = "shapes"
    suffix = ".s"
    gives: Any = None

    def part(self, part: Any) -> Any:
        return self.gives


def registered(plugin: Any, gives: Any) -> Any:
    found = Registered(plugin, "bad-mechanisms", "bad").item
    found.gives = gives
    return found


@pytest.mark.parametrize(
    ("gives", "words"),
    [
        (None, "gives None; a mapping is wanted"),
        (3, "gives 3; a mapping is wanted"),
        ([("a", "b")], "a mapping is wanted"),
        ({"a.txt": None}, r"\['a.txt'\] of what it gives is None; a text or bytes or an iterable is wanted"),
        ({1: "x"}, r"\[1\] of what it gives is 1; a text is wanted"),
        ({"../x": b""}, "'../x' is no plain file name"),
        ({"a\nb": b""}, r"'a\\nb' is no plain file name"),
        ({"a.txt": "\udcff"}, "the text of 'a.txt' cannot be written: surrogates not allowed"),
    ],
)
def test_pages(gives: object, words: str) -> None:
    with pytest.raises(
        PluginFaultError, match=rf"^plugin bad of bad-mechanisms: page files: files\(\): .*{words}"
    ):
        registered(Files(), gives).files(None)


@pytest.mark.parametrize(
    ("last", "words"),
    [(lambda: 3, "gives 3 among its pieces; bytes are wanted"), (sys.exit, "ends the program")],
)
def test_pieces_of_a_page_are_asked_for_under_the_guard(last: Any, words: str) -> None:
    def given() -> Iterator[object]:
        yield b"one"
        yield last()

    found = registered(Files(), {"a.txt": given()}).files(None)["a.txt"]
    assert next(found) == b"one"
    with pytest.raises(PluginFaultError, match=rf"page files: files\(\): 'a.txt': {words}"):
        next(found)


def test_texts_and_bytes_stay_what_they_are() -> None:
    assert registered(Files(), {"a": "text", "b": b"bytes"}).files(None) == {"a": "text", "b": b"bytes"}


@pytest.mark.parametrize("gives", [None, 3, [None], "text", iter([3])])
def test_inspections(gives: object) -> None:
    with pytest.raises(PluginFaultError, match=r"inspection looks: findings\(\): .* is wanted"):
        registered(Looks(), gives).findings(None)


def test_findings_that_come_one_by_one_are_gathered() -> None:
    note = Finding.note("a.b", "x")
    assert registered(Looks(), iter([note])).findings(None) == (note,)


@pytest.mark.parametrize("gives", [3, "text", [b"one"]])
def test_exporters(gives: object) -> None:
    with pytest.raises(PluginFaultError, match=r"exporter shapes: part\(\): .*; bytes or None is wanted"):
        registered(Shapes(), gives).part(None)


def test_a_contract_that_checks_answers_in_the_earlier_way_is_refused_by_name() -> None:
    class Dance(Plugin):
        kind = "dance"

        @classmethod
        def sound(cls, method: str, answer: Any, arguments: tuple[Any, ...]) -> Any:
            return answer

    class Waltz(Dance):
        name = "waltz"

    assert Waltz.fault() == "its contract has sound; annotations of its methods say what they give"
