"""What the rules of printing say is typed in as it stands, and the finding is gone."""

import re

import pytest
import tomlkit
from test_print_rules import build, text_of

from mechwright_print.rules.inspection import findings_of

ROOT = "examples"
MEASURED = {"measured": True, "spread": 0.05}


def typed(remedy: str, text: str, tables: dict) -> tuple[str, dict]:
    """A design file and its tables after the first way of a remedy was typed."""
    content = tomlkit.parse(text)
    tables = {name: dict(table) for name, table in tables.items()}
    first = re.split(r", or (?:set|measure)| or set", remedy)[0]
    rows = re.findall(
        r"(\w+) = (\{[^}]*\}|\[[^\]]*\]|\"[^\"]*\"|[-\d.]+)( in \[print\]| in the file of the printer)?",
        first,
    )
    assert rows, remedy
    rows = [row for row in rows if f'"{row[0]}" =' not in first]
    for key, value, where in rows:
        parsed = tomlkit.parse(f"{key} = {value}").unwrap()
        if where == " in [print]":
            tables.setdefault("print", {}).update(parsed)
        elif where:
            tables.setdefault("printer", {}).update(parsed)
        else:
            content["parameters"].update(parsed)
    return tomlkit.dumps(content), tables


def example(name: str, request) -> str:
    return (request.config.rootpath / ROOT / f"{name}.toml").read_text()


def told(found, code: str) -> list:
    return [one for one in found if one.code == code]


def teeth(module: float):
    return lambda request: text_of(module)


def of(name: str):
    return lambda request: example(name, request)


CASES = {
    "a module too fine": ("print.thin-wall", teeth(0.5), {"print": {}}),
    "a nozzle too wide for a linkage": (
        "print.thin-wall",
        of("geneva-straight"),
        {"printer": {"nozzle": 1.2, "layer": 0.2}},
    ),
    "heights off the layers": (
        "print.layers",
        of("spur-gears"),
        {"printer": {"layer": 0.28, "first_layer": 0.28}},
    ),
    "a fit as drawn": ("print.fit", of("spur-gears"), {"print": {"fits": "drawn"}}),
    "a shaft that jams turns in a wider hole": (
        "print.jam",
        of("spur-gears"),
        {"print": {"holes": {"gear-1.bore": "sliding"}}, "printer": MEASURED | {"spread": 0.07}},
    ),
    "a shaft that jams in the widest hole is reamed": (
        "print.jam",
        of("spur-gears"),
        {"print": {"holes": {"gear-1.bore": "sliding"}}, "printer": MEASURED | {"spread": 0.4}},
    ),
    "a shaft that rattles runs in a narrower hole": (
        "print.play",
        of("spur-gears"),
        {
            "print": {"holes": {"gear-1.bore": "turning", "gear-2.bore": "turning"}, "greatest_play": 0.4},
            "printer": MEASURED,
        },
    ),
    "a shaft that rattles in every hole is reamed": (
        "print.play",
        of("spur-gears"),
        {"print": {"greatest_play": 0.1}, "printer": MEASURED},
    ),
    "no room for a bush": (
        "print.bush",
        lambda request: text_of(1.2).replace("bore = 3", "bore = 12\nthickness = 10"),
        {"print": {"holes": {"gear-1.bore": "bush"}}},
    ),
    "flanks without room": ("print.backlash", of("spur-gears"), {"printer": MEASURED}),
    "pressed parts": ("print.press", of("cam-slide"), {"print": {"walls": 4}}),
    "no room for an insert": ("print.insert", of("nema-17-plate"), {"print": {"walls": 4}}),
    "play over the spread": ("print.as-made", of("elliptic-pair"), {"printer": MEASURED | {"spread": 0.03}}),
    "plays over a large spread": ("print.as-made", of("geneva-straight"), {"printer": MEASURED}),
    "an error that reaming takes away": (
        "print.error",
        of("four-bar-double-rocker"),
        {"printer": MEASURED, "tolerances": {"limit_length": 0.25}},
    ),
    "an error that a better printer takes away": (
        "print.error",
        of("four-bar-double-rocker"),
        {"printer": MEASURED, "print": {"fits": "ream"}, "tolerances": {"limit_length": 0.12}},
    ),
    "an error that only both take away": (
        "print.error",
        of("four-bar-double-rocker"),
        {"printer": MEASURED, "tolerances": {"limit_length": 0.12}},
    ),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_a_remedy_that_is_typed_takes_the_finding_away(case, request, tmp_path):
    code, source, tables = case
    text = source(request)
    for beside in (request.config.rootpath / ROOT).glob("*.dxf"):
        (tmp_path / beside.name).write_bytes(beside.read_bytes())
    given = {name: dict(table) for name, table in tables.items()}
    found = told(findings_of(build(tmp_path, text, **given)), code)
    assert found
    for _ in range(4):  # parts of one design may have the same fault, each with a line
        if not found:
            break
        text, tables = typed(found[0].remedy, text, tables)
        given = {name: dict(table) for name, table in tables.items()}
        before, found = found, told(findings_of(build(tmp_path, text, **given)), code)
        assert len(found) < len(before) or found[0].message != before[0].message, found
    assert not found


def test_a_limit_that_no_printer_keeps_is_said_to_be_one(request, tmp_path):
    text = example("four-bar-double-rocker", request)
    tables = {"printer": dict(MEASURED), "tolerances": {"limit_length": 0.001}}
    (found,) = told(findings_of(build(tmp_path, text, **tables)), "print.error")
    assert found.remedy == "make its limit in [tolerances] wider: no printer keeps it"
