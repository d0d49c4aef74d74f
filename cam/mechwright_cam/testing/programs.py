"""Programs and jobs for tests of controls: every kind of move, cutter compensation, a plate to be planned."""

from typing import Any, Literal

from mechwright.contracts.part import Part
from mechwright.geometry import Loop, Outline, circle
from mechwright_cam.program.moves import Drill, Feed, FeedArc, Operation, Pause, Program, Rapid, ToolSection
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.posting import Compensation
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool, ToolKind

CLEARANCE = 5.0
"""Height of rapid moves in the sample program, mm."""


def sample_program() -> Program:
    """A small program that a mill could run: two tools, and every kind of move at least once.

    A drill makes three holes, one with pecks and one with a dwell. An end mill enters on a helix, cuts a full
    circle, waits for the operator, and goes along two sides and a rounded corner. All of it stays inside a
    plate of 60 mm x 40 mm x 6 mm whose lower left corner is the origin.
    """
    drill = Tool(name="drill-5", number=3, kind=ToolKind.DRILL, diameter=5.0, flute_length=40.0)
    mill = Tool(name="mill-6", number=12, kind=ToolKind.END_MILL, diameter=6.0, flute_length=20.0)
    holes = Operation(
        "drill holes",
        (
            Rapid(x=10.0, y=10.0),
            Rapid(z=CLEARANCE),
            Drill(10.0, 10.0, -7.5, 2.0, 120.0),
            Drill(50.0, 10.0, -7.5, 2.0, 120.0, peck=2.5),
            Drill(50.0, 30.0, -2.5, 2.0, 120.0, dwell=0.5),
            Rapid(z=CLEARANCE),
        ),
    )
    opening = Operation(
        "round opening",
        (
            Rapid(x=34.0, y=20.0),
            Rapid(z=CLEARANCE),
            Rapid(z=1.0),
            Feed(None, None, 0.0, 300.0),
            FeedArc(34.0, 20.0, -2.0, -4.0, 0.0, True, 200.0),
            FeedArc(34.0, 20.0, None, -4.0, 0.0, True, 300.0),
            Rapid(z=CLEARANCE),
            Pause("Take the slug out"),
        ),
    )
    corner = Operation(
        "rounded corner",
        (
            Rapid(x=5.0, y=30.0),
            Rapid(z=1.0),
            Feed(7.25, 30.0, -1.5, 150.0),
            Feed(20.125, None, None, 400.0),
            FeedArc(25.125, 25.0, None, 0.0, -5.0, False, 350.0),
            Feed(None, 12.5, None, 400.0),
            Rapid(z=CLEARANCE),
        ),
    )
    return Program(
        name="sample",
        work_offset="G55",
        clearance=CLEARANCE,
        sections=(
            ToolSection(drill, 2500.0, "flood", (holes,)),
            ToolSection(mill, 6000.0, "mist", (opening, corner)),
        ),
        notes=("Sample of every kind of move", "Plate 60 x 40 x 6 mm, origin at its lower left corner"),
    )


def plate_job(**settings: Any) -> Job:
    """The job of a plate of 60 mm x 40 mm x 6 mm with a bore of 14 mm, held by tabs; see [cam]."""
    corners = [(-30.0, -20.0), (30.0, -20.0), (30.0, 20.0), (-30.0, 20.0)]
    outline = Outline(Loop.polygon(corners), (Loop((circle((0.0, 0.0), 7.0, clockwise=True),)),))
    library = load_library()
    cam = CamSettings.model_validate({"hold": {"method": "tabs", "tabs": 2}, **settings})
    return make_job(Part("plate", outline, 6.0, "aluminium"), cam, [library.get("mill-6")])


def compensated_sample(way: Compensation, quantity: Literal["radius", "diameter"]) -> tuple[Job, Program]:
    """The plate, and a program that goes around it with the mill on the left of its contour.

    ``quantity`` is what D holds where that is a setting of the machine.
    """
    job = plate_job(compensation=way, post={"d_value": quantity})
    (mill,) = job.tools
    around = ((-30.0, 20.0), (30.0, 20.0), (30.0, -20.0), (-30.0, -20.0))
    outline = Operation(
        "outline",
        (
            Rapid(x=-50.0, y=-30.0),
            Rapid(z=1.0),
            Feed(None, None, -6.25, 300.0),
            Feed(-30.0, -20.0, None, 300.0, side="left"),
            *(Feed(x, y, None, 400.0) for x, y in around),
            Feed(-50.0, -30.0, None, 400.0, side="off"),
            Rapid(z=CLEARANCE),
        ),
    )
    section = ToolSection(mill, 6000.0, "flood", (outline,))
    settings = job.settings
    program = Program(
        "outline",
        settings.work_offset,
        CLEARANCE,
        (section,),
        posting=settings.post,
        compensation=way,
        wear_limit=settings.wear_limit,
    )
    return job, program
