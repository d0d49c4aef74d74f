"""Runs inside FreeCAD, as ``freecadcmd freecad_bodies.py``: the bodies of folders by the add-on, as JSON.

``MECHWRIGHT_FREECAD`` names a file with ``{"addon": FOLDER, "folders": [...], "answer": FILE}``.
"""

import json
import os
import sys
import traceback

case = json.load(open(os.environ["MECHWRIGHT_FREECAD"]))  # noqa: PTH123, SIM115 - FreeCAD's own Python
sys.path.insert(0, case["addon"])
answer = {}
try:
    import FreeCAD
    from mechwright_bodies import Assembly

    for folder in case["folders"]:
        assembly = Assembly(folder, FreeCAD.newDocument("x"))
        middle = assembly.count // 3
        centres = []
        for position in (0, middle):
            assembly.move(position)
            centres.append([list(one.Shape.CenterOfGravity) for one in assembly.features])
        answer[folder] = {
            "names": [one.Label for one in assembly.features],
            "solids": [len(one.Shape.Solids) for one in assembly.features],
            "volumes": [one.Shape.Volume for one in assembly.features],
            "count": assembly.count,
            "share": middle / max(assembly.count - 1, 1),
            "centres": centres,
        }
except Exception:
    traceback.print_exc()
json.dump(answer, open(case["answer"], "w"))  # noqa: PTH123, SIM115
os._exit(0)  # freecadcmd would go on with a console
