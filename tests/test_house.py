"""The house stays a house: no circles of imports, small files, and a wheel with every room in it."""

import ast
import importlib.util
import re
import statistics
from collections import Counter

from architecture import IMAGE, draw
from hatchling.builders.wheel import WheelBuilder
from imported import ROOT, circles, imports, sources

LONGEST = 400
"""Lines of a file."""
MEDIAN = 120
"""Lines of the file in the middle."""


def test_no_files_import_each_other_in_a_circle():
    graph = imports()
    assert len(graph) > 400
    assert circles(graph) == []


def test_imports_are_seen_wherever_they_stand():
    graph = imports()
    assert "mechwright.contracts.family" in graph["mechwright.plugins.host"], "one inside a method"
    assert "mechwright.contracts.answers" in graph["mechwright.contracts.family"], "one that only types need"
    assert "mechwright.contracts.family" in graph["mechwright_geneva.family"], "one of a public name"
    assert "mechwright_cad.exporters.step" in graph["mechwright_cad.exporters.formats"], "one of a module"


def test_circles_are_found_however_long_they_are():
    graph = {"a": {"b"}, "b": {"c"}, "c": {"a", "d"}, "d": {"e"}, "e": {"d"}, "f": {"a"}, "g": set()}
    assert circles({name: frozenset(wanted) for name, wanted in graph.items()}) == [
        ["a", "b", "c"],
        ["d", "e"],
    ]


def test_files_are_small():
    lines = {name: len(path.read_text(encoding="utf-8").splitlines()) for name, path in sources().items()}
    assert {name: count for name, count in lines.items() if count > LONGEST} == {}
    assert statistics.median(lines.values()) <= MEDIAN


def test_benchmarks_import_what_there_is():
    """Most of them run by hand; what they import from the house is looked up here."""
    wrong = []
    for path in sorted((ROOT / "benchmarks").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("mechwright"):
                module = importlib.import_module(node.module)
                wrong += [
                    f"{path.name}: {node.module}.{one.name}"
                    for one in node.names
                    if not hasattr(module, one.name)
                    and importlib.util.find_spec(f"{node.module}.{one.name}") is None
                ]
    assert wrong == []


def test_files_beside_the_sources_are_small():
    beside = [
        path
        for folder in ("benchmarks", "docs", "examples", "tests")
        for path in (ROOT / folder).rglob("*.py")
    ]
    assert len(beside) > 300
    lines = {str(path): len(path.read_text(encoding="utf-8").splitlines()) for path in beside}
    assert {name: count for name, count in lines.items() if count > LONGEST} == {}


def test_the_wheel_holds_every_file_of_the_sources():
    # A packager leaves out what .gitignore names, and so would git.
    packed = {file.path for file in WheelBuilder(str(ROOT)).recurse_included_files()}
    missing = {name for name, path in sources().items() if str(path) not in packed}
    own = {name for name in missing if name.split(".")[0] == "mechwright_check"}  # a distribution of its own
    assert missing == own


def test_the_picture_of_the_rooms_is_what_the_imports_say():
    assert IMAGE.read_text(encoding="utf-8") == draw(), "python docs/architecture.py draws it anew"


def test_every_room_is_in_the_picture_once():
    titles = Counter(re.findall(r'class="room"[^>]*>(\w+)<', draw()))
    rooms = {name.split(".")[1] for name in sources() if name.startswith(("mechwright.", "mechwright_cam."))}
    assert rooms <= titles.keys()
    twice = {"plugin", "testing"}  # rooms of that name stand in the core and in CAM
    assert {name for name, count in titles.items() if count > 1} == twice


def test_the_page_on_the_rooms_names_every_room_and_only_places_that_are_there():
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    named = set(re.findall(r"`([\w./*]+)`", page))
    rooms = {name.split(".")[1] for name in sources() if name.startswith(("mechwright.", "mechwright_cam."))}
    assert sorted(rooms - named - {"__main__"}) == []
    places = {name for name in named if re.match(r"(core|cam|plugins|docs|tests)/", name)}
    assert len(places) > 10
    imagined = {"cam/mechwright_laser", "plugins/mechwright_NAME"}
    assert sorted(name for name in places - imagined if not list(ROOT.glob(name))) == []
