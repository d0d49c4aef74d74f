"""Every sentence that a user can get, to be read in one go: ``python docs/messages.py [WORD]``.

Collected are findings, rules with their remedies, errors, notes, descriptions of keys and help of commands,
from the source. Values stand in braces. With a word, only sentences that hold it are printed.
"""

import ast
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
SOURCES = ("core", "cam", "plugins")

SAID = {"message", "remedy", "description", "help", "words", "reason"}
"""Keywords whose values users read."""

GIVEN = {"error", "warning", "note"}
"""Methods of a finding, whose third argument is its sentence; of other calls it is the first."""


@dataclass(frozen=True, order=True)
class Message:
    """A sentence: its file from the project's folder, its line, what it is, its text."""

    file: str
    line: int
    kind: str
    text: str


def texts(node: ast.AST) -> Iterator[str]:
    """The texts of strings and f-strings in an expression, values in braces.

    >>> list(texts(ast.parse('lambda m: f"a tip of {m.tip:.2f} mm" if m.tip else "a flat tip"')))
    ['a tip of {m.tip} mm', 'a flat tip']
    """
    if isinstance(node, ast.Constant):
        if isinstance(node.value, str) and " " in node.value.strip():
            yield node.value
    elif isinstance(node, ast.JoinedStr):
        parts = (
            str(one.value) if isinstance(one, ast.Constant) else f"{{{ast.unparse(one.value)}}}"
            for one in node.values
            if isinstance(one, ast.Constant | ast.FormattedValue)
        )
        yield "".join(parts)
    else:
        for one in ast.iter_child_nodes(node):
            yield from texts(one)


def messages(tree: ast.AST, file: str = "") -> Iterator[Message]:
    """The sentences of a module.

    >>> source = 'Finding.error("a.b", "c", "it is thin", remedy="make it wide")'
    >>> [(one.kind, one.text) for one in messages(ast.parse(source))]
    [('error', 'it is thin'), ('remedy', 'make it wide')]
    """
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef) and set(node.name.strip("_").split("_")) & SAID:
            returned = [one.value for one in ast.walk(node) if isinstance(one, ast.Return) and one.value]
            yield from (Message(file, one.lineno, node.name, text) for one in returned for text in texts(one))
        elif isinstance(node, ast.Call):
            name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            first = 2 if name in GIVEN else 0
            found = [
                (name, one) for one in node.args[first : first + 1] if name in GIVEN or name.endswith("Error")
            ]
            found += [(one.arg, one.value) for one in node.keywords if one.arg in SAID]
            yield from (Message(file, node.lineno, kind, text) for kind, one in found for text in texts(one))


def every() -> list[Message]:
    """All sentences of the source, in the order of files and lines."""
    return sorted(
        one
        for folder in SOURCES
        for path in (ROOT / folder).rglob("*.py")
        for one in messages(ast.parse(path.read_text(encoding="utf-8")), path.relative_to(ROOT).as_posix())
    )


if __name__ == "__main__":
    for one in every():
        if all(word in one.text for word in sys.argv[1:]):
            sys.stdout.write(f"{one.file}:{one.line}: {one.kind}: {one.text}\n")
