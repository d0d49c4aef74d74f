"""Mechwright as another process: one process has one geometry kernel, and FreeCAD has its own."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Callable

from PySide import QtCore

COMMAND = Path(__file__).with_name("command.json")
_OF_FREECAD = ("PYTHONHOME", "PYTHONPATH", "LD_LIBRARY_PATH", "QT_PLUGIN_PATH")
"""Variables by which a packed FreeCAD leads its own Python and libraries; they would lead ours astray."""


class Run:
    """One call of Mechwright; ``said`` gets its lines as they come, ``done`` its exit code at the end."""

    def __init__(self, words: list[str], said: Callable[[str], None], done: Callable[[int], None]) -> None:
        program, *first = json.loads(COMMAND.read_text(encoding="utf-8"))
        self._said, self._done, self._rest = said, done, ""
        self._process = QtCore.QProcess()
        around = QtCore.QProcessEnvironment.systemEnvironment()
        for name in _OF_FREECAD:
            around.remove(name)
        around.insert("NO_COLOR", "1")
        around.insert("PYTHONIOENCODING", "utf-8")
        self._process.setProcessEnvironment(around)
        self._process.setProcessChannelMode(QtCore.QProcess.MergedChannels)
        self._process.readyReadStandardOutput.connect(self._read)
        self._process.finished.connect(self._finished)
        self._process.errorOccurred.connect(self._failed)
        self._program = program
        self._process.start(program, [*first, *words])
        self._process.closeWriteChannel()

    def stop(self) -> None:
        """End it; nothing is half written."""
        self._process.kill()

    def _read(self) -> None:
        self._rest += bytes(self._process.readAllStandardOutput()).decode("utf-8", "replace")
        *lines, self._rest = self._rest.replace("\r\n", "\n").split("\n")
        for line in lines:
            self._said(line)

    def _finished(self, code: int, *_: Any) -> None:
        self._read()
        if self._rest:
            self._said(self._rest)
        self._done(code)

    def _failed(self, error: Any) -> None:
        if error == QtCore.QProcess.FailedToStart:
            self._said(f"{self._program} cannot be run: type mechwright freecad --force in a terminal")
            self._done(-1)
