"""A plugin of somebody else, installed in a folder for processes that a test starts."""

import os
import subprocess
import sys
import textwrap
from pathlib import Path

NAME = "rude"
WHO = f"plugin {NAME} of {NAME}-mechanisms"
"""What a message calls it."""
PLUGIN = """
from mechwright import Family, Parameters, Procedure, hookimpl, in_turn
class P(Parameters):
    pass
class Rude(Family[P]):
    name = "rude"
    title = "Rude"
    summary = "Rude."
    Params = P
    def rules(self):
        return in_turn(Procedure((), self.found))
    def found(self, table):
        params = table.params
{check}
        return []
    def solve(self, params, samples):
        raise SystemExit(0)
    def parts(self, params):
        return []
@hookimpl
def mechwright_register():
    return [Rude]
"""


def installed(folder: Path, check: str, head: str = "") -> Path:
    """A design file of a family whose ``check`` does some lines; its module begins with others."""
    body = textwrap.indent(textwrap.dedent(check).strip(), 8 * " ")
    (folder / f"{NAME}.py").write_text(head + PLUGIN.format(check=body))
    info = folder / f"{NAME}_mechanisms-1.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {NAME}-mechanisms\nVersion: 1\n")
    (info / "entry_points.txt").write_text(f"[mechwright]\n{NAME} = {NAME}\n")
    design = folder / "d.toml"
    design.write_text(f'family = "{NAME}"\n')
    return design


def run(folder: Path, *words: object) -> "subprocess.CompletedProcess[str]":
    """A command in a folder, in a process that finds what is installed there."""
    return subprocess.run(
        [sys.executable, "-m", "mechwright", *map(str, words)],
        capture_output=True,
        text=True,
        env={
            **os.environ,
            "PYTHONPATH": os.pathsep.join(filter(None, (str(folder), os.environ.get("PYTHONPATH")))),
        },
        cwd=folder,
        check=False,
        timeout=120,
    )
