"""A file that changes while a command works on it: one answer from one reading, and nobody's text is lost."""

import hashlib
import json
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from mechwright import reading
from mechwright.designs.design import load
from mechwright.errors import DesignError, OutputError
from mechwright.plugins.host import host

Run = Callable[..., tuple[int, str, str]]

SHORT = """\
family = "four-bar"
[parameters]
ground = 90
crank = 9.0
coupler = 80
pin_diameter = 6
rim = 4
"""
PLATE = """\
family = "plate"
[parameters]
drawing = "square.dxf"
[cam]
tool_library = "tools.toml"
"""
TOOL = """\
[[tool]]
name = "mine"
number = 60
kind = "end-mill"
diameter = 6.0
flutes = 3
flute_length = 20
[tool.cutting.aluminium]
cutting_speed = 200
chip_load = 0.04
step_down = 0.5
step_over = 0.4
"""


def test_a_file_is_read_once_where_that_is_asked_for(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"first")
    with reading.once():
        assert reading.read_bytes(path) == b"first"
        path.write_bytes(b"then")
        with reading.once():
            assert reading.read_bytes(path) == b"first"
        assert reading.read_bytes(path) == b"first"
        assert reading.read_bytes(path, anew=True) == b"then"
        with pytest.raises(DesignError, match="larger than 4 bytes"):
            reading.read_bytes(path, 4)
        seen: list[bytes] = []
        thread = threading.Thread(target=lambda: seen.append(reading.read_bytes(path)))
        thread.start()
        thread.join()
        assert seen == [b"then"]
    assert reading.read_bytes(path) == b"then"


def test_what_could_not_be_read_is_tried_again(tmp_path: Path) -> None:
    path = tmp_path / "a"
    with reading.once():
        with pytest.raises(OutputError):
            reading.read_bytes(path)
        path.write_bytes(b"there")
        assert reading.read_bytes(path) == b"there"


def test_lines_are_told_of_the_file_that_was_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where it is gone by then, it was asked for again, and that it cannot be read was all that was said."""
    path = tmp_path / "a.toml"
    path.write_text(SHORT + "lenght = 3\n", encoding="utf-8")
    from mechwright.designs import design

    def gone(*arguments: Any) -> Any:
        path.unlink()
        return made(*arguments)

    made = design.design_of
    monkeypatch.setattr(design, "design_of", gone)
    with pytest.raises(DesignError, match=r"line 8: parameters: unknown key 'lenght'"):
        load(path, host())


def test_the_manifest_has_the_hash_of_the_library_that_was_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command_line: Run
) -> None:
    import ezdxf

    from mechwright_cam.planning import prepare

    drawing = ezdxf.new(units=4)
    drawing.modelspace().add_lwpolyline([(0, 0), (40, 0), (40, 30), (0, 30)], close=True)
    drawing.saveas(tmp_path / "square.dxf")
    library = tmp_path / "tools.toml"
    library.write_text(TOOL, encoding="utf-8")
    design = tmp_path / "a.toml"
    design.write_text(PLATE, encoding="utf-8")
    used = {path.name: path.read_bytes() for path in (library, design, tmp_path / "square.dxf")}

    def replaced(*arguments: Any) -> Any:
        found = loaded(*arguments)
        library.write_text(TOOL.replace("6.0", "8.0"), encoding="utf-8")
        design.write_text("family = 'geneva'\n", encoding="utf-8")
        return found

    loaded = prepare.load_library
    monkeypatch.setattr(prepare, "load_library", replaced)
    code, _, err = command_line("cam", design, "-o", tmp_path / "out")
    assert code == 0, err
    told = json.loads((tmp_path / "out" / "manifest.json").read_text(encoding="utf-8"))["inputs_sha256"]
    assert told == {name: hashlib.sha256(data).hexdigest() for name, data in used.items()}
    assert library.read_bytes() != used["tools.toml"]


def test_fix_does_not_write_over_what_somebody_wrote_meanwhile(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command_line: Run
) -> None:
    from mechwright.cli import fixing

    path = tmp_path / "a.toml"
    path.write_text(SHORT, encoding="utf-8")
    theirs = SHORT.replace("90", "95")

    def meanwhile(*arguments: Any) -> Any:
        path.write_text(theirs, encoding="utf-8")
        return sought(*arguments)

    sought = fixing.repaired
    monkeypatch.setattr(fixing, "repaired", meanwhile)
    code, _, err = command_line("fix", path, "--to", "parts", "--write")
    assert code == 2
    assert (
        err
        == f"mechwright: {path}: has changed on disk since it was read; look at it first, then try again\n"
    )
    assert path.read_text(encoding="utf-8") == theirs


def test_the_page_tells_the_digest_of_what_it_shows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Else a page that shows the old file could save over the new one."""
    from mechwright_cad.live import session

    path = tmp_path / "a.toml"
    path.write_text(SHORT, encoding="utf-8")
    shown = hashlib.sha256(path.read_bytes()).hexdigest()
    one = session.Session(path, host())

    def late(design: Any) -> Any:
        path.write_text(SHORT.replace("90", "95"), encoding="utf-8")
        return fields(design)

    fields = session.fields_of
    monkeypatch.setattr(session, "fields_of", late)
    try:
        assert one.described({})["digest"] == shown
    finally:
        one.close()
