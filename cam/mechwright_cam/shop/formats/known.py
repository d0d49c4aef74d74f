"""The formats that are known, by the ends of their files' names."""

from pathlib import Path

from mechwright.errors import DesignError
from mechwright_cam.shop.formats.contract import Format
from mechwright_cam.shop.formats.freecad import FreeCadLibrary
from mechwright_cam.shop.formats.fusion import FusionLibrary
from mechwright_cam.shop.formats.linuxcnc import LinuxCncTable

FORMATS: tuple[Format, ...] = (LinuxCncTable(), FusionLibrary(), FreeCadLibrary())
OWN = ".toml"
"""The end of the names of our own libraries."""
ELSEWHERE = {
    ".fctb": "is a single FreeCAD bit; name the library that lists it, an .fctl",
    ".hsmlib": "is an old HSMWorks library; export it from Fusion as .json or .tools",
    ".csv": "is a table of another program; export the library as .json, .tools, .fctl or .tbl",
    ".tsv": "is a table of another program; export the library as .json, .tools, .fctl or .tbl",
    ".zip": "is a ZIP of anything; a Fusion library is called .tools",
}
"""What is said of files that are no library of a known format."""


def format_of(path: Path) -> Format | None:
    """The format of a library; None for our own. Raises DesignError for a file of another known kind."""
    suffix = path.suffix.lower()
    if suffix in ELSEWHERE:
        raise DesignError(f"{path}: {ELSEWHERE[suffix]}")
    form = next((one for one in FORMATS if suffix in one.suffixes), None)
    if form is None and suffix != OWN:
        raise DesignError(f"{path}: is of no known format; end its name in one of: {', '.join(suffixes())}")
    return form


def suffixes() -> tuple[str, ...]:
    """The ends of the names of all libraries."""
    return (OWN, *(suffix for one in FORMATS for suffix in one.suffixes))
