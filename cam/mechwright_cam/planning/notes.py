"""What a program says at its head, and at its stops."""

from collections.abc import Sequence

from mechwright.contracts.part import Bore
from mechwright_cam.operations.drilling import point_length
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import Lengths
from mechwright_cam.shop.tool import REAMER_LEAD, Tool
from mechwright_plane.nest import Nest


def lengths_of(job: Job) -> Lengths:
    """How lengths are written for the shop of a job."""
    return Lengths(job.settings.post.units or "mm")


def clamp_message(job: Job) -> str:
    """What to do at the stop before the outside is cut."""
    clamp, to = job.clamp, lengths_of(job)
    assert clamp is not None  # noqa: S101 - asked only where there is one
    return (
        f"clamp the part at X{to.fixed(clamp.centre[0], 3)} Y{to.fixed(clamp.centre[1], 3)}: up to "
        f"{to.with_unit(clamp.diameter)} wide and {to.with_unit(clamp.top)} high"
    )


def notes(
    job: Job,
    drills: Sequence[Tool],
    round_mills: Sequence[Tool] = (),
    *,
    reamers: bool = False,
    tapped: float = 0.0,
) -> tuple[str, ...]:
    """Part, stock, origin, fits, and what ``drills`` and round mills that cut through ask of the table.

    Taps go so far, mm, below the plate.
    """
    x0, y0, x1, y1 = job.stock
    to = lengths_of(job)
    nest = job.part if isinstance(job.part, Nest) else None
    where = {
        "axis": f"axis of {nest.placed[0].label}" if nest else "axis of the part",
        "corner": "lower left corner of the stock",
        "centre": "centre of the stock",
    }
    lines = [
        f"{'nest' if nest else 'part'} {job.part.name}, {job.part.material}, "
        f"{to.with_unit(job.thickness)} thick",
        f"stock {to.fixed(x1 - x0)} x {to.fixed(y1 - y0)} x {to.with_unit(job.thickness)}, "
        f"from X{to.fixed(x0, 3)} Y{to.fixed(y0, 3)}",
        f"origin: {where[job.settings.origin]}, Z0 on top of the stock",
    ]
    if job.side == "underside":
        lines.append(f"the underside: the plate is turned over about {job.settings.second_side.flip.upper()}")
    lines += [
        f"{f.name}: Ø{f.fit.text}{' mm' if to.units == 'inch' else ''}, made to {to.plain(f.diameter)}"
        for f in job.features
        if isinstance(f, Bore) and f.fit
    ]
    lines += [
        f"{f.name}: {f.depth_text.replace('±', '+-')}{' mm' if to.units == 'inch' else ''} deep"
        for f in job.features
        if isinstance(f, Bore) and f.depth_limits is not None
    ]
    if job.jaws:
        low, _, high, _ = job.jaws[0].face.bounds
        axis = "X"
        if low == high:
            axis, (_, low, _, high) = "Y", job.jaws[0].face.bounds
        lines.append(
            f"vice: {job.jaws[0].edge} and {job.jaws[1].edge} edges, jaws {axis}{to.fixed(low)} to "
            f"{axis}{to.fixed(high)}, top Z{to.plain(job.jaws[0].top)}"
        )
    if drills:
        below = max(point_length(drill) for drill in drills) + job.settings.breakthrough
        lines.append(f"drills go {to.fixed(below)} {to.unit} below the stock: leave room under the holes")
    if reamers:
        below = REAMER_LEAD + job.settings.breakthrough
        lines.append(f"reamers go {to.fixed(below)} {to.unit} below the stock: leave room under the holes")
    if tapped > 0:
        lines.append(f"taps go {to.fixed(tapped)} {to.unit} below the stock: leave room under the holes")
    if round_mills:
        below = max(mill.nose for mill in round_mills) + job.settings.breakthrough
        lines.append(f"round mills go {to.fixed(below)} {to.unit} below the stock: leave room under the cuts")
    return tuple(lines)
