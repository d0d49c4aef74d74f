"""Words that the glossary drops do not come back into names of modules, public functions and public classes."""

import ast
import re
from collections.abc import Iterator
from functools import cache

import pytest
from imported import ROOT, sources

PAGE = (ROOT / "docs" / "glossary.md").read_text(encoding="utf-8")
ROWS = re.findall(
    r"^\| (`.*?`) \| (.*?) \| (.*?) ?\|$", PAGE.partition("\n## Dropped words\n")[2], re.MULTILINE
)
DROPPED = {word: row for row in ROWS for word in re.findall(r"`(\w+)`", row[0])}
"""Dropped words to their rows."""

KNOWN = {
    "told": 8,
    "said": 4,
    "heard": 1,
    "unheard": 1,
    "asked": 14,
    "asking": 1,
    "wanted": 7,
    "left_out": 4,
    "usual": 3,
    "sized": 7,
    "sizes": 14,
    "held": 6,
    "holds": 3,
    "keeper": 5,
    "made": 41,
    "making": 1,
    "beyond": 5,
    "near": 5,
    "loose": 1,
    "together": 6,
    "beside": 6,
    "stretch": 3,
    "stretches": 17,
    "standing": 9,
    "turning": 21,
    "course": 16,
    "mended": 2,
    "gentler": 2,
    "softer": 1,
    "dealing": 1,
    "many": 2,
    "steady": 2,
}
"""Words that still stand in names, with the number of these names. A number may fall; none may rise or be added."""


def words_of(name: str) -> tuple[str, ...]:
    """The words of a name, in lower case."""
    return tuple(word.lower() for word in re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+", name))


def runs(phrase: str, words: tuple[str, ...]) -> list[int]:
    """Where the words of a phrase follow each other in those of a name."""
    wanted = words_of(phrase)
    return [k for k in range(len(words)) if words[k : k + len(wanted)] == wanted]


def drops(word: str, name: str) -> bool:
    """Whether a name has a dropped word outside of the phrases in which it is right."""
    words = words_of(name)
    right = {
        at + k
        for phrase in re.findall(r"`(\w+)`", DROPPED[word][2])
        for at in runs(phrase, words)
        for k in range(len(words_of(phrase)))
    }
    return any(at not in right for at in runs(word, words))


@cache
def names() -> tuple[str, ...]:
    """Names of modules, and of public functions, methods and classes, each as often as it is defined."""
    found = []
    for module, path in sources().items():
        found.append(module.rpartition(".")[2])
        found += defined(ast.parse(path.read_text(encoding="utf-8")).body)
    return tuple(found)


def defined(body: list[ast.stmt]) -> Iterator[str]:
    for node in body:
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            if not node.name.startswith("_"):
                yield node.name
            if isinstance(node, ast.ClassDef):
                yield from defined(node.body)


def test_the_page_has_the_dropped_words():
    assert len(DROPPED) > 30
    assert {"told", "left_out", "made", "many"} <= set(DROPPED)
    assert [word for word, (_, instead, _) in DROPPED.items() if not instead.strip()] == []
    assert set(KNOWN) <= set(DROPPED)


def test_dropped_words_are_found_in_names():
    assert drops("told", "told_unit")
    assert drops("standing", "StandingFrame")
    assert not drops("made", "as_made_lock")
    assert drops("made", "MadeRing")
    assert drops("left_out", "keys_left_out")
    assert not drops("left_out", "left_wall")
    assert not drops("near", "nearest")


@pytest.mark.parametrize("word", DROPPED)
def test_a_dropped_word_does_not_come_back(word):
    found = [name for name in names() if drops(word, name)]
    instead = DROPPED[word][1]
    assert len(found) <= KNOWN.get(word, 0), f"say {instead} in place of {word}: {sorted(set(found))}"
