"""The JSON schemas of design and requirement files, against what reads the files."""

import json
import re
import tomllib
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from mechwright.designs.design import load
from mechwright.designs.requirement import load_requirement
from mechwright.designs.schema import file_schema
from mechwright.errors import MechwrightError, PluginError
from mechwright.plugins.host import host
from mechwright.studies.schema import study_schema

Run = Callable[..., tuple[int, str, str]]
STUDIES = sorted((Path(__file__).parents[2] / "examples").glob("*-study.toml"))
EXAMPLES = [
    path
    for path in sorted((Path(__file__).parents[2] / "examples").glob("**/*.toml"))
    if not path.stem.endswith("-study")
]
OTHERS = ("template", "pyproject", "/shops/")  # shop files have a schema of their own
EXAMPLES = [path for path in EXAMPLES if not any(other in path.as_posix() for other in OTHERS)]
KNOWN = {
    *(
        "$schema",
        "$defs",
        "$ref",
        "title",
        "description",
        "default",
        "unit",
        "first",
        "given",
        "fitted",
        "examples",
    ),
    *("type", "properties", "required", "additionalProperties", "enum", "const", "pattern", "format"),
    *("minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum", "minLength", "maxLength"),
    *("items", "prefixItems", "minItems", "maxItems", "uniqueItems", "anyOf", "allOf", "if", "then"),
}


def faults(value: Any, schema: dict[str, Any], root: dict[str, Any], where: str = "") -> Iterator[str]:
    """What of JSON Schema 2020-12 the schemas use; an unknown keyword is a fault of the test."""
    assert schema.keys() <= KNOWN, f"{where}: {schema.keys() - KNOWN}"
    if "$ref" in schema:
        yield from faults(value, root["$defs"][schema["$ref"].removeprefix("#/$defs/")], root, where)
    kinds = {
        "object": dict,
        "array": list,
        "string": str,
        "boolean": bool,
        "number": (int, float),
        "integer": int,
        "null": type(None),
    }
    kind = schema.get("type")
    if kind and (
        not isinstance(value, kinds[kind])  # type: ignore[arg-type]
        or (kind in {"number", "integer"} and isinstance(value, bool))
    ):
        yield f"{where}: {value!r} is no {kind}"
        return
    if "enum" in schema and value not in schema["enum"]:
        yield f"{where}: {value!r} is none of {schema['enum']}"
    if "const" in schema and value != schema["const"]:
        yield f"{where}: {value!r} is not {schema['const']!r}"
    if isinstance(value, str) and "pattern" in schema and not re.search(schema["pattern"], value):
        yield f"{where}: {value!r} does not fit {schema['pattern']}"
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        checks = {
            "minimum": lambda limit: value >= limit,
            "maximum": lambda limit: value <= limit,
            "exclusiveMinimum": lambda limit: value > limit,
            "exclusiveMaximum": lambda limit: value < limit,
        }
        yield from (
            f"{where}: {value} {k} {schema[k]}"
            for k, ok in checks.items()
            if k in schema and not ok(schema[k])
        )
    size = len(value) if isinstance(value, (str, list)) else 0
    word = "Items" if isinstance(value, list) else "Length"
    if size < schema.get(f"min{word}", 0) or size > schema.get(f"max{word}", size):
        yield f"{where}: {size} entries"
    if isinstance(value, dict):
        yield from _of_table(value, schema, root, where)
    if isinstance(value, list):
        places = schema.get("prefixItems", [])
        for number, item in enumerate(value):
            inner = places[number] if number < len(places) else schema.get("items", {})
            yield from faults(item, inner, root, f"{where}[{number}]")
    if "anyOf" in schema:
        tried = [list(faults(value, one, root, where)) for one in schema["anyOf"]]
        if all(tried):
            yield min(tried, key=len)[0]
    for one in schema.get("allOf", ()):
        if "if" not in one:
            yield from faults(value, one, root, where)
        elif not list(faults(value, one["if"], root, where)):
            yield from faults(value, one["then"], root, where)


