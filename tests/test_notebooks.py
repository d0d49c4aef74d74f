"""The notebooks run from top to bottom, and are kept without what they print."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from by_night import IN_CI

FOLDER = Path(__file__).parents[1] / "examples" / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
QUICK = {"sweep"}
"""Those that are tried with every change; the others by night."""
LONGEST = 600
"""s, of one cell."""
EXECUTED = os.environ.get("MECHWRIGHT_EXECUTED", "")
"""Folder for the notebooks with what their cells show, of which the site is built; empty for none."""


RUN = """
import json, sys
from pathlib import Path
import nbformat
from jupyter_client import KernelManager
from nbclient import NotebookClient

path = Path(sys.argv[1])
notebook = nbformat.read(path, as_version=4)
manager = KernelManager()
manager.kernel_spec.argv[0] = sys.executable
where = {"metadata": {"path": str(path.parent)}}
NotebookClient(notebook, timeout=int(sys.argv[2]), km=manager, resources=where).execute()
if len(sys.argv) > 3:
    nbformat.write(notebook, Path(sys.argv[3]) / path.name)
print(json.dumps([output for cell in notebook.cells for output in cell.get("outputs", ())]))
"""
"""Executes a notebook, which ends in an error where a cell does, prints what its cells show, and keeps it in a folder."""


def cells(path: Path) -> list[dict[str, object]]:
    content: list[dict[str, object]] = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return content


def test_there_is_one_for_each_family_a_sweep_and_one_of_figures() -> None:
    families = {"elliptic-gears", "five-bar", "four-bar", "geneva", "slider-crank", "spherical"}
    assert {path.stem for path in NOTEBOOKS} == families | {"sweep", "figures-of-the-sources"}
    for family in families:
        text = (FOLDER / f"{family}.ipynb").read_text(encoding="utf-8")
        assert "synthesize(" in text
        assert "program.proof.ok" in text


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_is_kept_without_outputs_and_holds_python(path: Path) -> None:
    for cell in cells(path):
        source = "".join(cell["source"])  # type: ignore[arg-type]
        assert source.strip()
        if cell["cell_type"] == "markdown":
            assert "\nassert " not in source, "code that never runs"
        if cell["cell_type"] == "code":
            assert (cell["outputs"], cell["execution_count"]) == ([], None)
            compile(source, path.name, "exec")


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_runs(path: Path) -> None:
    if path.stem not in QUICK and not IN_CI:
        pytest.skip("in CI besides, with MECHWRIGHT_CI=1")
    for library in ("nbclient", "ipykernel", "pandas", "plotly"):
        pytest.importorskip(library, reason="pip install 'mechwright[notebooks]'")
    # In a process of its own, where nobody minds what event loops leave behind.
    done = subprocess.run(
        [
            sys.executable,
            "-W",
            "ignore",
            "-c",
            RUN,
            str(path),
            str(LONGEST),
            *([EXECUTED] if EXECUTED else []),
        ],
        capture_output=True,
        text=True,
        check=False,
        timeout=2 * LONGEST,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    shown = json.loads(done.stdout)
    assert any("text/html" in output.get("data", {}) for output in shown)
    assert not [output for output in shown if output.get("name") == "stderr"]
