"""A public library of another program, as it lies in its repository: what is taken over, and what is told."""

import json
from pathlib import Path

import pytest

from mechwright_cam.shop.exporting import export
from mechwright_cam.shop.library import load_library

DATA = json.loads((Path(__file__).parents[1] / "data" / "freecad-tools.json").read_text(encoding="utf-8"))


def written(folder: Path) -> Path:
    (folder / "Bit").mkdir()
    (folder / "Library").mkdir()
    for name, bit in DATA["bits"].items():
        (folder / "Bit" / f"{name}.fctb").write_text(json.dumps(bit), encoding="utf-8")
    path = folder / "Library" / "Default.fctl"
    path.write_text(json.dumps(DATA["library"]), encoding="utf-8")
    return path


def test_the_tools_of_better_tool_library(tmp_path: Path) -> None:
    """Decimal commas, sizes in two units, shapes of its own, bits that contradict themselves."""
    library = load_library(written(tmp_path))
    found = {tool.number: (str(tool.kind), tool.diameter, tool.flute_length) for tool in library}
    assert found == {
        6: ("end-mill", 12.65, 26.0),
        14: ("ball", 2.5, 12.0),
        23: ("end-mill", 1.5, 4.0),
        24: ("end-mill", 3.17, 15.0),
        38: ("end-mill", 1.0, 7.0),
        43: ("reamer", 5.0, 30.0),
        45: ("thread-mill", 5.0, 20.0),
        46: ("bull-nose", 5.0, 30.0),
        47: ("chamfer-mill", 10.0, 2.0),
        48: ("end-mill", 1.0, 10.0),
    }
    left = {line.partition("(T")[2].partition(")")[0] for line in library.told if "is left out" in line}
    listed = {str(row["nr"]) for row in DATA["library"]["tools"]}
    assert {str(number) for number in found} | left == listed
    assert len(left) == 5
    assert any(
        "'New V-Bit' (T39) is left out: CuttingEdgeAngle says 90 degrees" in line for line in library.told
    )


@pytest.mark.parametrize("suffix", [".fctl", ".json", ".tbl", ".toml"])
def test_they_come_back_from_other_formats(suffix: str, tmp_path: Path) -> None:
    library = load_library(written(tmp_path))
    (tmp_path / "out" / "Library").mkdir(parents=True)
    path = tmp_path / "out" / "Library" / f"crib{suffix}"
    export(tuple(library), path)
    back = {tool.number: tool for tool in load_library(path)}
    for tool in library:
        if tool.number in back:
            assert back[tool.number].diameter == pytest.approx(tool.diameter)
            assert back[tool.number].kind is tool.kind
    assert len(back) >= 8
