"""Nothing that others write into their files and programs goes away in silence: docs/deprecation.md."""

import json
from pathlib import Path

import pytest
from promised_names import LIST, names

ROOT = Path(__file__).parents[1]


def told(text: str, name: str) -> bool:
    """Whether a text names what is gone: a key by its last word, a code, a command with its option."""
    short = name.rpartition(": ")[2]
    return any(
        f"`{one}`" in text for one in (name, short, short.rpartition(".")[2], short.rpartition(" ")[2])
    )


def gone(promised: dict[str, list[str]], there: dict[str, list[str]], text: str) -> list[str]:
    """What was promised, is not there, and is named in no change."""
    return [
        f"{kind}: {name}"
        for kind, every in promised.items()
        for name in every
        if name not in there[kind] and not told(text, name)
    ]


def test_every_name_that_is_gone_is_named_in_a_change():
    """A name of the list went away: say in a fragment `changed` or `removed`, in backticks, what takes its place."""
    fragments = [*ROOT.glob("changelog.d/+*.removed.md"), *ROOT.glob("changelog.d/+*.changed.md")]
    text = "".join(path.read_text(encoding="utf-8") for path in (*fragments, ROOT / "CHANGELOG.md"))
    assert gone(json.loads(LIST.read_text(encoding="utf-8")), names(), text) == []


@pytest.mark.parametrize(
    ("kind", "name", "named"),
    [
        ("commands", "build --also", "`--also` is called `--formats` now."),
        ("keys", "cam.hold.tabs", "`cam.hold.tabs` is called `tab_count` now."),
        ("keys", "geneva: parameters.slots", "The key `slots` is called `stations` now."),
        ("codes", "bore.rim", "The finding `bore.rim` is called `bore.wall` now."),
    ],
)
def test_a_name_that_goes_away_is_found(kind, name, named):
    promised = json.loads(LIST.read_text(encoding="utf-8"))
    assert name in promised[kind]
    less = {**promised, kind: [one for one in promised[kind] if one != name]}
    assert gone(promised, less, "") == [f"{kind}: {name}"]
    assert gone(promised, less, named) == []
