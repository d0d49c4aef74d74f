"""The panel: a design file, its parts and motion, and its programs."""

from __future__ import annotations

import tempfile
from typing import Any, Callable

import FreeCAD
import FreeCADGui
from mechwright_bodies import Assembly, too_old
from mechwright_run import Run
from PySide import QtCore, QtGui

COMMAND = "Mechwright_Design"
INTERVAL = 40
"""Milliseconds between two pictures of the motion."""

BROWSE = 32
"""Width of a button that opens a dialog of files, pixels: the names beside it are long."""


class Panel:
    """A panel of FreeCAD's task view."""

    def __init__(self) -> None:
        self.assembly: Assembly | None = None
        self.code: int | None = None
        self._run: Run | None = None
        self._folder = tempfile.TemporaryDirectory(prefix="mechwright-")
        self._timer = QtCore.QTimer()
        self._timer.timeout.connect(self._step)
        self.form = QtGui.QWidget()
        self.form.setWindowTitle("Mechwright")
        self.design = self._line("Design file (TOML)")
        self.output = self._line("Folder for the programs")
        self.show = self._button("Show parts and motion", self.shown)
        self.write = self._button("Write programs", self.written)
        self.position = QtGui.QSlider(QtCore.Qt.Horizontal)
        self.position.setToolTip("Position within one period of the motion")
        self.position.valueChanged.connect(self._moved)
        self.play = self._button("Play", self._played)
        self.lines = QtGui.QPlainTextEdit()
        self.lines.setReadOnly(True)
        layout = QtGui.QVBoxLayout(self.form)
        for label, line, choose in (
            ("Design", self.design, self._choose_design),
            ("Programs", self.output, self._choose_folder),
        ):
            row = QtGui.QHBoxLayout()
            row.addWidget(QtGui.QLabel(label))
            row.addWidget(line)
            button = self._button("...", choose)
            button.setMaximumWidth(BROWSE)
            row.addWidget(button)
            layout.addLayout(row)
        for widget in (self.show, self.write):
            layout.addWidget(widget)
        row = QtGui.QHBoxLayout()
        row.addWidget(self.play)
        row.addWidget(self.position)
        layout.addLayout(row)
        layout.addWidget(self.lines)
        self._moving(0)
        self._tell(too_old() or "Choose a design file.")

    def getStandardButtons(self) -> int:
        """Close alone: nothing here is taken back."""
        return int(QtGui.QDialogButtonBox.Close)

    def reject(self) -> bool:
        """Close the panel; what runs is ended, and the bodies stay."""
        self._timer.stop()
        if self._run is not None:
            self._run.stop()
        FreeCADGui.Control.closeDialog()
        self._folder.cleanup()
        return True

    def shown(self) -> None:
        """Have the solids made, and put them into a document."""
        words = ["model", self.design.text(), "-o", self._folder.name, "--also", "glb"]
        self._start(words, self._load)

    def written(self) -> None:
        """Have the programs written."""
        if not self.output.text():
            self._tell("Choose a folder for the programs.")
            return
        self._start(["cam", self.design.text(), "-o", self.output.text()], lambda: None)

    def _start(self, words: list[str], then: Callable[[], None]) -> None:
        if self._run is not None or not self.design.text():
            self._tell("Choose a design file." if self._run is None else "Wait until the last command ends.")
            return
        if old := too_old():
            self._tell(old)
            return
        self.code = None
        self._tell(f"mechwright {' '.join(words)}")
        self._enable(False)

        def done(code: int) -> None:
            self._run = None
            self._enable(True)
            if code == 0:
                then()
            else:
                self._tell(f"It ended with exit code {code}; nothing was written.")
            self.code = code

        self._run = Run(words, self._tell, done)

    def _load(self) -> None:
        document = FreeCAD.newDocument("Mechwright")
        try:
            self.assembly = Assembly(self._folder.name, document)
            self.assembly.colour()
        except (OSError, ValueError, LookupError, FreeCAD.Base.FreeCADError) as error:
            self._tell(f"The files cannot be shown: {error}")
            return
        document.recompute()
        self._moving(self.assembly.count)
        FreeCADGui.activeDocument().activeView().viewIsometric()
        FreeCADGui.SendMsgToActiveView("ViewFit")
        self._tell(f"{len(self.assembly.names)} bodies: {', '.join(self.assembly.names)}")

    def _moving(self, count: int) -> None:
        self.position.setRange(0, max(count - 1, 0))
        self.position.setEnabled(count > 1)
        self.play.setEnabled(count > 1)

    def _moved(self, position: int) -> None:
        if self.assembly is not None:
            self.assembly.move(position)

    def _played(self) -> None:
        if self._timer.isActive():
            self._timer.stop()
        else:
            self._timer.start(INTERVAL)
        self.play.setText("Pause" if self._timer.isActive() else "Play")

    def _step(self) -> None:
        # The last position is the first one again.
        self.position.setValue((self.position.value() + 1) % max(self.position.maximum(), 1))

    def _enable(self, free: bool) -> None:
        self.show.setEnabled(free)
        self.write.setEnabled(free)

    def _tell(self, line: str) -> None:
        self.lines.appendPlainText(line)

    def _line(self, hint: str) -> Any:
        line = QtGui.QLineEdit()
        line.setPlaceholderText(hint)
        return line

    def _button(self, text: str, clicked: Callable[[], None]) -> Any:
        button = QtGui.QPushButton(text)
        button.clicked.connect(lambda *_: clicked())
        return button

    def _choose_design(self) -> None:
        name, _ = QtGui.QFileDialog.getOpenFileName(self.form, "Design file", "", "Design files (*.toml)")
        if name:
            self.design.setText(name)

    def _choose_folder(self) -> None:
        name = QtGui.QFileDialog.getExistingDirectory(self.form, "Folder for the programs")
        if name:
            self.output.setText(name)


class Command:
    """The command that opens the panel."""

    def GetResources(self) -> dict[str, str]:
        """Its words in menus."""
        return {"MenuText": "Design file...", "ToolTip": "Show a design, and have its programs written"}

    def IsActive(self) -> bool:
        """Whether no other panel is open."""
        return not FreeCADGui.Control.activeDialog()

    def Activated(self) -> None:
        """Open the panel."""
        FreeCADGui.Control.showDialog(Panel())


def register() -> None:
    """Register the command."""
    FreeCADGui.addCommand(COMMAND, Command())