def _of_table(value, schema, root, where):
    for key in schema.get("required", ()):
        if key not in value:
            yield f"{where}: {key} is missing"
    rest = schema.get("additionalProperties", True)
    for key, item in value.items():
        if key in schema.get("properties", {}):
            yield from faults(item, schema["properties"][key], root, f"{where}.{key}")
        elif rest is False:
            yield f"{where}: unknown {key}"
        elif isinstance(rest, dict):
            yield from faults(item, rest, root, f"{where}.{key}")


@cache
def schema_of(family, requirement):
    return file_schema(host(), family, requirement=requirement)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
@pytest.mark.parametrize("single", [True, False])
def test_every_example_is_accepted(path, single):
    content = tomllib.loads(path.read_text(encoding="utf-8"))
    asked = "requirement" in path.stem
    schema = schema_of(content.get("family", "") if single else "", asked)  # a chain has no family of its own
    assert list(faults(content, schema, schema)) == []


HEAD = 'format = 1\nfamily = "four-bar"\n'
WRONG = {
    "unknown key": HEAD + "[parameters]\ncrnk = 3\n",
    "unknown table": HEAD + "[camera]\n",
    "key of another table": HEAD + "[cam]\ncrank = 3\n",
    "below its bound": HEAD + "[parameters]\ncrank = 0.5\n",
    "above its bound": HEAD + "[parameters]\ncrank = 5000\n",
    "a bound of a key that may be left out": HEAD + "[parameters]\nswing_from = 800\nswing_to = 2\n",
    "no choice": HEAD + '[parameters]\nbranch = "up"\n',
    "true": HEAD + "[parameters]\ncrank = true\n",
    "a list": HEAD + "[parameters]\ncrank = [1]\n",
    "a word": HEAD + '[parameters]\ncrank = "wide"\n',
    "format": HEAD.replace("1", "2"),
    "no family": "format = 1\n",
    "a chain of one": 'format = 1\n[[stage]]\nfamily = "geneva"\n',
    "a stage's key": 'format = 1\n[[stage]]\nfamily = "geneva"\n[[stage]]\nfamily = "geneva"\nbegin = 3\n',
    "unknown family": 'format = 1\nfamily = "six-bar"\n',
    "name": HEAD + 'name = "Ä/b"\n',
    "nested": 'family = "spherical"\n[parameters.hardware]\npin = 3\n',
    "excluded bound": 'family = "spherical"\n[parameters]\nkind = "four-bar"\n[parameters.four_bar]\nground = 180\n',
    "too few of a list": 'family = "spherical"\n[parameters.five_bar]\na1 = [1.0]\n',
    "a part's table": HEAD + "[cam.part.crank]\norigin = 3\n",
    "a contributor's table": HEAD + "[tolerances.of.crank]\nlowest = 3\n",
    "tolerances": HEAD + '[tolerances]\ngeneral = "rough"\n',
    "parameters are no table": HEAD + "parameters = 3\n",
}


@pytest.mark.parametrize("case", WRONG)
def test_what_a_schema_can_say_is_refused_by_both(case, tmp_path):
    content = tomllib.loads(WRONG[case])
    family = content.get("family", "")
    schema = file_schema(host(), family if family in ("four-bar", "spherical") else "")
    assert list(faults(content, schema, schema))
    path = tmp_path / "d.toml"
    path.write_text(WRONG[case])
    with pytest.raises(MechwrightError):
        load(path, host())


def test_quantities_with_units_and_left_out_keys_are_accepted(tmp_path):
    text = HEAD + '[parameters]\ncrank = "1/4 m"\nground = "400 mm"\nfollower = 300\ncoupler = "35 cm"\n'
    path = tmp_path / "d.toml"
    path.write_text(text + '[cam]\nmachine = "shapeoko"\n' if False else text)
    load(path, host())
    content = tomllib.loads(text)
    schema = file_schema(host(), "four-bar")
    assert list(faults(content, schema, schema)) == []


def test_a_requirement_is_checked_by_its_kind(tmp_path):
    text = 'family = "four-bar"\n[requirement]\nkind = "{}"\n{}\n'
    schema = file_schema(host(), "four-bar", requirement=True)
    for kind, line, good in (
        ("path", "tolerance = 0.1", True),
        ("path", "toleranz = 1", False),
        ("x", "", False),
    ):
        content = tomllib.loads(text.format(kind, line))
        assert (list(faults(content, schema, schema)) == []) == good
        path = tmp_path / "r.toml"
        path.write_text(text.format(kind, line))
        if good:
            load_requirement(path, host())
        else:
            with pytest.raises(MechwrightError):
                load_requirement(path, host())


