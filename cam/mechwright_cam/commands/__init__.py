"""The commands of the CAM room. Each imports what it needs when it runs."""

from pathlib import Path
from typing import Annotated

import typer

from mechwright.cli import completing
from mechwright.cli.command import AsJson, Command, Curves, DesignFiles, OutputFolder, Workers, names
from mechwright.contracts.plugin import Plugin
from mechwright.errors import DesignError
from mechwright.plugins.hookspecs import hookimpl
from mechwright_cam.commands.send import Send


class Cam(Command):
    """``mechwright cam``."""

    name = "cam"
    order = 60

    def run(
        self,
        designs: DesignFiles,
        output: OutputFolder,
        dxf_curves: Curves = "spline",
        as_json: AsJson = False,
        workers: Workers = None,
    ) -> None:
        """Write drawings and proven programs.

        DXF, G-code, the tool table of the control, the setup sheet, and the proof. Of several designs each
        goes into a folder of its own in DIR.
        """
        from mechwright.cli.several import write
        from mechwright.pipeline import Wanted

        nothing = "makes no plate part, so there is nothing to mill; use mechwright model"
        wanted = Wanted("cam", curves=dxf_curves)
        write(designs, output, wanted, workers, nothing, as_json)


def cam_settings(incomplete: str) -> list[tuple[str, str]]:
    """Keys of ``[cam]`` that mean something without a design, each with ``=`` and what it is."""
    from mechwright_cam.commands.verify_drawing import SAID_ELSEWHERE
    from mechwright_cam.shop.settings import CamSettings

    return completing.keys(CamSettings, incomplete, SAID_ELSEWHERE)


def tool_files(incomplete: str) -> list[str]:
    """Tool libraries, here and in the folders that the line has begun."""
    from mechwright_cam.shop.formats.known import suffixes

    return completing.files_ending(incomplete, suffixes())


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
        design: Annotated[
            Path | None,
            typer.Option(
                metavar="DESIGN",
                help="The design file.",
                show_default=False,
                autocompletion=completing.design_files,
            ),
        ] = None,
        part: Annotated[
            str,
            typer.Option(
                metavar="NAME",
                help="The part of the design that it cuts.",
                autocompletion=completing.part_names,
            ),
        ] = "",
        dxf: Annotated[
            Path | None,
            typer.Option(
                metavar="DRAWING", help="A drawing of the part, without a design.", show_default=False
            ),
        ] = None,
        thickness: Annotated[
            float, typer.Option(metavar="MM", help="With --dxf: thickness of the plate.", show_default=False)
        ] = 0.0,
        tools: Annotated[
            str, typer.Option(metavar="LIST", help="With --dxf: T numbers and cutters, 1=mill-6,2=drill-5.")
        ] = "",
        library: Annotated[
            Path | None,
            typer.Option(
                metavar="FILE",
                help="With --dxf: a tool library with cutters of yours.",
                show_default=False,
                autocompletion=tool_files,
            ),
        ] = None,
        material: Annotated[
            str, typer.Option(metavar="NAME", help="With --dxf: of the plate, by default aluminium.")
        ] = "",
        hold: Annotated[
            str,
            typer.Option(
                metavar="HOW",
                help="With --dxf: tabs, anywhere, by default; bore, vacuum, tape, vice, clamps.",
            ),
        ] = "",
        stock: Annotated[
            str, typer.Option(metavar="SIZE", help="With --dxf: of the plate, 120x80, or its margin, in mm.")
        ] = "",
        units: Annotated[
            str, typer.Option(metavar="UNIT", help="With --dxf: mm, cm or inch, if the drawing says none.")
        ] = "",
        layers: Annotated[
            str, typer.Option(metavar="LIST", help="With --dxf: the layers of the outline and its openings.")
        ] = "",
        settings: Annotated[
            list[str],
            typer.Option(
                "--set",
                metavar="KEY=VALUE",
                help="With --dxf: a setting of [cam], hold.tabs=3.",
                autocompletion=cam_settings,
            ),
        ] = [],  # noqa: B006 - typer reads it, nobody changes it
        control: Annotated[
            str,
            typer.Option(
                metavar="NAME",
                help="The control it is for; by default the design's.",
                autocompletion=completing.controls,
            ),
        ] = "",
        page: Annotated[
            Path | None, typer.Option(metavar="FILE", help="Write the report as a page.", show_default=False)
        ] = None,
        job: Annotated[
            Path | None,
            typer.Option(metavar="FILE", help="Write a page that plays the program.", show_default=False),
        ] = None,
        as_json: AsJson = False,
    ) -> None:
        """Prove that a program from anywhere cuts the part.

        The part is that of a design, or of a drawing. The program is simulated as those of `cam` are. The
        exit code is 1 if it does not cut the part. Several files, one for each tool, are one program.
        """
        from mechwright_cam.commands import verify

        report = verify.Report(as_json, page, job)
        drawn = {
            "thickness": thickness,
            "tools": tools,
            "library": library,
            "material": material,
            "hold": hold,
            "stock": stock,
            "units": units,
            "layers": names(layers),
            "changes": settings,
        }
        if (design is None) == (dxf is None):
            raise DesignError(
                "say what the program cuts: --design and --part, or --dxf, --thickness and --tools"
            )
        if design is not None:
            if not part:
                raise DesignError("--part: name the part of the design that the program cuts")
            if told := [name for name, value in drawn.items() if value]:
                options = ", ".join(f"--{'set' if name == 'changes' else name}" for name in told)
                raise DesignError(f"{options}: only with --dxf; the design file says it, so leave it out")
            verify.verify(program, design, part, report, control)
        elif dxf is not None:
            if part:
                raise DesignError("--part: only with --design; a drawing holds one part, so leave it out")
            verify.verify_drawing(program, dxf, report, control=control, **drawn)


