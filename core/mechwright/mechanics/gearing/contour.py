"""The toothed outside of a gear as a loop of Bézier segments."""

import numpy as np

from mechwright.arrays import Array
from mechwright.geometry.fit import fit_nets
from mechwright.geometry.outline import Loop
from mechwright.geometry.segments import BSpline, Point, Segment
from mechwright.mechanics.gearing.rack import SIDES
from mechwright.mechanics.gearing.teeth import Teeth
from mechwright.tolerances import TOLERANCES

FIT = 0.0001
"""Deviation of the outline from the exact curves, mm: a tenth of what an outline may have, for one degree
more. Errors of a flank turn the driven gear; this one turns it by a few microradians."""


def gear_loop(teeth: Teeth) -> tuple[Loop, float]:
    """Fit the outside of the gear.

    Returns
    -------
    loop
        Counter-clockwise from the first end of tooth 0: per tooth its tip, the flank, fillet, root, fillet
        and flank of the space behind it, tagged ``"tip"``, ``"flank"``, ``"fillet"``, ``"root"``. Body frame.
    deviation
        Measured distance from the exact curves, mm.

    Raises
    ------
    GeometryError
        The curves do not meet, or are not smooth.
    """
    tips, at_tips = _offsets(teeth, *teeth.tip_lands, teeth.rack.addendum)
    down, up, at_flanks = _flanks(teeth)
    fall, rise, at_fillets = _fillets(teeth)
    fallen, risen = teeth.curve.parameter(teeth.arc_centres).T
    roots, at_roots = _offsets(teeth, fallen, risen, -teeth.rack.dedendum)
    _share(tips, np.roll(up[-1][:, -1], 1, axis=0), down[0][:, 0])
    _share(fall, down[-1][:, -1], None)
    _share(rise, None, up[0][:, 0])
    width = np.linalg.norm(rise[0][:, 0] - fall[-1][:, -1], axis=1)
    if width.min() > TOLERANCES.closure:
        _share(roots, fall[-1][:, -1], rise[0][:, 0])
    else:
        # A rack with a full radius leaves no land.
        roots = []
        _share(rise, fall[-1][:, -1], None)
    chains = [
        (tips, "tip"),
        (down, "flank"),
        (fall, "fillet"),
        (roots, "root"),
        (rise, "fillet"),
        (up, "flank"),
    ]
    segments: list[Segment] = [
        BSpline.bezier(piece[j], tag)
        for j in range(teeth.count)
        for pieces, tag in chains
        for piece in pieces
    ]
    return Loop(tuple(segments)), max(at_tips, at_flanks, at_fillets, at_roots)


def _share(pieces: list[Array], start: Array | None, end: Array | None) -> None:
    """Give a chain its neighbours' end points, bit for bit; they agree to rounding already."""
    if start is not None:
        pieces[0][:, 0] = start
    if end is not None:
        pieces[-1][:, -1] = end


def _between(first: Array, last: Array, t: Array) -> Array:
    """(n,) to (n,) at t (m,): (n, m), both ends exact."""
    values: Array = (1 - t) * first[:, None] + t * last[:, None]
    return values


def _offsets(teeth: Teeth, first: Array, last: Array, height: float) -> tuple[list[Array], float]:
    """Tips or roots from parameters (z,) to parameters (z,), at a height, mm, over the pitch curve."""

    def curves(t: Array) -> Array:
        return teeth.curve.frame(_between(first, last, t)).offset(height)

    return fit_nets(curves, teeth.count, FIT)


def _flanks(teeth: Teeth) -> tuple[list[Array], list[Array], float]:
    """Flanks of side -1 from tip to fillet, those of side +1 from fillet to tip."""
    tip, join = teeth.tip_trim[0], teeth.curve.parameter(teeth.join_arcs)
    first = np.concatenate((tip[:, 0], join[:, 1]))
    last = np.concatenate((join[:, 0], tip[:, 1]))
    start = np.concatenate((teeth.flank_arcs[:, 0], teeth.flank_arcs[:, 1]))[:, None]
    side = np.repeat(SIDES, teeth.count)[:, None]

    def curves(t: Array) -> Array:
        return teeth.rack.flank(teeth.curve.frame(_between(first, last, t)), start, side)

    nets, error = fit_nets(curves, 2 * teeth.count, FIT)
    z = teeth.count
    return [net[:z] for net in nets], [net[z:] for net in nets], error


def _fillets(teeth: Teeth) -> tuple[list[Array], list[Array], float]:
    """Fillets of side -1 from flank to root, those of side +1 from root to flank."""
    scale, reach = teeth.rack.fillet_course
    centre = np.concatenate((teeth.arc_centres[:, 0], teeth.arc_centres[:, 1]))[:, None]
    side = np.repeat(SIDES, teeth.count)[:, None]
    z = teeth.count

    def curves(t: Array) -> Array:
        tau = reach * np.where(side < 0, 1 - t, t)
        frame = teeth.curve.frame_at(centre - side * scale * np.sinh(tau))
        return teeth.rack.fillet(frame, centre)

    nets, error = fit_nets(curves, 2 * z, FIT)
    return [net[:z] for net in nets], [net[z:] for net in nets], error


def tip_sites(loop: Loop) -> tuple[tuple[Point, float], ...]:
    """Where tabs may hold a gear: the middle of every tip, and its chord, mm, as the limit."""
    sites = []
    for segment in loop.segments:
        if segment.tag == "tip":
            x, y = segment.at(0.5)[0].tolist()
            width = float(np.hypot(segment.end[0] - segment.start[0], segment.end[1] - segment.start[1]))
            sites.append(((x, y), width))
    return tuple(sites)
