"""Who imports whom, read from the sources without running them.

Imports inside functions count, and so do those that only types need. A public name that is imported from
``mechwright`` counts as an import of the file that it comes from; the facade's own imports do not, since it
imports nothing until a name is asked for.
"""

import ast
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
TREES = ("core", "cam", "plugins")
"""Folders of the sources; the path below them is the dotted name."""
FACADE = "mechwright"

Graph = Mapping[str, frozenset[str]]
"""Module to the modules that it imports."""


def sources() -> dict[str, Path]:
    """Dotted name to file, of every module of the project."""
    found = {}
    for tree in TREES:
        for path in sorted((ROOT / tree).rglob("*.py")):
            parts = path.relative_to(ROOT / tree).with_suffix("").parts
            found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


@cache
def imports() -> Graph:
    """The imports between the files of the project; other libraries are left out."""
    files = sources()
    homes = _public_names(files[FACADE])
    graph: dict[str, frozenset[str]] = {FACADE: frozenset()}
    for module, path in files.items():
        if module == FACADE:
            continue
        asked = {_module(source, name, files, homes) for source, name in _named(path)}
        graph[module] = frozenset(asked & (files.keys() - {module}))
    return graph


def _module(source: str, name: str, files: Mapping[str, Path], homes: Mapping[str, str]) -> str:
    """The module behind ``from source import name``."""
    inner = f"{source}.{name}"
    if inner in files:
        return inner
    return homes.get(name, source) if source == FACADE else source


def _named(path: Path) -> Iterator[tuple[str, str]]:
    """Module and name of each import of a file; the name is empty where a whole module is imported."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((alias.name, "") for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}:{node.lineno}: imports are absolute"  # noqa: S101
            yield from ((node.module or "", alias.name) for alias in node.names)


def _public_names(facade: Path) -> dict[str, str]:
    """Public name to the module that it comes from."""
    return {name: module for module, name in _named(facade) if module.startswith(f"{FACADE}.")}


def circles(graph: Graph) -> list[list[str]]:
    """The sets of modules that import each other, directly or by way of others; sorted."""
    reached = {module: _reached(graph, module) for module in graph}
    rings = {
        tuple(sorted(other for other in reached[module] if module in reached[other]))
        for module in graph
        if module in reached[module]
    }
    return [list(ring) for ring in sorted(rings)]


def _reached(graph: Graph, module: str) -> set[str]:
    """What a module imports, directly or by way of others."""
    seen: set[str] = set()
    waiting = list(graph[module])
    while waiting:
        one = waiting.pop()
        if one not in seen:
            seen.add(one)
            waiting += graph[one]
    return seen


def reduced(graph: Graph) -> dict[str, frozenset[str]]:
    """The graph, which has no circles, without what follows from others: a → c where a → b and b → c."""
    return {
        module: frozenset(
            one
            for one in wanted
            if not any(one in _reached(graph, other) for other in wanted if other != one)
        )
        for module, wanted in graph.items()
    }
