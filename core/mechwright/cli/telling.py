"""How findings are told: a block each on a terminal, coloured and wrapped; a line each in a pipe."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from mechwright.cli.streams import plain
from mechwright.contracts.finding import Finding, Severity

if TYPE_CHECKING:
    from rich.console import Console

_STYLES = {Severity.ERROR: "bold red", Severity.WARNING: "bold yellow", Severity.NOTE: "bold cyan"}
_REMEDY = "green"
_INDENT = 2


def echo(*lines: str, err: bool = False) -> None:
    """Print lines, each of them one line on any terminal whatever names of files and plugins stand in it."""
    for line in lines:
        typer.echo(plain(line), err=err)


def tell(finding: Finding, *, err: bool = False, path: Path | None = None) -> None:
    """Say a finding, on standard error or output; in a pipe it begins with ``path``, if that is given."""
    if not (sys.stderr if err else sys.stdout).isatty():
        echo(f"mechwright: {path}: {finding}" if path is not None else str(finding), err=err)
        return
    from rich.console import Console

    # rich minds NO_COLOR, TERM and the width of the terminal.
    block(finding, Console(stderr=err, highlight=False))


def block(finding: Finding, console: "Console") -> None:
    """Print severity, code and parameter; then the message, then the remedy, indented and wrapped."""
    from rich.padding import Padding
    from rich.text import Text

    head = Text.assemble((str(finding.severity), _STYLES[finding.severity]), f" {finding.code}")
    if finding.parameter:
        head.append(f" {finding.parameter}", "bold")
    console.print(head)
    for words, style in ((finding.message, ""), (finding.remedy, _REMEDY)):
        if words:
            console.print(Padding(Text(plain(words), style), (0, 0, 0, _INDENT), expand=False))
