"""Crank-rockers whose follower swings by a given angle, with a given time ratio.

Notation, with the follower b as unit and its pivot B0 in the origin, its arm at ±ψ/2 in the limit positions:

    K = (180 + α)/(180 - α)              crank angle α between the limit positions, over half a turn
    s = 2 sin(ψ/2)                       chord from B1 (extended) to B2 (folded)
    |A0 B1| = c + a,  |A0 B2| = c - a    crank and coupler in one line
    s² = (c + a)² + (c - a)² - 2 (c + a)(c - a) cos α

From |A0 B2|, 0 to s/(2 sin(α/2)), one linkage follows on either side of the chord; with K = 1 the two are
one, and A0 lies on the chord's line. Nothing else is left to choose but the size. The transmission angle is
least with the crank in the ground line, or against it.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mechwright import Array, Finding, Progress, Rejected, Scalar, Synthesis
from mechwright.contracts.synthesis import ALIKE
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.requirements import SwingRequirement
from mechwright_four_bar.synthesis.candidates import Found, buildable

GRID, ROUNDS = 2000, 6
"""Linkages of a side that are compared at once, and how often about the best: its place to 1e-15."""

NEAREST, FARTHEST = 1e-3, 1e3
"""Distances of A0 from B2, in chords, between which it is sought."""

GOOD = math.radians(50)
"""Transmission angle from which a larger one is not worth longer links."""

NEARLY = math.radians(3)
"""By how much less a transmission angle is nearly the best, for which links may be much shorter."""

INSIDE = 1e-9
"""Share by which links are kept inside their limits, for the digits of a design."""


@dataclass(frozen=True)
class Rockers:
    """Crank-rockers (n,) with the wanted swing and time ratio on one side, lengths in mm.

    Parameters
    ----------
    lengths
        (4, n): crank, coupler, follower, ground.
    ground
        (n,) direction from A0 to B0, rad from the middle of the swing.
    branch
        (n,) +1 or -1.
    least_angle
        (n,) transmission angle, rad; NaN where there is no such linkage.
    """

    lengths: Array
    ground: Array
    branch: Array
    least_angle: Array

    @property
    def longest(self) -> Array:
        """(n,) mm."""
        return np.asarray(self.lengths.max(axis=0))

    def taken(self, k: int) -> "Rockers":
        """One of them, (1,)."""
        one = slice(k, k + 1)
        return Rockers(self.lengths[:, one], self.ground[one], self.branch[one], self.least_angle[one])

    def bar(self, k: int, middle: float, mirrored: bool) -> FourBar:
        """A linkage, or its mirror image, with the middle of the swing in this direction, rad."""
        a, c, b, f = self.lengths[:, k].tolist()
        sign = -1 if mirrored else 1
        return FourBar(a, c, b, f, middle + sign * float(self.ground[k]), sign * int(self.branch[k]))


def rockers(wanted: SwingRequirement, side: int, near: Array) -> Rockers:
    """Those with A0 at distances ``near`` (n,) from B2, in chords, left (+1) or right of the way B1 to B2."""
    swing = math.radians(wanted.swing)
    alpha = _between(wanted)
    chord = 2 * math.sin(swing / 2)
    with np.errstate(invalid="ignore", divide="ignore"):
        two = near * chord
        one = two * math.cos(alpha) + np.sqrt(chord**2 - (two * math.sin(alpha)) ** 2)
        a, c = (one - two) / 2, (one + two) / 2
        # A0 from B1: along the way to B2, and across it.
        along = (one**2 - two**2 + chord**2) / (2 * chord)
        across = side * one * two * math.sin(alpha) / chord
        b1 = np.exp(0.5j * swing)
        a0 = b1 + (along + 1j * across) * -1j
        f = np.abs(a0)
        lengths = np.stack([a, c, np.ones_like(a), f])
        lengths *= size_of(wanted, lengths)
        bars = FourBar(*lengths)
        cosines = np.abs(bars.transmission_cosines())
        turns = [(np.conj(-a0) * (b - a0)).imag for b in (b1, np.conj(b1))]
        sound = (a > 0) & (a < np.minimum(np.minimum(c, f), 1)) & (bars.crank_room > 0)
        sound &= turns[0] * turns[1] > 0  # both limits on one branch
        angle = np.where(sound, np.arccos(np.minimum(cosines.max(axis=0), 1)), np.nan)
    return Rockers(lengths, np.angle(-a0), np.sign(turns[0]), angle)


def size_of(wanted: SwingRequirement, lengths: Array) -> Array:
    """(n,) mm per unit, so that the link that is given has its length."""
    for name, one in zip(("crank", "coupler", "follower", "ground"), lengths, strict=True):
        length = getattr(wanted, name)
        if length is not None:
            return np.asarray(length / one)
    raise AssertionError("a requirement gives one length")


def swinging(wanted: SwingRequirement, progress: Progress) -> Synthesis[FourBarParams]:
    """Crank-rockers with the swing and time ratio.

    Each stands for its mirror image as well, with A0 on the other side, which is given where it alone can be
    built.

    First the smallest whose transmission angle is good, or nearly the best; then that with the best; then the
    smallest that keeps the angle that is asked for.
    """
    limit = math.radians(wanted.least_transmission_angle)
    best = {side: one for side in (1, -1) if (one := widest(wanted, side)) is not None}
    most = max((float(one.least_angle[0]) for one in best.values()), default=math.nan)
    if not most >= limit:
        return Synthesis((), (_refusal(wanted, math.degrees(most)),))
    good = max(limit, min(GOOD, most - NEARLY))
    chosen: list[Rockers] = []
    for group in (
        [smallest(wanted, side, good) for side in best],
        [one for one in best.values() if limit <= float(one.least_angle[0])],
        [smallest(wanted, side, limit) for side in best],
    ):
        chosen += sorted((one for one in group if one is not None), key=lambda one: float(one.longest[0]))
    rejected = Rejected()
    middle = math.radians(wanted.middle_angle)
    found = [
        [_found(one.bar(0, middle, mirrored), wanted) for mirrored in (False, True)]
        for one in _distinct(chosen, rejected)
    ]
    candidates, reason = buildable(
        found, wanted.designs, rejected, lambda part: progress(part, "designs"), len(found)
    )
    if candidates:
        return Synthesis(tuple(candidates), (_mirrored(candidates[0].params, wanted),), rejected.reasons)
    fault = Finding.error(
        "swing.unbuildable",
        "crank",
        f"linkages have this swing and time ratio within the limits, but cannot be built: {reason}",
        remedy="give another length, or a smaller least_transmission_angle",
    )
    return Synthesis((), (fault,), rejected.reasons)


def widest(wanted: SwingRequirement, side: int) -> Rockers | None:
    """The linkage of a side with the best transmission angle within the limits of its links; (1,) or None."""
    return _sought(wanted, side, 0.0, lambda one: one.least_angle)


def smallest(wanted: SwingRequirement, side: int, least: float) -> Rockers | None:
    """That whose longest link is shortest, of those with at least this transmission angle, rad."""
    return _sought(wanted, side, least, lambda one: -one.longest)


def _sought(
    wanted: SwingRequirement, side: int, least: float, merit: Callable[[Rockers], Array]
) -> Rockers | None:
    """The best of a side: on a grid, then on finer ones about it, or about what is nearest to the limits."""
    alpha = _between(wanted)
    most = FARTHEST if alpha == 0 else min(FARTHEST, 1 / (2 * math.sin(alpha / 2)))
    near = np.geomspace(NEAREST * most, most, GRID)
    short, long = wanted.shortest_link * (1 + INSIDE), wanted.longest_link * (1 - INSIDE)
    best: Rockers | None = None
    for _ in range(ROUNDS):
        one = rockers(wanted, side, near)
        sound = np.flatnonzero(one.least_angle >= 0)
        if not sound.size:
            break
        over = np.maximum(short / one.lengths[:, sound].min(axis=0), one.longest[sound] / long) - 1
        over = np.maximum(over, least - one.least_angle[sound])
        k = int(sound[over.argmin()])
        if over.min() <= 0:
            kept = sound[over <= 0]
            k = int(kept[merit(one)[kept].argmax()])
            best = one.taken(k)
        near = np.linspace(near[max(k - 1, 0)], near[min(k + 1, GRID - 1)], GRID)
    return best


def _between(wanted: SwingRequirement) -> float:
    """α, rad."""
    return math.pi * (wanted.time_ratio - 1) / (wanted.time_ratio + 1)


def _distinct(chosen: Sequence[Rockers], rejected: Rejected) -> Iterator[Rockers]:
    kept: list[Array] = []
    for one in chosen:
        sizes = np.log(one.lengths[:, 0])
        if any(np.abs(sizes - other).max() < ALIKE for other in kept):
            rejected.same()
        else:
            kept.append(sizes)
            yield one


def _mirrored(params: FourBarParams, wanted: SwingRequirement) -> Finding:
    """How the best design is turned into its mirror image."""
    angle = math.remainder(2 * wanted.middle_angle - params.ground_angle, 360)
    branch = "crossed" if params.branch == "open" else "open"
    said = (
        "mirror images, with the crank's axis on the other side, swing in the same way: the first design's "
        f'has ground_angle = {angle:.6g} and branch = "{branch}", and its crank turns in the same sense'
    )
    return Finding.note("swing.mirror", said, angle, "deg")


def _found(bar: FourBar, wanted: SwingRequirement) -> Found:
    limits = bar.folding()
    figures = {
        "least_transmission_angle": Scalar(bar.least_transmission_angle(), "rad"),
        "longest_link": Scalar(bar.longest, "mm"),
        "swing": Scalar(limits.swing, "rad"),
        "time_ratio": Scalar(limits.time_ratio, ""),
    }
    # At the extended limit, which the crank leaves counter-clockwise for the folded one, B lies to one side.
    far = (bar.crank + bar.coupler) * np.exp(1j * limits.extended) - bar.ground
    near = (bar.crank - bar.coupler) * np.exp(1j * limits.folded) - bar.ground
    rises = (np.conj(far) * near).imag > 0
    quick = rises == ((limits.folded - limits.extended) % math.tau < math.pi)  # counter-clockwise
    sense = 1 if quick == (wanted.quick == "ccw") else -1
    return Found(bar, Scalar(abs(limits.swing - math.radians(wanted.swing)), "rad"), figures, sense=sense)


def _refusal(wanted: SwingRequirement, best: float) -> Finding:
    """Why there is none, and what is nearest."""
    asked = f"a swing of {wanted.swing:g} degrees and a time ratio of {wanted.time_ratio:g}"
    free = wanted.model_copy(update={"longest_link": math.inf, "shortest_link": 0.0})
    angles = [float(one.least_angle[0]) for side in (1, -1) if (one := widest(free, side)) is not None]
    most = math.degrees(max(angles, default=0.0))
    if most < wanted.least_transmission_angle:
        return Finding.error(
            "swing.transmission",
            "least_transmission_angle",
            f"with {asked} no four-bar has a better transmission angle than {most:.4g} degrees",
            most,
            wanted.least_transmission_angle,
            "deg",
            "ask for a smaller swing, a time ratio nearer to 1, or a smaller least_transmission_angle",
        )
    has = "there is no such four-bar" if math.isnan(best) else f"none has more than {best:.4g} degrees"
    return Finding.error(
        "swing.links",
        "longest_link",
        f"four-bars with {asked} have a transmission angle of up to {most:.4g} degrees, but with links of "
        f"{wanted.shortest_link:g} to {wanted.longest_link:g} mm {has}",
        None if math.isnan(best) else best,
        wanted.least_transmission_angle,
        "deg",
        "allow longer or shorter links, give another length, or ask for a smaller least_transmission_angle",
    )
