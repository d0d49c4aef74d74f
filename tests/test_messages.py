"""Sentences that users get: all are listed, and none begins or speaks as style forbids."""

import re
from collections import Counter

import messages
import pytest

FORBIDDEN = {
    "a bare beginning": re.compile(r"(^|[.;] )(What|So|It|The same|This is) "),
    "nobody": re.compile(r"\bnobody\b"),
    "told": re.compile(r"\b(is|are) told\b"),
    "left out": re.compile(r"(^|[.;] )[Ll]eft out, "),
    "what is left": re.compile(r"\bwhat is left\b"),
}
KNOWN = {"a bare beginning": 0, "nobody": 0, "told": 0, "left out": 0, "what is left": 0}
"""Sentences of each kind that still stand; the number may only fall."""

EVERY = messages.every()


def test_sentences_of_every_kind_are_listed():
    kinds = Counter(one.kind for one in EVERY)
    assert len(EVERY) > 2500
    assert {"description", "remedy", "error", "warning", "help", "DesignError"} <= kinds.keys()
    assert kinds["description"] > 1000
    assert all(one.file.endswith(".py") and one.line > 0 for one in EVERY)


@pytest.mark.parametrize("kind", list(FORBIDDEN))
def test_no_sentence_speaks_so(kind):
    found = [f"{one.file}:{one.line}: {one.text}" for one in EVERY if FORBIDDEN[kind].search(one.text)]
    assert len(found) <= KNOWN[kind], "\n".join(found)
