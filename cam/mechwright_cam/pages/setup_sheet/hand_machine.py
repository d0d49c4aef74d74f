"""What the operator of a small machine does by hand: its zero, its speed, its height, and the dust."""

from collections.abc import Iterator, Mapping, Sequence

from mechwright.contracts.materials import material
from mechwright_cam.pages.setup_sheet.facts import extreme_points
from mechwright_cam.pages.trace import Traced
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import Lengths

Room = tuple[float, float, float, float, float, float]
"""Least x, y, z and greatest x, y, z of the tip of any tool, mm."""


def room_of(traced: Sequence[Traced], clearance: float) -> Room | None:
    """Where the tips of the tools go, with the height of rapids; None without any move."""
    strokes = [stroke for item in traced for stroke in item.strokes]
    if not strokes:
        return None
    places = [
        point for stroke in strokes for point in (stroke.start[:2], stroke.end[:2], *extreme_points(stroke))
    ]
    xs, ys = zip(*places, strict=True)
    return min(xs), min(ys), min(stroke.bottom for stroke in strokes), max(xs), max(ys), clearance


def by_hand_lines(job: Job, room: Room | None, speeds: Mapping[int, float], to: Lengths) -> Iterator[str]:
    """Sentences for the sheet, those alone that the machine asks for.

    Parameters
    ----------
    job
        The job.
    room
        Where the tips of the tools go.
    speeds
        T number to the speed of the spindle, rev/min.
    to
        Units of the sheet.
    """
    machine = job.settings.machine
    if machine.homing == "marks":
        yield (
            "Home the machine at its marks: jog X, Y and Z to the marks at the upper ends of their travels, "
            "and set machine zero there."
        )
    if not machine.homed and room is not None:
        x0, y0, z0, x1, y1, z1 = room
        yield (
            f"The moves need room around the zero: X {to.fixed(max(-x0, 0.0), 1)} to the left and "
            f"{to.fixed(max(x1, 0.0), 1)} to the right, Y {to.fixed(max(-y0, 0.0), 1)} to the front and "
            f"{to.fixed(max(y1, 0.0), 1)} to the rear, Z {to.fixed(max(z1, 0.0), 1)} up and "
            f"{to.fixed(max(-z0, 0.0), 1)} {to.unit} down. Jog there before the start: nothing else stops "
            "an axis."
        )
        yield (
            f"Before each start the tool stands above the stock and its clamps: the first move goes to "
            f"Z {to.signed(z1)}."
        )
    if machine.nose_to_table is None and machine.rigidity in {"A", "B"}:
        yield (
            "Whether the tools reach is not known, as nose_to_table of the machine is not given: raise Z "
            "fully, and measure from the table to the nose of the spindle."
        )
    if machine.speed_by_hand:
        for number, speed in speeds.items():
            mark = f"mark {machine.dial.index(speed) + 1}, " if speed in machine.dial else ""
            yield f"T{number}: set the dial to {mark}{speed:g} rev/min before the start."
    if advice := material(job.part.material).advice:
        yield advice
