"""The toothed outside of a gear as a loop of Bézier segments."""

import math
from collections.abc import Callable

import numpy as np

from mechwright.arrays import Array
from mechwright.geometry.fit import fit_nets
from mechwright.geometry.outline import Loop
from mechwright.geometry.segments import BSpline, Point, Segment
from mechwright.mechanics.gearing.candidates import Ints
from mechwright.mechanics.gearing.rack import SIDES
from mechwright.mechanics.gearing.teeth import FIT, Teeth
from mechwright.tolerances import TOLERANCES

_NEAR = 0.01
"""Share of a curve at each end within which a jump of its curvature does not matter: some nanometres."""

Chain = list[list[Array]]
"""Per curve its Bézier nets (degree + 1, 2), mm, in order."""

CurvesOf = Callable[[Ints, Array], Array]


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
    tips, at_tips = offsets(teeth, *teeth.tip_lands, teeth.rack.addendum)
    down, up, at_flanks = flanks(teeth)
    fall, rise, at_fillets = fillets(teeth)
    fallen, risen = teeth.curve.parameter(teeth.arc_centres).T
    roots, at_roots = offsets(teeth, fallen, risen, -teeth.rack.dedendum)
    share(tips, [up[j - 1][-1][-1] for j in range(teeth.count)], [one[0][0] for one in down])
    share(fall, [one[-1][-1] for one in down], None)
    share(rise, None, [one[0][0] for one in up])
    fallen, risen = np.array([one[-1][-1] for one in fall]), np.array([one[0][0] for one in rise])
    if np.linalg.norm(risen - fallen, axis=1).min() > TOLERANCES.closure:
        share(roots, list(fallen), list(risen))
    else:
        # A rack with a full radius leaves no land.
        roots = [[] for _ in roots]
        share(rise, list(fallen), None)
    chains = [
        (tips, "tip"),
        (down, "flank"),
        (fall, "fillet"),
        (roots, "root"),
        (rise, "fillet"),
        (up, "flank"),
    ]
    segments: list[Segment] = [
        BSpline.bezier(net, tag) for j in range(teeth.count) for chain, tag in chains for net in chain[j]
    ]
    return Loop(tuple(segments)), max(at_tips, at_flanks, at_fillets, at_roots)


def share(chain: Chain, starts: list[Array] | None, ends: list[Array] | None) -> None:
    """Give curves their neighbours' end points, bit for bit; they agree to rounding already."""
    for j, nets in enumerate(chain):
        if starts is not None:
            nets[0][0] = starts[j]
        if ends is not None:
            nets[-1][-1] = ends[j]


def _fitted(
    curves: CurvesOf, first: Array, last: Array, breaks: Array, period: float, fit: float = FIT
) -> tuple[Chain, float]:
    """Fit curves from parameters (n,) to (n,), each in pieces between the breaks (m,) that lie within it.

    ``curves(rows, s)`` gives points (k, l, 2), mm, of curves ``rows`` (k,) at parameters s (k, l). A fit
    across a jump of the curvature would ripple.
    """
    rows, starts, ends = _divided(first, last, breaks, period)

    def points(t: Array) -> Array:
        return curves(rows, _between(starts, ends, t))

    nets, error = fit_nets(points, rows.size, fit)
    chain: Chain = [[] for _ in range(first.size)]
    for place, row in enumerate(rows):
        own = [net[place] for net in nets]
        if chain[row]:
            own[0][0] = chain[row][-1][-1]
        chain[row] += own
    return chain, error