def test_an_unknown_family_and_one_without_synthesis_are_named(monkeypatch):
    with pytest.raises(PluginError, match="six-bar"):
        file_schema(host(), "six-bar")


NODES = {"properties": dict, "$defs": dict}
LISTS = {"anyOf", "allOf", "prefixItems"}
VALUES: dict[str, tuple[type, ...]] = {
    **dict.fromkeys(("$schema", "$ref", "title", "description", "unit", "pattern", "format"), (str,)),
    **dict.fromkeys(("minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"), (int, float)),
    **dict.fromkeys(("minLength", "maxLength", "minItems", "maxItems"), (int,)),
    **dict.fromkeys(("first", "fitted", "uniqueItems"), (bool,)),
    **dict.fromkeys(("required", "enum", "examples"), (list,)),
    **dict.fromkeys(("items", "if", "then"), (dict,)),
    **dict.fromkeys(("additionalProperties",), (dict, bool)),
}


def ill_formed(schema: Any, where: str) -> Iterator[str]:
    """What the meta-schema of draft 2020-12 forbids, and what a reader of draft 7 would take otherwise."""
    if not isinstance(schema, dict):
        yield f"{where} is no schema: {schema!r}"
        return
    for key, value in schema.items():
        if key not in KNOWN:
            yield f"{where}: {key}"
        if key in VALUES and (
            not isinstance(value, VALUES[key]) or (isinstance(value, bool) and bool not in VALUES[key])
        ):
            yield f"{where}.{key}: {value!r}"
        if key == "type" and value not in {"object", "array", "string", "boolean", "number", "integer"}:
            yield f"{where}.type: {value!r}"
        if key in {"enum", *LISTS} and not value:
            yield f"{where}.{key} is empty"
        if key in {"required", "enum"} and len({repr(one) for one in value}) < len(value):
            yield f"{where}.{key} says one twice"
        if key == "pattern":
            re.compile(value)
        if key in NODES:
            for name, one in value.items():
                yield from ill_formed(one, f"{where}.{name}")
        if key in LISTS:
            for number, one in enumerate(value):
                yield from ill_formed(one, f"{where}.{key}[{number}]")
        if key in {"items", "if", "then"} or (key == "additionalProperties" and not isinstance(value, bool)):
            yield from ill_formed(value, f"{where}.{key}")
    if "prefixItems" in schema and "items" in schema:
        yield f"{where}: items are the rest in draft 2020-12, and all of them in draft 7"
    if "$ref" in schema and not schema.keys() <= {"$ref", "title", "description", "default"}:
        yield f"{where}: beside a reference draft 7 reads nothing"


FAMILIES = ["four-bar", "slider-crank", "geneva", "elliptic-gears", "spherical"]


@pytest.mark.parametrize("requirement", [False, True])
@pytest.mark.parametrize("family", ["", *FAMILIES])
def test_a_schema_is_well_formed(family, requirement):
    assert list(ill_formed(file_schema(host(), family, requirement=requirement), "")) == []


@pytest.mark.parametrize("requirement", [False, True])
@pytest.mark.parametrize("family", FAMILIES)
def test_editors_find_the_keys_of_a_family_without_conditions(family, requirement):
    """They follow properties and references, and neither if nor then."""
    schema = file_schema(host(), family, requirement=requirement)
    assert "allOf" not in schema
    table = schema["properties"]["requirement" if requirement else "parameters"]
    if requirement:
        kinds = [one["properties"]["kind"]["const"] for one in table.get("anyOf", [table])]
        assert kinds == list(host().family(family).requirements)
    else:
        assert list(table["properties"]) == list(host().family(family).Params.model_fields)


def test_no_reference_leads_nowhere():
    for asked in (False, True):
        schema = file_schema(host(), requirement=asked)
        names = set(re.findall(r'"#/\$defs/([^"]+)"', json.dumps(schema)))
        assert names <= schema["$defs"].keys()
        assert names


