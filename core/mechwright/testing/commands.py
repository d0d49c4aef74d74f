"""What the command line says of a design file, and what an import brings into a fresh interpreter."""

import contextlib
import io
import os
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mechwright.cli import main
from mechwright.contracts.finding import errors
from mechwright.designs.text import toml
from mechwright.errors import MechwrightError
from mechwright.pipeline import Build, Inspection, Wanted
from mechwright.plugins.host import host

_INTERFERENCE = "interference"
"""The inspection that looks for bodies that collide, by the name under which it is registered."""
_COLLISION = "interference.collision"
"""Code of its finding that two do."""
_CONTACT = "contact"
"""The inspection that looks for bodies that touch nothing."""
HEAVY = ("cadquery", "ezdxf", "flint", "jinja2", "numba", "OCP", "scipy", "shapely")
"""Libraries that take from 30 ms to seconds to import; work that does not need them never pays for them."""


@dataclass(frozen=True)
class Done:
    """What a command has ended with."""

    returncode: int
    stdout: str
    stderr: str


def run(*arguments: object) -> Done:
    """Run the whole command line in this process: a new one would import again all that is here.

    >>> run("--version").returncode
    0
    """
    out, err, given = io.StringIO(), io.StringIO(), sys.argv
    code: object = 0
    try:
        sys.argv = ["mechwright", *map(str, arguments)]
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            main()
    except SystemExit as stop:
        code = stop.code
    finally:
        sys.argv = given
    return Done(code if isinstance(code, int) else int(code is not None), out.getvalue(), err.getvalue())


def machine(design: Mapping[str, Any], folder: Path) -> dict[str, dict[str, Any]]:
    """The programs that ``mechwright cam`` writes for the content of a design file, in an empty folder.

    Gives part name to its proof, as ``proof.json`` holds it. Raises AssertionError with what is said where
    there are no programs, or where a text is missing. Pages and drawings are not made: those are no family's.
    """
    with Build(_written(design, folder), host(), Wanted(command="cam")) as build:
        try:
            made = build.programs
        except MechwrightError as error:
            raise AssertionError(f"there are no programs:\n{error}") from error
    for one in made:
        if not any(text.strip() for text in one.files.values()):
            raise AssertionError(f"there is a proof of {one.name}, but no text")
    return {one.name: one.proof.as_dict() for one in made}


def collisions(design: Mapping[str, Any], folder: Path, *, solids: bool) -> list[str]:
    """What stands in what while the mechanism of a design moves: a message for each pair of bodies.

    ``folder`` is an empty one to work in; with ``solids`` parts that are no plates are compared as well. The
    commands ``model`` and ``solve`` look for the same before they write anything. Raises AssertionError where
    the design is refused for anything else.
    """
    wanted = Wanted(command="model" if solids else "solve")
    with Build(_written(design, folder), host(), wanted) as build:
        try:
            refused = errors(build.findings)
            found = () if refused else build.host.get(Inspection, _INTERFERENCE).findings(build)
        except MechwrightError as error:
            raise AssertionError(str(error)) from error
    if refused:
        raise AssertionError("\n".join(f"{one.code}: {one.message}" for one in refused))
    return [finding.message for finding in found if finding.code == _COLLISION]


def gaps(design: Mapping[str, Any], folder: Path) -> list[str] | None:
    """Bodies of a machine that touch nothing, and gaps that no part declares: a message for each.

    ``folder`` is an empty one to work in. None where the design is refused.
    """
    with Build(_written(design, folder), host(), Wanted(command="check")) as build:
        if errors(build.findings):
            return None
        return [one.message for one in build.host.get(Inspection, _CONTACT).findings(build)]


def _written(design: Mapping[str, Any], folder: Path) -> Path:
    file = folder / "design.toml"
    text = "".join(f"{key} = {toml(value)}\n" for key, value in design.items())
    file.write_text(text, encoding="utf-8", newline="\n")
    return file


def heavy_imports(module: str) -> list[str]:
    """Give the heavy libraries that importing ``module`` loads; AssertionError if it cannot be imported.

    >>> heavy_imports("mechwright.geometry")
    []
    """
    words = f"import sys, importlib; importlib.import_module({module!r}); print(*sorted(sys.modules))"
    done = subprocess.run(  # noqa: S603 - our own interpreter and our own words
        [sys.executable, "-c", words],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )
    if done.returncode:
        raise AssertionError(f"import {module} fails:\n{done.stderr}")
    return sorted(set(done.stdout.split()) & set(HEAVY))
