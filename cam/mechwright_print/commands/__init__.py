"""The commands of printing. Each imports what it needs when it runs."""

from pathlib import Path
from typing import Annotated

import typer

from mechwright.cli import completing
from mechwright.cli.command import AsJson, Command
from mechwright.contracts.plugin import Plugin
from mechwright.errors import DesignError
from mechwright.plugins.hookspecs import hookimpl


class Print(Command):
    """``mechwright print``."""

    name = "print"
    order = 65

    def run(
        self,
        design: Annotated[
            Path | None,
            typer.Argument(
                metavar="DESIGN",
                help="A design file (TOML).",
                show_default=False,
                autocompletion=completing.design_files,
            ),
        ] = None,
        output: Annotated[
            Path | None,
            typer.Option(
                "--output", "-o", metavar="DIR", help="Folder for the files; with --measured, the file."
            ),
        ] = None,
        coupon: Annotated[
            bool, typer.Option("--coupon", help="Write the coupon, by which a printer is measured.")
        ] = False,
        measured: Annotated[
            Path | None,
            typer.Option(
                metavar="CSV", help="The table of a measured coupon: write the printer.", show_default=False
            ),
        ] = None,
        printer: Annotated[
            Path | None,
            typer.Option(
                metavar="FILE",
                help="With --coupon or --measured: a file of the printer to start from.",
                show_default=False,
            ),
        ] = None,
        force: Annotated[bool, typer.Option("--force", help="With --measured: replace the file.")] = False,
        as_json: AsJson = False,
    ) -> None:
        """Write printed parts: 3MF, STL, a sheet.

        Plates lie on the bed. Holes, slots, flanks and the first layer are corrected for the printer, whose
        file the design names. --coupon writes test pieces and a table; --measured makes that file of what is
        measured on them.
        """
        from mechwright_print.commands import printing

        chosen = [bool(design), coupon, measured is not None]
        if sum(chosen) != 1:
            raise DesignError("say one of: a design file, --coupon, --measured FILE")
        if output is None:
            raise DesignError("--output: is missing; add -o FOLDER, or -o printer.toml with --measured")
        if design is not None:
            if printer is not None or force:
                raise DesignError(
                    '--printer, --force: only without a design, which says [print] printer = "..."'
                )
            printing.print_design(design, output, as_json=as_json)
        elif coupon:
            printing.write_coupon(output, printer)
        elif measured is not None:
            printing.fit_printer(measured, output, printer, force=force, as_json=as_json)


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The command that writes prints, the coupon, and the file of a printer."""
    return [Print]
