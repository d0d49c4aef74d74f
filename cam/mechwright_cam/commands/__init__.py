"""The commands of the CAM room. Each imports what it needs when it runs."""

from pathlib import Path
from typing import Annotated

import typer

from mechwright.cli.command import AsJson, Command, Curves, DesignFile, OutputFolder
from mechwright.contracts.plugin import Plugin
from mechwright.plugins.hookspecs import hookimpl


class Cam(Command):
    """``mechwright cam``."""

    name = "cam"
    order = 60

    def run(self, design: DesignFile, output: OutputFolder, dxf_curves: Curves = "spline") -> None:
        """Write drawings and proven programs.

        DXF, G-code, the tool table of the control, the setup sheet, and the proof.
        """
        from mechwright.build import Wanted
        from mechwright.cli.perform import perform
        from mechwright.contracts.finding import Stage

        nothing = "makes no plate part, so there is nothing to mill; use mechwright model"
        perform(design, output, Wanted("cam", curves=dxf_curves), Stage.MACHINING, nothing)


class Verify(Command):
    """``mechwright verify``."""

    name = "verify"
    order = 80

    def run(
        self,
        program: Annotated[
            list[Path],
            typer.Argument(
                metavar="PROGRAM", help="A program for the mill; its files in order.", show_default=False
            ),
        ],
        design: Annotated[Path, typer.Option(metavar="DESIGN", help="The design file.", show_default=False)],
        part: Annotated[str, typer.Option(metavar="NAME", help="The part it cuts.", show_default=False)],
        control: Annotated[
            str, typer.Option(metavar="NAME", help="The control it is for; by default the design's.")
        ] = "",
        as_json: AsJson = False,
    ) -> None:
        """Prove that a program from anywhere cuts the part.

        It is simulated as the programs of `cam` are. The exit code is 1 if it does not cut the part. Several
        files, one for each tool, are one program.
        """
        from mechwright_cam.commands import verify

        verify.verify(program, design, part, as_json, control)


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The commands that make and prove programs."""
    return [Cam, Verify]
