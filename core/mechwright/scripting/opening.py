"""Where a script begins: a design file, or a family and its parameters."""

from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from mechwright.designs.change import changed
from mechwright.designs.design import design_of
from mechwright.designs.schema import FORMAT
from mechwright.plugins.host import Host, host
from mechwright.scripting.changes import change_of
from mechwright.scripting.mechanism import Mechanism


def load(path: str | PathLike[str]) -> Mechanism:
    """The mechanism of a design file.

    Raises
    ------
    OutputError
        The file cannot be read.
    DesignError
        One line for each thing in it that is wrong.
    PluginError
        Its family is not installed.
    """
    opened = Mechanism(Path(path), host())
    opened.design  # noqa: B018 - what is wrong with the file is told here
    return opened


def design(family: str, /, *, name: str = "", **parameters: object) -> Mechanism:
    """A mechanism of a family, with defaults for what is not given.

    Parameters
    ----------
    family
        As design files name it: ``"elliptic-gears"``.
    name
        That of the design; by default the family's.
    parameters
        Of the family by their names; a table, such as ``cam={"clearance": 8}``, by its own.

    Raises
    ------
    DesignError
        One line for each thing that is wrong.
    PluginError
        The family is not installed.

    Examples
    --------
    >>> design("slider-crank", rot=80)
    Traceback (most recent call last):
    mechwright.errors.DesignError: slider-crank.toml: parameters: unknown key 'rot'; did you mean 'rod'?
    """
    installed = host()
    found = installed.family(family)
    stem = name or found.name
    head = {"format": FORMAT, "family": found.name, "name": stem, "parameters": {}}
    return opened(changed(head, change_of(installed, parameters)), Path(f"{stem}.toml"), installed)


def opened(content: Mapping[str, Any], path: Path, installed: Host) -> Mechanism:
    """The mechanism of what a file ``path`` would hold; raises DesignError for what is wrong with it."""
    return Mechanism(design_of(content, path, "", installed), installed)