def _divided(first: Array, last: Array, breaks: Array, period: float) -> tuple[Ints, Array, Array]:
    """Rows (k,) and both ends (k,) of what intervals from (n,) to (n,), either way, are cut into."""
    if not breaks.size:
        return np.arange(first.size), first, last
    low, high = np.minimum(first, last), np.maximum(first, last)
    ahead = low[:, None] + np.mod(breaks - low[:, None], period) if math.isfinite(period) else breaks
    margin = (_NEAR * (high - low))[:, None]
    row, which = np.nonzero((ahead > low[:, None] + margin) & (ahead < high[:, None] - margin))
    rows = np.concatenate((np.arange(first.size), row))
    starts = np.concatenate((first, ahead[row, which]))
    order = np.lexsort((starts * np.sign(last - first)[rows], rows))
    rows, starts = rows[order], starts[order]
    ends = np.append(starts[1:], 0.0)
    final = np.append(rows[1:] != rows[:-1], True)
    ends[final] = last
    return rows, starts, ends


def _between(first: Array, last: Array, t: Array) -> Array:
    """(n,) to (n,) at t (m,): (n, m), both ends exact."""
    values: Array = (1 - t) * first[:, None] + t * last[:, None]
    return values


def offsets(teeth: Teeth, first: Array, last: Array, height: float) -> tuple[Chain, float]:
    """Tips or roots from parameters (z,) to parameters (z,), at a height, mm, over the pitch curve."""

    def curves(rows: Ints, s: Array) -> Array:  # noqa: ARG001 - all are alike
        return teeth.curve.frame(s).offset(height)

    return _fitted(curves, first, last, teeth.curve.breaks, math.tau)


def flanks(teeth: Teeth) -> tuple[Chain, Chain, float]:
    """Flanks of side -1 from tip to fillet, those of side +1 from fillet to tip."""
    tip, join = teeth.tip_trim[0], teeth.curve.parameter(teeth.join_arcs)
    first = np.concatenate((tip[:, 0], join[:, 1]))
    last = np.concatenate((join[:, 0], tip[:, 1]))
    start = np.concatenate((teeth.flank_arcs[:, 0], teeth.flank_arcs[:, 1]))[:, None]
    side = np.repeat(SIDES, teeth.count)[:, None]

    def curves(rows: Ints, s: Array) -> Array:
        return teeth.rack.flank(teeth.curve.frame(s), start[rows], side[rows])

    chain, error = _fitted(curves, first, last, teeth.curve.breaks, math.tau, teeth.fit)
    return chain[: teeth.count], chain[teeth.count :], error


def fillets(teeth: Teeth) -> tuple[Chain, Chain, float]:
    """Fillets of side -1 from flank to root, those of side +1 from root to flank."""
    scale, reach = teeth.rack.fillet_course
    centre = np.concatenate((teeth.arc_centres[:, 0], teeth.arc_centres[:, 1]))
    side = np.repeat(SIDES, teeth.count)
    # Over τ, with the arc x - σ c sinh τ; a break is a τ of its own of every fillet.
    curve = teeth.curve
    at = curve.arc(curve.breaks)
    away = (centre[:, None] - at) % curve.perimeter
    away -= np.where(away > curve.perimeter / 2, curve.perimeter, 0.0)
    tau = np.arcsinh(side[:, None] * away / scale)

    def curves(rows: Ints, s: Array) -> Array:
        x = centre[rows][:, None]
        return teeth.rack.fillet(curve.frame_at(x - (side * scale)[rows][:, None] * np.sinh(s)), x)

    begin, end = np.where(side < 0, reach, 0.0), np.where(side < 0, 0.0, reach)
    chain, error = _fitted(curves, begin, end, tau, math.inf)
    return chain[: teeth.count], chain[teeth.count :], error


def tip_sites(loop: Loop) -> tuple[tuple[Point, float], ...]:
    """Where tabs may hold a gear: the middle of every tip, and its chord, mm, as the limit."""
    sites = []
    for segment in loop.segments:
        if segment.tag == "tip":
            x, y = segment.at(0.5)[0].tolist()
            width = float(np.hypot(segment.end[0] - segment.start[0], segment.end[1] - segment.start[1]))
            sites.append(((x, y), width))
    return tuple(sites)