class Tools(Command):
    """``mechwright tools``."""

    name = "tools"
    order = 85

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
        library: Annotated[
            Path | None,
            typer.Option(
                metavar="FILE",
                help="A tool library in the place of the design's: .toml, .tbl, .json, .tools or .fctl.",
                show_default=False,
                autocompletion=tool_files,
            ),
        ] = None,
        export: Annotated[
            Path | None,
            typer.Option(
                metavar="FILE",
                help="Write the tools as .toml, .tbl, .json, .tools or .fctl.",
                show_default=False,
                autocompletion=tool_files,
            ),
        ] = None,
        force: Annotated[bool, typer.Option("--force", help="Replace files that are there.")] = False,
        as_json: AsJson = False,
    ) -> None:
        """List the cutters, and what each does in a design.

        Of the built-in library, of FILE or of a design; with a design also what each does in which part, and
        which are not needed. FILE may be a library of LinuxCNC, Fusion or FreeCAD.
        """
        from mechwright_cam.commands import tools

        if force and export is None:
            raise DesignError("--force: only with --export; leave it out")
        tools.tools(design, library, as_json, export, force=force)


class ShopFile(Command):
    """``mechwright shop``."""

    name = "shop"
    order = 22

    def run(
        self,
        output: Annotated[
            Path | None,
            typer.Option("--output", "-o", metavar="FILE", help="The file; printed if not given."),
        ] = None,
        library: Annotated[
            Path | None,
            typer.Option(
                metavar="FILE",
                help="Take the tools of this library, of any format that `tools` reads.",
                show_default=False,
                autocompletion=tool_files,
            ),
        ] = None,
        units: Annotated[str, typer.Option(metavar="UNIT", help="mm or inch.")] = "mm",
        control: Annotated[
            str,
            typer.Option(metavar="NAME", help="Control of the mill.", autocompletion=completing.controls),
        ] = "",
        machine: Annotated[
            str, typer.Option(metavar="NAME", help="The mill, by name.", show_default="bench-mill")
        ] = "",
        mills: Annotated[
            str,
            typer.Option(
                metavar="LIST",
                help="Mills by diameter in mm: 3.175,2,1, or 3.175:1:17 with flutes and length.",
            ),
        ] = "",
        sheet: Annotated[
            list[str] | None,
            typer.Option(
                metavar="SHEET", help='A sheet in hand, such as "200x150x6 acrylic"; may be repeated.'
            ),
        ] = None,
        spindle: Annotated[
            str, typer.Option(metavar="RANGE", help="Speeds of the spindle in rev/min: 8000-24000.")
        ] = "",
        homing: Annotated[
            bool | None,
            typer.Option(
                "--homing/--no-homing", help="Whether the machine has switches. Default: as it comes."
            ),
        ] = None,
        gap: Annotated[
            float | None,
            typer.Option(metavar="MM", help="From the table to the nose of the spindle with Z fully up."),
        ] = None,
        spoil_board: Annotated[
            float | None, typer.Option(metavar="MM", help="Thickness of the board under the stock.")
        ] = None,
        force: Annotated[bool, typer.Option("--force", help="Replace the file if it is there.")] = False,
    ) -> None:
        """Write a shop file to start from.

        It has tools, mill, control, units and stock in hand. Name it in a design file: shop = "shop.toml".
        Its tools take the place of the built-in ones. With --mills it is that of a small machine, whose
        cutting data are estimated. On a terminal, with no option, questions are asked.
        """
        from mechwright_cam.commands import shop_file

        bench = shop_file.BenchWords(mills, tuple(sheet or ()), spindle, homing, gap, spoil_board)
        shop_file.shop_file(output, library, units, control, machine, bench, force=force)


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The commands that make, prove and send programs, list tools, and write a shop file."""
    return [Cam, Verify, Send, Tools, ShopFile]
