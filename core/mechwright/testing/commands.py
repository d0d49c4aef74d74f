"""What a fresh interpreter sees: the command line as a user would call it, and what an import brings in."""

import json
import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mechwright.designs.text import toml

_COLLISION = "interference.collision"
"""Code of the finding that two bodies collide."""
HEAVY = ("cadquery", "ezdxf", "flint", "jinja2", "numba", "OCP", "scipy", "shapely")
"""Libraries that take from 30 ms to seconds to import; work that does not need them never pays for them."""


def machine(design: Mapping[str, Any], folder: Path) -> dict[str, dict[str, Any]]:
    """Run ``mechwright cam`` on the content of a design file, in an empty folder to work in.

    Gives part name to its proof, as ``proof.json`` holds it. Raises AssertionError with what the command
    printed where it failed, or where a program is missing.
    """
    output = folder / "out"
    done = _run(design, folder, "cam", "-o", output)
    if done.returncode:
        raise AssertionError(f"mechwright cam ends with {done.returncode}:\n{done.stdout}{done.stderr}")
    proofs: dict[str, dict[str, Any]] = json.loads((output / "proof.json").read_text(encoding="utf-8"))
    for part in proofs:
        if not list(output.glob(f"{part}.*")):
            raise AssertionError(f"there is a proof of {part}, but no file")
    return proofs


def collisions(design: Mapping[str, Any], folder: Path, *, solids: bool) -> list[str]:
    """What stands in what while the mechanism of a design moves: a message for each pair of bodies.

    ``folder`` is an empty one to work in; with ``solids`` parts that are no plates are compared, where solids
    are made. Raises AssertionError with what the command printed where it failed otherwise.
    """
    if solids:
        done = _run(design, folder, "model", "-o", folder / "out")
        found = [line for line in done.stderr.splitlines() if _COLLISION in line]
        if done.returncode and not found:
            raise AssertionError(f"mechwright model ends with {done.returncode}:\n{done.stdout}{done.stderr}")
        return found
    done = _run(design, folder, "check", "--json")
    try:
        findings = json.loads(done.stdout)["findings"]
    except ValueError as error:
        raise AssertionError(f"mechwright check says:\n{done.stdout}{done.stderr}") from error
    return [finding["message"] for finding in findings if finding["code"] == _COLLISION]


def _run(
    design: Mapping[str, Any], folder: Path, command: str, *options: str | Path
) -> subprocess.CompletedProcess[str]:
    file = folder / "design.toml"
    file.write_text("".join(f"{key} = {toml(value)}\n" for key, value in design.items()), encoding="utf-8")
    return _python("-m", "mechwright", command, file, *options)


def heavy_imports(module: str) -> list[str]:
    """Give the heavy libraries that importing ``module`` loads; AssertionError if it cannot be imported.

    >>> heavy_imports("mechwright.geometry")
    []
    """
    words = f"import sys, importlib; importlib.import_module({module!r}); print(*sorted(sys.modules))"
    done = _python("-c", words)
    if done.returncode:
        raise AssertionError(f"import {module} fails:\n{done.stderr}")
    return sorted(set(done.stdout.split()) & set(HEAVY))


def _python(*words: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(  # noqa: S603 - our own interpreter and our own words
        [sys.executable, *words],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
        capture_output=True,
        text=True,
        check=False,
    )
