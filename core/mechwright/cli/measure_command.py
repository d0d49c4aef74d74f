"""The command ``measure``; it imports what it needs when it runs."""

from pathlib import Path
from typing import Annotated

import typer

from mechwright.cli.command import AsJson, Command, DesignFile


class Measure(Command):
    """``mechwright measure``."""

    name = "measure"
    order = 88

    def run(
        self,
        design: DesignFile,
        values: Annotated[
            Path | None,
            typer.Argument(metavar="CSV", help="A table of measured values, in mm.", show_default=False),
        ] = None,
        output: Annotated[
            Path | None,
            typer.Option(
                "--output", "-o", metavar="FILE", help="Write the table to fill in.", show_default=False
            ),
        ] = None,
        force: Annotated[bool, typer.Option("--force", help="Replace the file if it is there.")] = False,
        as_json: AsJson = False,
    ) -> None:
        """Compare made parts with their drawings.

        Says which limits hold, what to correct for the next piece, which parts to put together, and what play
        the mechanism will have. The exit code is 1 if a limit does not hold.
        """
        from mechwright.cli import measuring

        measuring.measure(design, values, output, force=force, as_json=as_json)
