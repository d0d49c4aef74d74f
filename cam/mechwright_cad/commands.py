"""The commands of the CAD room."""

from pathlib import Path
from typing import Annotated

import typer

from mechwright.cli import completing
from mechwright.cli.command import Also, AsJson, At, Command, DesignFile, OutputFolder, names
from mechwright.contracts.plugin import Plugin
from mechwright.plugins.hookspecs import hookimpl


class Model(Command):
    """``mechwright model``."""

    name = "model"
    order = 50

    def run(
        self,
        design: DesignFile,
        output: OutputFolder,
        also: Also = "",
        at: At = "",
        as_json: AsJson = False,
    ) -> None:
        """Write the solids: parts and assembly as STEP."""
        from mechwright.cli.perform import perform
        from mechwright.pipeline import Wanted

        wanted = Wanted("model", at=at, formats=names(also))
        perform(design, output, wanted, as_json=as_json)


class Live(Command):
    """``mechwright live``."""

    name = "live"
    order = 45
    reads_once = False
    libraries = ("starlette", "uvicorn")

    def run(
        self,
        design: Annotated[
            Path,
            typer.Argument(
                metavar="FILE",
                help="A design file or a requirement file (TOML).",
                show_default=False,
                autocompletion=completing.any_files,
            ),
        ],
        port: Annotated[
            int, typer.Option(min=0, max=65535, help="Port on this machine; a free one by default.")
        ] = 0,
        show: Annotated[bool, typer.Option("--open/--no-open", help="Show the page in a browser.")] = True,
    ) -> None:
        """Show a design or requirement in the browser, and redraw it.

        The page is for this machine alone. Nothing is written unless you ask for it there. Ctrl-C ends it.
        """
        from mechwright_cad.live.command import live

        live(design, port, show)


class FreeCad(Command):
    """``mechwright freecad``."""

    name = "freecad"
    order = 96

    def run(
        self,
        folder: Annotated[
            Path | None,
            typer.Argument(
                metavar="FOLDER",
                help="FreeCAD's folder Mod; by default the user's own.",
                show_default=False,
            ),
        ] = None,
        force: Annotated[bool, typer.Option("--force", help="Replace another version.")] = False,
    ) -> None:
        """Install the add-on for FreeCAD.

        Its panel shows parts and motion of a design file, and has the programs written by this installation.
        """
        from mechwright_cad.freecad.install import install

        install(folder, force=force)


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The commands that make solids, show a design, and install the add-on for FreeCAD."""
    return [Model, Live, FreeCad]
