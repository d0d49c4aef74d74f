"""Runs inside FreeCAD's window, as ``freecad freecad_panel.py``: the panel shows a design and writes its programs.

``MECHWRIGHT_FREECAD`` names a file with ``{"addon": FOLDER, "design": FILE, "output": FOLDER, "answer": FILE,
"picture": FILE}``.
"""

import json
import os
import sys
import time
import traceback

case = json.load(open(os.environ["MECHWRIGHT_FREECAD"]))  # noqa: PTH123, SIM115 - FreeCAD's own Python
sys.path.insert(0, case["addon"])
answer = {}
SECONDS = 240


def waited(panel):
    """The exit code of what the panel has started."""
    from PySide import QtCore

    end = time.monotonic() + SECONDS
    while panel.code is None and time.monotonic() < end:
        QtCore.QCoreApplication.processEvents()
        time.sleep(0.01)
    return panel.code


def main():
    import FreeCADGui
    import mechwright_panel
    from PySide import QtCore, QtGui

    start = os.path.join(case["addon"], "InitGui.py")  # noqa: PTH118
    exec(compile(open(start).read(), start, "exec"), {})  # noqa: PTH123, S102, SIM115 - as FreeCAD does
    FreeCADGui.activateWorkbench("MechwrightWorkbench")
    answer["commands"] = [one for one in FreeCADGui.listCommands() if one == mechwright_panel.COMMAND]
    panel = mechwright_panel.Panel()
    FreeCADGui.Control.showDialog(panel)
    panel.design.setText(case["design"] + ".none")
    panel.shown()
    answer["missing"] = [waited(panel), panel.lines.toPlainText().splitlines()[-2:]]
    panel.design.setText(case["design"])
    panel.shown()
    answer["shown"] = waited(panel)
    answer["names"] = panel.assembly.names
    answer["colours"] = [list(one.ViewObject.ShapeColor)[:3] for one in panel.assembly.features]
    panel.position.setValue(panel.position.maximum() // 3)
    answer["centres"] = [list(one.Shape.CenterOfGravity) for one in panel.assembly.features]
    panel.written()
    answer["without a folder"] = panel.lines.toPlainText().splitlines()[-1]
    panel.output.setText(case["output"])
    panel.written()
    answer["written"] = waited(panel)
    for _ in range(50):
        QtCore.QCoreApplication.processEvents()
        time.sleep(0.02)
    answer["lines"] = panel.lines.toPlainText().splitlines()
    screen = QtGui.QGuiApplication.primaryScreen() if hasattr(QtGui, "QGuiApplication") else None
    if screen is None:
        from PySide2.QtGui import QGuiApplication

        screen = QGuiApplication.primaryScreen()
    screen.grabWindow(0).save(case["picture"])


try:
    main()
except Exception:
    answer["error"] = traceback.format_exc()
json.dump(answer, open(case["answer"], "w"))  # noqa: PTH123, SIM115
os._exit(0)
