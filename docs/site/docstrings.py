"""Docstrings as Markdown: what Sphinx and doctest write otherwise."""

import re
from typing import Any

from markdown import Markdown
from markdown.extensions import Extension
from markdown.preprocessors import Preprocessor

ROLE = re.compile(r":(?:class|func|meth|mod|attr|data|exc):`~?([^`<]+)`")
AFTER_FENCES = 22
"""Priority: code blocks are put aside at 25."""


def as_markdown(lines: list[str]) -> list[str]:
    """Roles as code, ``::`` as a colon, and doctests, which Markdown would take for quotes, as code.

    >>> as_markdown(["See :func:`~mechwright.load`::", "", "    x"])
    ['See `mechwright.load`:', '', '    x']
    >>> as_markdown([">>> 1 + 1", "2", "", "end"])
    ['', '    >>> 1 + 1', '    2', '', 'end']
    """
    rows: list[str] = []
    inside = False
    for line in lines:
        if line.startswith(">>> ") and not inside:
            inside = True
            rows.append("")
        inside = inside and bool(line.strip())
        said = line if line.startswith(("    ", ":::")) or inside else ROLE.sub(r"`\1`", line)
        rows.append(f"    {said}" if inside else re.sub(r"(?<=[^:\s])::$", ":", said))
    return rows


class _Rewriting(Preprocessor):
    def run(self, lines: list[str]) -> list[str]:
        return as_markdown(lines)


class Docstrings(Extension):
    """The extension of Markdown."""

    def extendMarkdown(self, md: Markdown) -> None:  # noqa: N802 - its own name
        """Register it behind what takes code blocks away."""
        md.preprocessors.register(_Rewriting(md), "docstrings", AFTER_FENCES)


def makeExtension(**options: Any) -> Docstrings:  # noqa: N802 - what Markdown calls
    """The extension, as Markdown asks for it."""
    return Docstrings(**options)
