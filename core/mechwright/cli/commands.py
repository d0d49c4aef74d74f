"""The commands of the core. Each imports what it needs when it runs, so that ``--help`` stays fast."""

from pathlib import Path
from typing import Annotated

import typer

from mechwright.cli import completing
from mechwright.cli.command import (
    Also,
    AsJson,
    At,
    Command,
    Curves,
    DesignFile,
    DesignFiles,
    OutputFolder,
    Samples,
    Workers,
    names,
)
from mechwright.cli.measure_command import Measure
from mechwright.cli.study_commands import Sweep, Synthesize
from mechwright.contracts.plugin import Plugin
from mechwright.contracts.sampling import SAMPLES
from mechwright.plugins.hookspecs import hookimpl


class Families(Command):
    """``mechwright families``."""

    name = "families"
    order = 10

    def run(self, as_json: AsJson = False) -> None:
        """List what is installed, and plugins that are broken."""
        from mechwright.cli import listing

        listing.families(as_json)


class Demo(Command):
    """``mechwright demo``."""

    name = "demo"
    order = 5

    def run(
        self,
        folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="Where it goes.")] = Path(
            "mechwright-demo"
        ),
        show: Annotated[
            bool | None,
            typer.Option("--open/--no-open", help="Open the page on which it moves.", show_default=False),
        ] = None,
    ) -> None:
        """Build an example, and open it in the browser."""
        from mechwright.cli import demo

        demo.demo(folder, show)


class New(Command):
    """``mechwright new``."""

    name = "new"
    order = 20

    def run(
        self,
        family: Annotated[
            str,
            typer.Argument(
                help="A family's name; see `families`.",
                show_default=False,
                autocompletion=completing.families,
            ),
        ],
        output: Annotated[
            Path | None,
            typer.Option("--output", "-o", metavar="FILE", help="The file; printed if not given."),
        ] = None,
        requirement: Annotated[
            str,
            typer.Option(
                metavar="KIND",
                help="A requirement file instead, for `synthesize`.",
                autocompletion=completing.requirement_kinds,
            ),
        ] = "",
        source: Annotated[
            str,
            typer.Option(
                "--from",
                metavar="SOURCE",
                help="Start of the design: an entry of the family's catalogue, or a file that the family "
                "reads.",
            ),
        ] = "",
        shop: Annotated[
            Path | None,
            typer.Option(
                metavar="FILE",
                help="A shop file beside it: the design is made of the sheet in hand.",
                show_default=False,
            ),
        ] = None,
        fit: Annotated[
            str,
            typer.Option(metavar="SIZE", help="Largest size of each plate in mm, such as 120x80."),
        ] = "",
        settings: Annotated[
            list[str],
            typer.Option("--set", metavar="KEY=VALUE", help="A parameter of the design, such as slots=6."),
        ] = [],  # noqa: B006 - typer reads it, nobody changes it
        everything: Annotated[
            bool, typer.Option("--all", help="Every key, not only those that one sets first.")
        ] = False,
        force: Annotated[bool, typer.Option("--force", help="Replace the file if it is there.")] = False,
    ) -> None:
        """Write a commented design file that builds as it is.

        With --shop or --fit the design is as large as the sheet or the size allows, and what does not go
        with the shop is changed and told.
        """
        from mechwright.cli import listing

        start = listing.Start(requirement, source, shop, fit, tuple(settings))
        listing.new(family, start, output, force=force, whole=everything)


class Schema(Command):
    """``mechwright schema``."""

    name = "schema"
    order = 25

    def run(
        self,
        family: Annotated[
            str,
            typer.Argument(
                help="A family's name, or shop; all families if not given.",
                autocompletion=completing.families,
            ),
        ] = "",
        output: Annotated[
            Path | None,
            typer.Option("--output", "-o", metavar="FILE", help="The file; printed if not given."),
        ] = None,
        requirement: Annotated[
            bool, typer.Option("--requirement", help="Of requirement files instead of design files.")
        ] = False,
        study: Annotated[
            bool, typer.Option("--study", help="Of study files, which sweep takes, instead of design files.")
        ] = False,
        force: Annotated[bool, typer.Option("--force", help="Replace the file if it is there.")] = False,
    ) -> None:
        """Write a JSON schema of design files.

        Editors complete and check a file by it whose first line is: #:schema ./FILE
        """
        from mechwright.cli import listing

        listing.schema(family, requirement, study, output, force)


