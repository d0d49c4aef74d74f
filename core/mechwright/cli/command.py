"""The contract of a command, and the options that commands share.

Plugins register commands under the entry-point group ``mechwright.commands``, apart from all else, so that
``--help`` loads nothing but commands. A module of that group imports nothing heavy at its top.
"""

from pathlib import Path
from typing import Annotated, Any, ClassVar

import typer

from mechwright.cli import completing
from mechwright.contracts.plugin import Plugin
from mechwright.extras import EXTRAS

DesignFile = Annotated[
    Path,
    typer.Argument(
        metavar="DESIGN",
        help="A design file (TOML).",
        show_default=False,
        autocompletion=completing.design_files,
    ),
]
DesignFiles = Annotated[
    list[Path],
    typer.Argument(
        metavar="DESIGN...",
        help="Design files (TOML); several are done side by side.",
        show_default=False,
        autocompletion=completing.design_files,
    ),
]
Workers = Annotated[
    int | None,
    typer.Option(
        min=1,
        max=1024,
        metavar="N",
        help="Cores for several designs, one process each; by default all that this process may use.",
        show_default=False,
    ),
]
OutputFolder = Annotated[
    Path, typer.Option("--output", "-o", metavar="DIR", help="Folder for the files.", show_default=False)
]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON.")]
Samples = Annotated[int, typer.Option(min=2, max=1_000_000, help="Samples of the motion over one period.")]
Also = Annotated[
    str,
    typer.Option(
        metavar="FORMATS",
        help="More formats for the solids, such as stl,3mf,glb,mjcf,urdf.",
        autocompletion=completing.formats,
    ),
]
Curves = Annotated[
    str,
    typer.Option(
        "--dxf-curves",
        metavar="KIND",
        help="Curves in DXF files: spline, spline3, arc or polyline.",
        autocompletion=completing.curves,
    ),
]
At = Annotated[
    str,
    typer.Option(
        metavar="INPUT",
        help="Where the assembly stands, such as '40 deg'; by default at the start.",
    ),
]


class Command(Plugin):
    """A command of the command line."""

    kind = "command"
    plural = "commands"
    guarded = False
    order: ClassVar[int] = 100
    """Commands of lower order stand higher in ``--help``."""
    reads_once: ClassVar[bool] = True
    """Whether each file is read once, whatever becomes of it meanwhile; not if it follows a file."""
    libraries: ClassVar[tuple[str, ...]] = ()
    """Optional libraries, of :data:`mechwright.extras.EXTRAS`, without which it does no work at all."""
    run: ClassVar[Any]
    """A method whose annotations are typer's and whose docstring is the help; it imports what it needs when
    it runs."""

    @classmethod
    def fault(cls) -> str:
        """Whether there is something to run, with libraries that an extra brings."""
        if unknown := [library for library in cls.libraries if library not in EXTRAS]:
            return f"its library {unknown[0]!r} is of no extra; one of: {', '.join(EXTRAS)}"
        return "" if callable(getattr(cls, "run", None)) else "it has no method run"


def names(text: str) -> tuple[str, ...]:
    """The names in a list with commas, each once."""
    return tuple(dict.fromkeys(name.strip() for name in text.split(",") if name.strip()))
