"""The programs whose text is kept in tests/golden, control by control: ``python golden_programs.py`` writes them.

Every text has been read line by line as a machinist would before it was kept; read it again when it changes.
"""

from dataclasses import replace
from pathlib import Path

from by_control import EVERY

from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.program.moves import Drill, Feed, FeedArc, Operation, Pause, Program, Rapid, ToolSection
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.posting import Measured, Posting
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool, ToolKind

FOLDER = Path(__file__).parents[1] / "golden"

SPOT = Tool(name="spot-6", number=1, kind=ToolKind.SPOT_DRILL, diameter=6, flute_length=8, point_angle=90)
DRILL = Tool(name="drill-5", number=2, kind=ToolKind.DRILL, diameter=5, flute_length=40)
MILL = Tool(name="mill-6", number=3, kind=ToolKind.END_MILL, diameter=6, flutes=3, flute_length=20)


def every_operation() -> Program:
    """Spot, drill, peck, dwell, bore on a helix, slot, pocket ramp, contour with a tab, a stop for a clamp."""
    spots = Operation(
        "spot drill",
        (Rapid(10, 10, 5), Drill(10, 10, -1.5, 1, 160, dwell=0.2), Drill(50, 10, -1.5, 1, 160, dwell=0.2)),
    )
    holes = Operation(
        "drill 5",
        (Rapid(10, 10, 5), Drill(10, 10, -7.5, 1, 200), Drill(50, 10, -7.5, 1, 200), Rapid(z=5)),
    )
    deep = Operation("peck drill 5", (Rapid(50, 30, 5), Drill(50, 30, -17.5, 1, 180, peck=4), Rapid(z=5)))
    chips = Operation(
        "drill 5, chips broken",
        (Rapid(20, 35, 5), Drill(20, 35, -9.5, 1, 190, peck=4, breaking=True), Rapid(z=5)),
    )
    bore = Operation(
        "bore: helix",
        (
            Rapid(34, 20),
            Rapid(z=1),
            Feed(None, None, 0, 300),
            FeedArc(34, 20, -2, -4, 0, True, 250),
            FeedArc(34, 20, -4, -4, 0, True, 250),
            FeedArc(34, 20, None, -4, 0, True, 400),
            Feed(30, 20, None, 400),
            Rapid(z=5),
        ),
    )
    slot = Operation(
        "slot: ramp and finish",
        (
            Rapid(10, 30),
            Rapid(z=1),
            Feed(None, None, 0, 300),
            Feed(22.12345, 30, -0.63333, 250),
            Feed(10, 30, -1.26667, 250),
            Feed(22.12345, 30, None, 500),
            Rapid(z=5),
            Pause("clamp the part through the bore"),
        ),
    )
    contour = Operation(
        "outside: finish",
        (
            Rapid(-10, -3),
            Rapid(z=1),
            Feed(None, None, -6.3, 600),
            FeedArc(-3, 4, None, 0, 7, True, 500),
            Feed(-3, 15, None, 500),
            Feed(None, None, -4.9, 500),
            Feed(-3, 23, None, 500),
            Feed(None, None, -6.3, 150),
            Feed(-3, 35, None, 500),
            FeedArc(2.33333, 40.33333, None, 5.33333, 0, False, 500),
            Rapid(z=5),
        ),
    )
    return Program(
        "bracket",
        "G54",
        5.0,
        (
            ToolSection(SPOT, 3000, "flood", (spots,)),
            ToolSection(DRILL, 2400, "mist", (holes, deep, chips)),
            ToolSection(MILL, 8000, "flood", (bore, slot)),
            ToolSection(MILL, 8000, "off", (contour,)),
        ),
        ("part bracket, aluminium, 6 mm thick", "Ø5 holes (H7)"),
    )


def with_options() -> Program:
    """The same with every option, and offsets as measured."""
    program = every_operation()
    lengths = {1: 81.2, 2: 104.055, 3: 77.0}
    return replace(
        program,
        work_offset="G57",
        sections=tuple(
            replace(s, tool=s.tool.model_copy(update={"length": lengths[s.tool.number]}))
            for s in program.sections
        ),
        machine=Machine(retract_z=-2, change_x=10, change_y=-200.5, home_x=0, home_y=0, spindle_delay=1.5),
        posting=Posting(
            program_number=27,
            line_numbers=5,
            restart=True,
            optional_stops=True,
            cycles=False,
            exact_stop=True,
            offsets=True,
        ),
        measured=Measured(x=-312.5, y=-201.25, z=-388.012),
    )


def as_taken(program: Program, control: Control) -> Program:
    """The same as far as the control takes it: one that sets no offsets leaves them to the operator."""
    asked = CamSettings.model_validate({"post": {"offsets": True}})
    if not any(finding.code == "cam.offsets" for finding in control.check(asked)):
        return program
    return replace(program, posting=program.posting.model_copy(update={"offsets": False}))


def texts() -> dict[str, str]:
    """File name to text of everything that is kept."""
    kept = {}
    for control in EVERY:
        post = host().get(Control, control)
        kept[f"{control}.nc"] = post.write(every_operation())
        kept[f"{control}-options.nc"] = post.write(as_taken(with_options(), post))
    for stem, text in host().get(Control, "grbl").files(every_operation()).items():
        kept[f"grbl-{stem}.nc"] = text
    return kept


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for name, text in texts().items():
        (FOLDER / name).write_text(text, encoding="ascii")
