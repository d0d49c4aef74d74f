"""The command line: the commands that are installed, in their order."""

import inspect
import os
from collections.abc import Callable
from contextlib import nullcontext
from functools import wraps
from typing import Annotated

import typer

from mechwright.cli.command import Command
from mechwright.cli.hosting import warn_broken
from mechwright.cli.progress import standing
from mechwright.extras import EXTRAS, install_line, require
from mechwright.plugins.host import COMMANDS, load
from mechwright.reading import once


def _version(wanted: bool) -> None:
    if wanted:
        from mechwright import __version__

        typer.echo(f"mechwright {__version__}")
        raise typer.Exit


COMPLETING = "_MECHWRIGHT_COMPLETE"
"""Environment variable that a shell sets when it asks what may follow on the line."""

FIRST = """\
mechwright demo                                builds an example and opens it
mechwright new elliptic-gears -o pair.toml     a design of your own, its first keys explained
mechwright build pair.toml -o out              its motion, solids, drawings and proven programs

mechwright --help lists all commands."""


def _root(
    ctx: typer.Context,
    version: Annotated[  # noqa: ARG001 - its callback prints it
        bool, typer.Option("--version", help="Print the version.", callback=_version, is_eager=True)
    ] = False,
) -> None:
    if ctx.invoked_subcommand is None:
        typer.echo(FIRST)


def _stoppable(command: Command) -> Callable[..., None]:
    """A command that says what stands when the keyboard stops it; typer would end it without a word."""

    @wraps(command.run)
    def stoppable(*arguments: object, **options: object) -> None:
        require(*command.libraries, by=command.name)
        with standing(), once() if command.reads_once else nullcontext():
            command.run(*arguments, **options)

    return stoppable


def make_app() -> typer.Typer:
    """The application; commands that are broken are named on standard error."""
    app = typer.Typer(
        name="mechwright",
        help="From how a mechanism should move to a proven program for the mill.",
        invoke_without_command=True,
        add_completion=True,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
        context_settings={"help_option_names": ["-h", "--help"]},
    )
    app.callback()(_root)
    found = load(group=COMMANDS)
    if COMPLETING not in os.environ:
        warn_broken(found)
    for command in sorted(found.all(Command), key=lambda command: command.order):
        extras = dict.fromkeys(EXTRAS[library] for library in command.libraries)
        needs = "".join(f"\n\nIt needs the extra {extra}." for extra in extras)
        lines = "\n".join(f"  {install_line(extra)}" for extra in extras)
        app.command(
            command.name,
            help=inspect.cleandoc(command.run.__doc__ or "") + needs or None,
            epilog=f"\b\nThe extra is installed by\n{lines}" if extras else None,
        )(_stoppable(command))
    return app