@pytest.mark.parametrize("whole", [False, True])
@pytest.mark.parametrize("family", FAMILIES)
def test_a_new_file_is_accepted_and_names_its_schema(family, whole, command_line: Run, tmp_path):
    path = tmp_path / "d.toml"
    status, said, _ = command_line("new", family, "-o", path, *(["--all"] if whole else []))
    assert status == 0
    assert f"mechwright schema {family} -o {tmp_path / family}.schema.json" in said
    text = path.read_text()
    assert text.splitlines()[0] == f"#:schema ./{family}.schema.json"
    assert command_line("schema", family, "-o", tmp_path / f"{family}.schema.json")[0] == 0
    schema = json.loads((tmp_path / f"{family}.schema.json").read_text())
    assert list(faults(tomllib.loads(text), schema, schema)) == []
    design = load(path, host())
    assert design.params == host().family(family).draft("", "")
    lines = len(text.splitlines())
    assert (lines > 70) if whole else (lines < 60)
    assert ("--all writes all of them" in text) != whole


def test_a_schema_is_not_replaced_unasked(command_line: Run, tmp_path):
    path = tmp_path / "s.json"
    path.write_text("mine")
    status, _, err = command_line("schema", "-o", path)
    assert (status, path.read_text()) == (2, "mine")
    assert "--force" in err
    assert command_line("schema", "-o", path, "--force")[0] == 0
    assert set(json.loads(path.read_text())["properties"]["family"]["enum"]) >= {"four-bar", "geneva"}


def test_a_requirement_file_has_its_own_schema(command_line: Run):
    status, text, _ = command_line("new", "four-bar", "--requirement", "poles")
    assert text.startswith("#:schema ./four-bar-requirement.schema.json\n")
    schema = json.loads(command_line("schema", "four-bar", "--requirement")[1])
    assert (status, list(faults(tomllib.loads(text), schema, schema))) == (0, [])


@cache
def of_studies(family: str) -> dict[str, Any]:
    """The schema of the studies of a family."""
    return study_schema(host(), family)


@pytest.mark.parametrize("path", STUDIES, ids=lambda path: path.stem)
@pytest.mark.parametrize("one", [True, False], ids=["own", "all"])
def test_studies_keep_to_their_schema(path: Path, one: bool) -> None:
    content = tomllib.loads(path.read_text())
    schema = of_studies(content["family"] if one else "")
    assert list(ill_formed(schema, "")) == []
    assert list(faults(content, schema, schema)) == []


@pytest.mark.parametrize(
    ("table", "key", "value"),
    [
        ("objectives", "swing", "most"),
        ("constraints", "swing", {"above": 3}),
        ("ranges", "crank", {"from": 20, "to": 45}),
        ("ranges", "crank", 20),
    ],
)
def test_what_no_study_may_hold_is_a_fault(table: str, key: str, value: Any) -> None:
    content = tomllib.loads((STUDIES[0].parent / "four-bar-study.toml").read_text())
    content["study"][table] = {key: value}
    assert list(faults(content, of_studies("four-bar"), of_studies("four-bar")))


def test_editors_are_offered_the_columns_and_parameters_of_the_family() -> None:
    asked = of_studies("four-bar")["properties"]["study"]["properties"]
    assert {"swing", "alpha_b_max"} <= set(asked["objectives"]["properties"])
    assert "crank" in asked["ranges"]["properties"]


def test_a_study_asks_for_its_family_and_its_own_table_alone():
    """A design has parameters or stages; of a study what has a range is left out, and chains have none."""
    assert "anyOf" in file_schema(host(), "")
    schema = study_schema(host(), "")
    assert "anyOf" not in schema
    assert schema["required"] == ["family", "study"]
    assert "stage" not in schema["properties"]


@pytest.mark.parametrize(("units", "size"), [("mm", '"5 in"'), ("inch", "5")])
def test_sizes_of_stages_may_have_units_as_others_have(units, size, tmp_path):
    path = tmp_path / "chain.toml"
    stages = '[[stage]]\nfamily = "geneva"\n' * 2
    path.write_text(f'format = 1\nunits = "{units}"\n{stages}[stage.parameters]\ncentre_distance = {size}\n')
    found = [stage.parameters.centre_distance for stage in load(path, host()).params.stage]
    assert found == [None, pytest.approx(127)]
