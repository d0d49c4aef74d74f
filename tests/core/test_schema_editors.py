"""What an editor says of new files: taplo, which stands behind the editors' extensions for TOML, where it is at hand.

It follows the first line of the file, ``#:schema ./NAME.schema.json``, without a network.
"""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from mechwright.contracts.family import Family
from mechwright.plugins.host import host

TAPLO = os.environ.get("MECHWRIGHT_TAPLO") or shutil.which("taplo")
pytestmark = pytest.mark.skipif(
    TAPLO is None, reason="taplo is not installed (npm package @taplo/cli; MECHWRIGHT_TAPLO)"
)


def linted(path: Path) -> tuple[int, str]:
    done = subprocess.run(
        [str(TAPLO), "lint", path.name], cwd=path.parent, capture_output=True, text=True, check=False
    )
    return done.returncode, done.stdout + done.stderr


@pytest.mark.parametrize("family", [one.name for one in host().all(Family)])
def test_taplo_accepts_a_new_file_and_finds_a_wrong_key(command_line, tmp_path, family):
    path = tmp_path / "design.toml"
    assert command_line("new", family, "-o", path)[0] == 0
    first = path.read_text(encoding="utf-8").splitlines()[0]
    assert command_line("schema", family, "-o", tmp_path / first.removeprefix("#:schema ./"))[0] == 0
    code, said = linted(path)
    assert code == 0, said
    path.write_text(path.read_text(encoding="utf-8").replace("[parameters]", "[parameters]\nthicknes = 3", 1))
    code, said = linted(path)
    assert code != 0
    assert "'thicknes' was unexpected" in said
