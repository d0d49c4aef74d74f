"""Copies the add-on to where FreeCAD finds it."""

import json
import sys
from pathlib import Path

from platformdirs import user_data_path

from mechwright.cli.telling import echo
from mechwright.errors import OutputError
from mechwright.output.folder import write_new
from mechwright.reading import read_bytes

ADDON = Path(__file__).parent / "addon"
NAME = "Mechwright"
"""Of its folder among FreeCAD's add-ons."""
COMMAND = "command.json"
"""The file that says how this program is called: FreeCAD has another Python and another path."""


def install(folder: Path | None, *, force: bool) -> None:
    """Copy the add-on into a folder of add-ons, by default the user's own.

    Raises OutputError where the folder is not there, or has another version and is not to be replaced.
    """
    place = folder or _own()
    if not place.is_dir():
        raise OutputError(
            f"{place}: is no folder; start FreeCAD once, or name the folder Mod in that which its console "
            "gives for FreeCAD.getUserAppDataDir(): mechwright freecad FOLDER"
        )
    target = place / NAME
    files = {path.name: read_bytes(path) for path in sorted(ADDON.iterdir()) if path.is_file()}
    files[COMMAND] = (json.dumps([sys.executable, "-m", "mechwright"]) + "\n").encode()
    old = [
        name for name, data in files.items() if (target / name).exists() and read_bytes(target / name) != data
    ]
    if old and not force:
        raise OutputError(f"{target}: has another version ({old[0]}); --force to replace it")
    try:
        target.mkdir(exist_ok=True)
    except OSError as error:
        raise OutputError(f"{target}: cannot be written: {error.strerror}") from error
    for name, data in files.items():
        write_new(target / name, data, replace=True)
    echo(f"{target}: written; start FreeCAD, and choose the workbench {NAME}")


def _own() -> Path:
    """The user's folder of add-ons: FreeCAD 0.20 to 1.0, by system."""
    data = user_data_path("FreeCAD", appauthor=False, roaming=True)
    if data.is_dir():
        (data / "Mod").mkdir(exist_ok=True)
    return data / "Mod"
