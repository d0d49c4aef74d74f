"""Runs inside FreeCAD 0.20: one profile and one pocket of a plate, and how long planning them took.

``freecadcmd freecad_job.py`` with the environment variable ``FREECAD_JOB`` naming a JSON file:

    {"step": file or null, "points": [[x, y], ...] or null, "thickness": mm, "pocket": [[x, y], ...],
     "pocket_depth": mm, "diameter": mm, "step_over": percent, "answer": file}

The answer holds for each operation the seconds of its recompute and its commands, [name, {letter: value}].
Settings that are not named here stay as FreeCAD has them; its tolerance for the job changes neither path.
"""

import json
import os
import sys
import time
import traceback
from pathlib import Path as File

import FreeCAD
import Part
from PathScripts import PathJob, PathPocketShape, PathProfile


def solid(case):
    if case["step"]:
        return Part.read(case["step"])
    thickness, up = case["thickness"], FreeCAD.Vector
    plate = prism(case["points"], 0.0, thickness, up)
    return plate.cut(prism(case["pocket"], thickness - case["pocket_depth"], case["pocket_depth"], up))


def prism(points, bottom, height, vector):
    corners = [vector(x, y, bottom) for x, y in points]
    face = Part.Face(Part.makePolygon([*corners, corners[0]]))
    return face.extrude(vector(0, 0, height))


def floor_of(shape, z):
    """Name of the flat face at this height."""
    for number, face in enumerate(shape.Faces, start=1):
        box = face.BoundBox
        if abs(box.ZMin - z) < 1e-6 and abs(box.ZMax - z) < 1e-6:
            return f"Face{number}"
    raise ValueError(f"no face at {z}")


def planned(document, operation):
    start = time.process_time()
    document.recompute()
    seconds = time.process_time() - start
    commands = [[command.Name, command.Parameters] for command in operation.Path.Commands]
    return {"seconds": seconds, "commands": commands}


def main():
    case = json.loads(File(os.environ["FREECAD_JOB"]).read_text())
    document = FreeCAD.newDocument("plate")
    model = document.addObject("Part::Feature", "Plate")
    model.Shape = solid(case)
    low, top = model.Shape.BoundBox.ZMin, model.Shape.BoundBox.ZMax
    document.recompute()
    job = PathJob.Create("Job", [model])
    document.recompute()
    controller = job.Tools.Group[0]
    controller.Tool.Diameter = case["diameter"]
    document.recompute()
    copy = job.Model.Group[0]
    answer = {"version": ".".join(FreeCAD.Version()[:3])}
    for name, make in (("profile", PathProfile.Create), ("pocket", PathPocketShape.Create)):
        operation = make(name)
        operation.ToolController = controller
        bottom = low
        if name == "pocket":
            bottom = top - case["pocket_depth"]
            operation.Base = [(copy, [floor_of(copy.Shape, bottom)])]
            operation.StepOver = case["step_over"]
            operation.OffsetPattern = "Offset"
        # One pass at full depth: the contour is what is compared, not the number of levels.
        for key, value in (("StartDepth", top), ("FinalDepth", bottom), ("StepDown", top - bottom)):
            operation.setExpression(key, None)
            setattr(operation, key, value)
        answer[name] = planned(document, operation)
    File(case["answer"]).write_text(json.dumps(answer))


try:
    main()
except Exception:
    traceback.print_exc()
sys.stdout.flush()
os._exit(0)  # freecadcmd would go on with a console
