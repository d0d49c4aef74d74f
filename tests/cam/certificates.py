"""Certificates of the kept programs, written into folders, and what the checker says of them."""

import json
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import golden_operations
from by_control import BY_NAME

from mechwright_cad.exporters import DxfExporter
from mechwright_cam.machining import Machined
from mechwright_cam.pages.certificate.content import certificate
from mechwright_cam.pages.certificate.page import sealed
from mechwright_cam.program.endings import CERTIFICATE
from mechwright_check.__main__ import main

Change = Callable[[dict[str, Any]], None]


@cache
def said(operation: str, control: str) -> str:
    """The certificate of the first program of an operation, without its seal, as JSON."""
    item = made(operation, control)
    return json.dumps(certificate(item, control, BY_NAME[control].suffix))


def made(operation: str, control: str) -> Machined:
    return golden_operations.made(operation, control)[0]


def written(folder: Path, operation: str, control: str = "linuxcnc", change: Change | None = None) -> Path:
    """The certificate, with a change that is sealed anew, beside its program and its drawing."""
    item, content = made(operation, control), json.loads(said(operation, control))
    if change is not None:
        change(content)
    for stem, text in item.files.items():
        (folder / (stem + BY_NAME[control].suffix)).write_text(text, encoding="ascii")
    (folder / "drawing.dxf").write_bytes(DxfExporter("arc").part(item.job.part))
    path = folder / (item.program.name + CERTIFICATE)
    path.write_text(sealed(content), encoding="ascii")
    return path


def checked(capsys: Any, *arguments: object) -> tuple[int, str]:
    """Exit code of the checker, and the one line that it says last."""
    code = main([str(each) for each in arguments])
    out, err = capsys.readouterr()
    assert err == ""
    *notes, last = out.splitlines()
    assert all(note.startswith("note: ") for note in notes)
    assert not notes or code == 0
    return code, last
