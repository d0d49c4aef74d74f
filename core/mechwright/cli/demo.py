"""The command ``demo``: the README's example, built from what is installed."""

import sys
import webbrowser
from importlib.resources import files
from pathlib import Path

from mechwright.cli.perform import perform
from mechwright.cli.telling import echo
from mechwright.designs.files import read_text
from mechwright.errors import MechwrightError, OutputError
from mechwright.output.folder import write_new
from mechwright.pipeline import Wanted
from mechwright.reading import regular
from mechwright.shell import file_word
from mechwright.systems import has_windows

DESIGN = "elliptic-pair.toml"
"""The example's name in its folder; in the package it is ``demo.toml``."""
SHOWN = "motion.html"


def demo(folder: Path, show: bool | None) -> None:
    """Write the example into a folder, build it there, and open its page.

    ``show`` None opens it where somebody looks: on a terminal of a machine with a browser.

    Raises
    ------
    OutputError
        Another design stands in the folder, or it cannot be written.
    """
    text = files("mechwright.cli").joinpath("demo.toml").read_text(encoding="utf-8")
    path = folder / DESIGN
    _place(path, text)
    out = folder / "out"
    perform(path, out, Wanted("build"))
    page = out / SHOWN
    file = file_word(path)
    echo(
        f"go on with: mechwright check {file}, or change it and: mechwright build {file} -o {file_word(out)}"
    )
    if (show if show is not None else sys.stdout.isatty()) and _open(page):
        echo(f"{page}: opened in the browser")
    else:
        echo(f"{page}: open it in a browser")


def _place(path: Path, text: str) -> None:
    """Write the example, where it does not stand already."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if regular(path) and read_text(path)[0] == text:
            return
    except (OSError, MechwrightError) as error:
        raise OutputError(f"{path}: cannot be written: {error}") from error
    if path.exists():
        raise OutputError(
            f"{path}: is there already and has been changed; give another folder, or: "
            f"mechwright build {file_word(path)} -o {file_word(path.parent / 'out')}"
        )
    write_new(path, text)


def _open(page: Path) -> bool:
    """Open a page in a browser with a window; one that takes over the terminal is none."""
    try:
        return has_windows() and webbrowser.open(page.resolve().as_uri())
    except webbrowser.Error:
        return False
