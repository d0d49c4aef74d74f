"""The commands. Each imports what it needs when it runs, so that ``--help`` stays fast."""

from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer(
    name="mechwright",
    help="From how a mechanism should move to a proven program for the mill.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)

DesignFile = Annotated[
    Path, typer.Argument(metavar="DESIGN", help="A design file (TOML).", show_default=False)
]
OutputFolder = Annotated[
    Path, typer.Option("--output", "-o", metavar="DIR", help="Folder for the files.", show_default=False)
]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON.")]
Samples = Annotated[int, typer.Option(min=2, max=1_000_000, help="Samples of the motion over one period.")]
Also = Annotated[
    str, typer.Option(metavar="FORMATS", help="More formats for the solids, such as stl,3mf,glb.")
]
Curves = Annotated[
    str,
    typer.Option(
        "--dxf-curves", metavar="KIND", help="Curves in DXF files: spline, spline3, arc or polyline."
    ),
]

At = Annotated[
    str,
    typer.Option(
        metavar="INPUT",
        help="Where the assembly stands, such as '40 deg'; by default at the start.",
    ),
]

SAMPLES = 721
"""Default number of samples: every half degree of one turn, both ends included."""


def _version(wanted: bool) -> None:
    if wanted:
        from mechwright import __version__

        typer.echo(f"mechwright {__version__}")
        raise typer.Exit


@app.callback()
def _root(
    version: Annotated[
        bool, typer.Option("--version", help="Print the version.", callback=_version, is_eager=True)
    ] = False,
) -> None:
    pass


@app.command()
def families(as_json: AsJson = False) -> None:
    """List what is installed, and plugins that are broken."""
    from mechwright.cli import listing

    listing.families(as_json)


@app.command()
def new(
    family: Annotated[str, typer.Argument(help="A family's name; see `families`.", show_default=False)],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE", help="The file; printed if not given.")
    ] = None,
    requirement: Annotated[
        str, typer.Option(metavar="KIND", help="A requirement file instead, for `synthesize`.")
    ] = "",
    force: Annotated[bool, typer.Option("--force", help="Replace the file if it is there.")] = False,
) -> None:
    """Write a commented design file that builds as it is."""
    from mechwright.cli import listing

    listing.new(family, requirement, output, force)


@app.command()
def check(design: DesignFile, as_json: AsJson = False) -> None:
    """Say what an engineer would object to.

    The exit code is 1 if something forbids building.
    """
    from mechwright.cli import work

    work.check(design, as_json)


@app.command()
def solve(design: DesignFile, output: OutputFolder, samples: Samples = SAMPLES) -> None:
    """Write the motion: tables, and a page that moves.

    They are motion.csv, summary.json and motion.html.
    """
    from mechwright.cli import work

    work.write(design, output, "solve", samples=samples)


@app.command()
def model(design: DesignFile, output: OutputFolder, also: Also = "", at: At = "") -> None:
    """Write the solids: parts and assembly as STEP."""
    from mechwright.cli import work

    work.write(design, output, "model", also=also, at=at)


@app.command()
def cam(design: DesignFile, output: OutputFolder, dxf_curves: Curves = "spline") -> None:
    """Write drawings and proven programs.

    DXF, G-code, the tool table of the control, the setup sheet, and the proof.
    """
    from mechwright.cli import work

    work.write(design, output, "cam", curves=dxf_curves)


@app.command()
def build(
    design: DesignFile,
    output: OutputFolder,
    samples: Samples = SAMPLES,
    also: Also = "",
    dxf_curves: Curves = "spline",
    at: At = "",
) -> None:
    """Write everything: motion, solids, drawings, programs."""
    from mechwright.cli import work

    work.write(design, output, "build", samples=samples, also=also, curves=dxf_curves, at=at)


@app.command()
def verify(
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
    from mechwright.cli import work

    work.verify(program, design, part, as_json, control)


@app.command()
def synthesize(
    requirement: Annotated[
        Path, typer.Argument(metavar="REQUIREMENT", help="A requirement file (TOML).", show_default=False)
    ],
    output: OutputFolder,
) -> None:
    """Find designs that meet a requirement.

    One design file each, best first. The exit code is 1 if none meets it.
    """
    from mechwright.cli import synthesis

    synthesis.synthesize(requirement, output)
