"""The command line: the commands that are installed, in their order."""

from typing import Annotated

import typer

from mechwright.cli.command import Command
from mechwright.cli.hosting import warn_broken
from mechwright.plugins.host import COMMANDS, load


def _version(wanted: bool) -> None:
    if wanted:
        from mechwright import __version__

        typer.echo(f"mechwright {__version__}")
        raise typer.Exit


def _root(
    version: Annotated[
        bool, typer.Option("--version", help="Print the version.", callback=_version, is_eager=True)
    ] = False,
) -> None:
    pass


def make_app() -> typer.Typer:
    """The application; commands that are broken are named on standard error."""
    app = typer.Typer(
        name="mechwright",
        help="From how a mechanism should move to a proven program for the mill.",
        no_args_is_help=True,
        add_completion=False,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
        context_settings={"help_option_names": ["-h", "--help"]},
    )
    app.callback()(_root)
    found = load(group=COMMANDS)
    warn_broken(found)
    for command in sorted(found.all(Command), key=lambda command: command.order):
        app.command(command.name)(command.run)
    return app
