"""The command ``send``."""

from pathlib import Path
from typing import Annotated

import typer

from mechwright.cli.command import Command


class Send(Command):
    """``mechwright send``."""

    name = "send"
    order = 82

    def run(
        self,
        programs: Annotated[
            list[Path],
            typer.Argument(
                metavar="PROGRAM",
                help="Programs, or NAME.certificate.json for all files of one.",
                show_default=False,
            ),
        ],
        to: Annotated[
            str,
            typer.Option(
                metavar="WHERE",
                help="A folder, cncjs://HOST:8000, or fluidnc://HOST/FOLDER.",
                show_default=False,
            ),
        ],
        port: Annotated[
            str,
            typer.Option(metavar="NAME", help="With cncjs: the port of the machine, if several are open."),
        ] = "",
        force: Annotated[bool, typer.Option("--force", help="Replace what is there under the name.")] = False,
    ) -> None:
        """Send programs to the machine, if their certificates hold.

        `mechwright-check` holds each program against the certificate beside it. Nothing is sent if one fails.
        """
        from mechwright.cli.telling import echo
        from mechwright.errors import DesignError
        from mechwright_cam.senders.certified import certified
        from mechwright_cam.senders.target import target

        place = target(to, port)
        files = certified(programs, lambda line: echo(line, err=True))
        for file in files:
            if place.controls and file.control not in place.controls:
                raise DesignError(
                    f"{file.name}: is for the control {file.control}; {to} reads programs for "
                    f"{' or '.join(sorted(place.controls))}: set cam.control in the design"
                )
        if place.single and len(files) > 1:
            names = ", ".join(file.name for file in files)
            raise DesignError(f"{to}: takes one file at a time; name one of: {names}")
        for file in files:
            echo(place.send(file, replace=force))
