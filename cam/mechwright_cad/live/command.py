"""The command ``live``."""

import contextlib
import webbrowser
from pathlib import Path

import typer

from mechwright.cli.hosting import open_host


def live(path: Path, port: int, show: bool) -> None:
    """Serve the page of a design until Ctrl-C.

    Raises
    ------
    OutputError
        The port is taken.
    MechwrightError
        The design file cannot be read.
    """
    from mechwright_cad.live.handover import Handover
    from mechwright_cad.live.server import serve

    def ready(address: str, handover: Handover) -> None:
        typer.echo(f"{path}: {address}")
        typer.echo("for this machine alone; Ctrl-C ends it")
        if show:
            # Every user of the machine reads command lines: a browser's has the name of a file, no secret.
            with contextlib.suppress(OSError, webbrowser.Error):
                webbrowser.open(handover.entry_page().as_uri())

    serve(path, open_host(), port, ready)
    typer.echo("ended")
