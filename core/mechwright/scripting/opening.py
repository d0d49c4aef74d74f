"""Where a script begins: a design file, or a family and its parameters."""

from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from mechwright.contracts.finding import Findings, Stage
from mechwright.contracts.synthesis import Progress, unheard
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


def check(
    subject: str | PathLike[str] | Mechanism,
    /,
    *,
    to: Stage | str | None = None,
    progress: Progress = unheard,
    **parameters: Any,
) -> Findings:
    """What ``mechwright check`` finds of a design, with remedies that were tried.

    Parameters
    ----------
    subject
        A design file, a family as design files name it, or a mechanism. A text without a point is a family.
    to
        The last stage that is looked at, with all that is produced for it; see :meth:`Mechanism.check`.
    progress
        Called with the part that is done, 0 to 1, and with words.
    parameters
        Those of the family; of a file or a mechanism those that are changed.

    Returns
    -------
    findings
        The design can be built if ``findings.errors`` is empty.

    Raises
    ------
    DesignError
        One line for each key of the design that is wrong.
    OutputError, PluginError
        The file cannot be read, the family is not installed.

    Examples
    --------
    >>> [(one.code, one.remedy) for one in check("elliptic-gears", teeth=13).errors]
    [('gear.undercut', 'set teeth = 20 (now 13)')]
    """
    if isinstance(subject, str) and "." not in subject:
        return design(subject, **parameters).check(progress, to)
    given = subject if isinstance(subject, Mechanism) else load(subject)
    return (given.with_(**parameters) if parameters else given).check(progress, to)


def opened(content: Mapping[str, Any], path: Path, installed: Host) -> Mechanism:
    """The mechanism of what a file ``path`` would hold; raises DesignError for what is wrong with it."""
    return Mechanism(design_of(content, path, "", installed), installed)
