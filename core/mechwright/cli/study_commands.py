"""The commands that look for designs: of a requirement, and among many."""

from pathlib import Path
from typing import Annotated

import typer

from mechwright.cli import completing
from mechwright.cli.command import AsJson, Command, OutputFolder


class Synthesize(Command):
    """``mechwright synthesize``."""

    name = "synthesize"
    order = 90

    def run(
        self,
        requirement: Annotated[
            Path,
            typer.Argument(
                metavar="REQUIREMENT",
                help="A requirement file (TOML).",
                show_default=False,
                autocompletion=completing.requirement_files,
            ),
        ],
        output: OutputFolder,
        as_json: AsJson = False,
        minutes: Annotated[
            bool,
            typer.Option("--minutes", help="Compare the designs by their minutes on the mill as well."),
        ] = False,
    ) -> None:
        """Find designs that meet a requirement.

        One design file each, best first, and a page on which they move and are compared. The exit code is 1
        if none meets it.
        """
        from mechwright.cli import synthesis

        synthesis.synthesize(requirement, output, as_json, minutes)


class Sweep(Command):
    """``mechwright sweep``."""

    name = "sweep"
    order = 95
    libraries = ("pyarrow",)

    def run(
        self,
        study: Annotated[
            Path,
            typer.Argument(metavar="STUDY", help="A study file (TOML).", show_default=False),
        ],
        output: OutputFolder,
        workers: Annotated[
            int | None,
            typer.Option(min=1, max=1024, help="Processes of this machine; by default one for each core."),
        ] = None,
        scheduler: Annotated[
            str | None,
            typer.Option(metavar="ADDRESS", help="Of a Dask scheduler, such as tcp://host:8786."),
        ] = None,
        as_json: AsJson = False,
    ) -> None:
        """Evaluate many designs, and find the best that build.

        A sweep that was stopped goes on where it stood. The exit code is 1 if no design is allowed.
        """
        from mechwright.cli import sweeping

        sweeping.run(study, output, workers, scheduler, as_json)