class Check(Command):
    """``mechwright check``."""

    name = "check"
    order = 30

    def run(
        self,
        designs: DesignFiles,
        to: Annotated[
            str,
            typer.Option(
                "--to",
                metavar="STAGE",
                help="Make all up to a stage, and judge it: motion, parts, assembly, machining or output. "
                "By default all stages are judged, and nothing is made.",
                autocompletion=completing.stages,
            ),
        ] = "",
        also: Also = "",
        figures: Annotated[
            bool, typer.Option("--figures", help="Add a table of the figures that were found.")
        ] = False,
        as_json: AsJson = False,
        tolerances: Annotated[
            bool, typer.Option("--tolerances", help="Effect of tolerances: sensitivities, worst case, yield.")
        ] = False,
        workers: Workers = None,
    ) -> None:
        """Say what an engineer would object to.

        The exit code is 1 if something forbids building.
        """
        from mechwright.cli import several
        from mechwright.pipeline import Wanted

        several.check(designs, Wanted(formats=names(also)), to, workers, as_json, tolerances, figures)


class Fix(Command):
    """``mechwright fix``."""

    name = "fix"
    order = 35

    def run(
        self,
        design: DesignFile,
        to: Annotated[
            str,
            typer.Option(
                "--to",
                metavar="STAGE",
                help="How far it has to build: motion, parts, assembly, machining or output.",
                autocompletion=completing.stages,
            ),
        ] = "output",
        output: Annotated[
            Path | None, typer.Option("--output", "-o", metavar="FILE", help="A new file for the result.")
        ] = None,
        write: Annotated[bool, typer.Option("--write", help="Change the design file itself.")] = False,
        as_json: AsJson = False,
    ) -> None:
        """Find the smallest change with which a design builds.

        It is shown, and written where that is asked for. The exit code is 1 if none is found.
        """
        from mechwright.cli import fixing

        fixing.fix(design, to, output, write, as_json)


class Solve(Command):
    """``mechwright solve``."""

    name = "solve"
    order = 40

    def run(
        self, design: DesignFile, output: OutputFolder, samples: Samples = SAMPLES, as_json: AsJson = False
    ) -> None:
        """Write the motion: tables, and a page that moves.

        They are motion.csv, summary.json and motion.html; poles.html and
        construction.html of linkages.
        """
        from mechwright.cli.perform import perform
        from mechwright.pipeline import Wanted

        still = "stands still: there is no motion to write; build writes its drawings and programs"
        perform(design, output, Wanted("solve", samples), still, as_json=as_json)


class Build(Command):
    """``mechwright build``."""

    name = "build"
    order = 70

    def run(
        self,
        designs: DesignFiles,
        output: OutputFolder,
        samples: Samples = SAMPLES,
        also: Also = "",
        dxf_curves: Curves = "spline",
        at: At = "",
        as_json: AsJson = False,
        workers: Workers = None,
    ) -> None:
        """Write everything: motion, solids, drawings, programs.

        Of several designs each goes into a folder of its own in DIR. The exit code is 1 if one is refused.
        """
        from mechwright.cli.several import write
        from mechwright.pipeline import Wanted

        wanted = Wanted("build", samples, at, names(also), dxf_curves)
        write(designs, output, wanted, workers, as_json=as_json)


class Mcp(Command):
    """``mechwright mcp``."""

    name = "mcp"
    order = 98
    reads_once = False
    libraries = ("mcp",)

    def run(
        self,
        folder: Annotated[
            Path, typer.Argument(metavar="FOLDER", help="All files stay below it.", show_default=False)
        ],
    ) -> None:
        """Serve the commands to an agent, by the Model Context Protocol.

        The client starts it and speaks on its standard input and output.
        """
        from mechwright import __version__
        from mechwright.agent.server import serve

        serve(folder, __version__)


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The commands that need no other room."""
    return [Demo, Families, New, Schema, Check, Measure, Fix, Solve, Build, Synthesize, Sweep, Mcp]
