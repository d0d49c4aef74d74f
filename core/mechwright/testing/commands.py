"""The command line as a user would call it, in a process of its own."""

import json
import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mechwright.testing.rules import toml


def machine(design: Mapping[str, Any], folder: Path) -> dict[str, dict[str, Any]]:
    """Run ``mechwright cam`` on a design.

    Parameters
    ----------
    design
        The content of the design file.
    folder
        An empty folder to work in.

    Returns
    -------
    proofs
        Part name to its proof, as ``proof.json`` holds it.

    Raises
    ------
    AssertionError
        The command failed; the message is what it printed. Or a program is missing.
    """
    file, output = folder / "design.toml", folder / "out"
    file.write_text(toml(design), encoding="utf-8")
    done = subprocess.run(  # noqa: S603 - our own interpreter and our own words
        [sys.executable, "-m", "mechwright", "cam", file, "-o", output],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        raise AssertionError(f"mechwright cam ends with {done.returncode}:\n{done.stdout}{done.stderr}")
    proofs: dict[str, dict[str, Any]] = json.loads((output / "proof.json").read_text(encoding="utf-8"))
    for part in proofs:
        if not list(output.glob(f"{part}.*")):
            raise AssertionError(f"there is a proof of {part}, but no file")
    return proofs
