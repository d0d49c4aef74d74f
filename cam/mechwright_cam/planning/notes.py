"""What a program says at its head, and at its stops."""

from collections.abc import Sequence

from mechwright.contracts.part import Bore
from mechwright_cam.operations.drilling import point_length
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.nest import Nest
from mechwright_cam.shop.tool import Tool


def clamp_message(job: Job) -> str:
    """What to do at the stop before the outside is cut."""
    clamp = job.clamp
    assert clamp is not None  # noqa: S101 - asked only where there is one
    return (
        f"clamp the part at X{clamp.centre[0]:.3f} Y{clamp.centre[1]:.3f}: up to {clamp.diameter:g} mm "
        f"wide and {clamp.top:g} mm high"
    )


def notes(job: Job, drills: Sequence[Tool], round_mills: Sequence[Tool] = ()) -> tuple[str, ...]:
    """Part, stock, origin, fits, and what ``drills`` and round mills that cut through ask of the table."""
    x0, y0, x1, y1 = job.stock
    nest = job.part if isinstance(job.part, Nest) else None
    where = {
        "axis": f"axis of {nest.placed[0].label}" if nest else "axis of the part",
        "corner": "lower left corner of the stock",
        "centre": "centre of the stock",
    }
    lines = [
        f"{'nest' if nest else 'part'} {job.part.name}, {job.part.material}, {job.thickness:g} mm thick",
        f"stock {x1 - x0:.2f} x {y1 - y0:.2f} x {job.thickness:g} mm, from X{x0:.3f} Y{y0:.3f}",
        f"origin: {where[job.settings.origin]}, Z0 on top of the stock",
    ]
    if job.side == "underside":
        lines.append(f"the underside: the plate is turned over about {job.settings.second_side.flip.upper()}")
    lines += [
        f"{f.name}: Ø{f.fit.text}, made to {f.diameter:g}"
        for f in job.features
        if isinstance(f, Bore) and f.fit
    ]
    if job.jaws:
        low, _, high, _ = job.jaws[0].face.bounds
        axis = "X"
        if low == high:
            axis, (_, low, _, high) = "Y", job.jaws[0].face.bounds
        lines.append(
            f"vice: {job.jaws[0].edge} and {job.jaws[1].edge} edges, jaws {axis}{low:.2f} to "
            f"{axis}{high:.2f}, top Z{job.jaws[0].top:g}"
        )
    if drills:
        below = max(point_length(drill) for drill in drills) + job.settings.breakthrough
        lines.append(f"drills go {below:.2f} mm below the stock: leave room under the holes")
    if round_mills:
        below = max(mill.nose for mill in round_mills) + job.settings.breakthrough
        lines.append(f"round mills go {below:.2f} mm below the stock: leave room under the cuts")
    return tuple(lines)
