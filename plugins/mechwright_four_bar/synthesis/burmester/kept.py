"""Linkages that guide or answer, kept to their limits and made into designs."""

import cmath
import math
from collections import defaultdict
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from mechwright import Array, Candidate, Finding, Rejected, Scalar, Synthesis
from mechwright.contracts.synthesis import ALIKE
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.synthesis.burmester.rectify import Way
from mechwright_four_bar.synthesis.burmester.requirements import LinkLimits
from mechwright_four_bar.synthesis.candidates import Found, buildable, building

WEIGHTS = (30.0, 3000.0)
"""Weights of a broken limit, over that of an error as large as the body's way or as a radian: a fit is led to
its limits, then held."""

MARGIN = 1e-4
"""Share by which a fit keeps inside its limits: a penalty ends a little beyond where it begins."""

MET = 1e-6
"""mm, or degrees, within which positions are met: rounding of exact linkages is far below it."""

DEFECTS = {
    "branch": "the positions lie on both branches: the linkage would have to be taken apart",
    "circuit": "the driver cannot come from one position to the next: they lie in separate circuits",
    "order": "the driver passes the positions in another order",
}


@dataclass(frozen=True)
class Option:
    """A linkage with its merits.

    Parameters
    ----------
    way
        How it goes through the positions.
    error
        By how much it misses them.
    figures
        What to compare it by, besides.
    pivot, point
        A0, mm, and a point of the coupler in the coupler's frame, mm; None for none.
    curve
        Number of the curve that the point draws: linkages that draw one are one design.
    """

    way: Way
    error: Scalar
    figures: dict[str, Scalar]
    pivot: complex = 0j
    point: complex | None = None
    curve: int | None = None

    @property
    def found(self) -> Found:
        """As candidates are made of."""
        bar, phi = self.way.bar, self.way.phi
        figures = {
            "least_transmission_angle": Scalar(self.way.least_angle, "rad"),
            "longest_link": Scalar(max(bar.lengths), "mm"),
            "shortest_link": Scalar(min(bar.lengths), "mm"),
            **self.figures,
            "first_crank_angle": Scalar(float(phi[0] % math.tau), "rad"),
            "crank_turn": Scalar(float(phi[-1] - phi[0]), "rad"),
        }
        sense = 1 if phi[-1] > phi[0] else -1
        start = math.remainder(float(phi[0]), math.tau)
        swing = None if self.way.full else (start, start + float(phi[-1] - phi[0]))
        return Found(bar, self.error, figures, self.pivot, self.point, sense, swing=swing)


def broken(way: Way, wanted: LinkLimits) -> tuple[str, str]:
    """The key of the first limit that a linkage breaks, and by what; empty where it keeps all."""
    bar = way.bar
    if wanted.drive != "any" and way.full != (wanted.drive == "crank"):
        return "drive", "the crank turns fully" if way.full else "the crank cannot turn fully"
    if min(bar.lengths) < wanted.shortest_link:
        return "shortest-link", f"a link is {min(bar.lengths):.6g} mm long"
    if max(bar.lengths) > wanted.longest_link:
        return "longest-link", f"a link is {max(bar.lengths):.6g} mm long"
    angle = math.degrees(way.least_angle)
    if angle < wanted.least_transmission_angle:
        return "transmission", f"the transmission angle falls to {angle:.4g} degrees"
    return "", ""


def driven(way: Way, wanted: LinkLimits) -> Way:
    """The way as it is driven: a crank that could turn fully swings where that alone keeps the limits."""
    if not way.full or wanted.drive == "crank":
        return way
    lever = replace(way, full=False)
    limit = math.radians(wanted.least_transmission_angle)
    needed = way.least_angle < limit <= lever.least_angle
    return lever if needed or wanted.drive == "lever" else way


def _same(one: Option, other: Option) -> bool:
    """Whether nobody would choose between two linkages: links and pivots agree to a share of the links."""
    bars = one.way.bar, other.way.bar
    size = ALIKE * min(bars[0].lengths)
    near = zip(bars[0].lengths, bars[1].lengths, strict=True)
    ends = [
        each.pivot + cmath.rect(bar.ground, bar.ground_angle)
        for each, bar in zip((one, other), bars, strict=True)
    ]
    return (
        bars[0].branch == bars[1].branch
        and all(abs(a - b) < size for a, b in near)
        and abs(one.pivot - other.pivot) < size
        and abs(ends[0] - ends[1]) < size
    )


def missing(error: Scalar) -> str:
    """By how much a linkage misses its positions, in a sentence.

    >>> missing(Scalar(0.25, "mm")), missing(Scalar(1e-12, "rad"))
    (' misses them by 0.25 mm and', ' that goes through them')
    """
    told = _in_degrees(error)
    return (
        f" misses them by {told.value:.3g} {told.unit} and" if told.value > MET else " that goes through them"
    )


def _miss(one: Candidate[FourBarParams]) -> float:
    return _in_degrees(one.residual).value


def _in_degrees(error: Scalar) -> Scalar:
    return Scalar(math.degrees(error.value), "degrees") if error.unit == "rad" else error


def _best_built(cognates: list[Option]) -> Option:
    return min(cognates, key=lambda one: building(one.found)) if len(cognates) > 1 else cognates[0]


def penalties(bar: FourBar, angles: Array, wanted: LinkLimits, weight: float) -> list[float]:
    """How far a linkage is beyond its limits at crank angles (n,) from X, weighted, for a fit."""
    short = [math.log(wanted.shortest_link * (1 + MARGIN) / length) for length in bar.lengths]
    long = [math.log(length / (wanted.longest_link * (1 - MARGIN))) for length in bar.lengths]
    limit = math.cos(math.radians(wanted.least_transmission_angle) * (1 + MARGIN))
    if wanted.drive == "crank":
        cosines = list(bar.transmission_cosines())
    else:
        # Where the crank passes the ground line on its way the angle is least or greatest.
        turned = angles - bar.ground_angle
        low, high = float(turned.min()) / math.pi, float(turned.max()) / math.pi
        through = [k * math.pi for k in range(math.ceil(low), math.floor(high) + 1)]
        squares = abs(bar.ground - bar.crank) ** 2 + 2 * bar.ground * bar.crank * (
            1 - np.cos([*turned, *through])
        )
        cosines = [float(bar.cosine_over(float(square))) for square in squares]
    over = [max(abs(cosine) for cosine in cosines) - limit]
    return [weight * max(0.0, value) for value in (*short, *long, *over)]


def instead(
    name: str, exact: Synthesis[FourBarParams], near: Synthesis[FourBarParams]
) -> Synthesis[FourBarParams]:
    """Designs that come near, and why none is exact; where there are none either, what both searches say."""
    why = exact.findings[0]
    if not near.candidates:
        said = f"{why.message}; {near.findings[0].message}"
        return Synthesis((), (replace(why, message=said),), exact.rejected)
    note = Finding.warning(f"{name}.nearest", why.parameter, f"{why.message}; these are the nearest")
    told = [] if min(map(_miss, near.candidates)) <= MET else [note]
    rejected = Rejected(exact.rejected)
    for reason in near.rejected:
        rejected.because(reason.code, reason.message, reason.count)
    return Synthesis(near.candidates, (*told, *near.findings), rejected.reasons)


def designs(
    name: str,
    options: Iterable[Option],
    defects: dict[str, int],
    wanted: LinkLimits,
    said: Callable[[], str],
    progress: Callable[[float], None],
) -> Synthesis[FourBarParams]:
    """The options that keep the limits and can be built, in their order; else why there is none.

    Of those that draw one curve the one that builds best stands in the place of the first.

    Parameters
    ----------
    name
        Of the kind, which begins its findings' codes.
    options
        Linkages without a defect, best first.
    defects
        How many linkages have which defect.
    said
        What is known of the number of linkages.
    progress
        Told the part that is done, 0 to 1.
    """
    rejected = Rejected()
    for defect, count in defects.items():
        rejected.because(f"{name}.{defect}", DEFECTS[defect], count)
    good: list[Option] = []
    cognates: defaultdict[int, list[Option]] = defaultdict(list)
    nearest = ""
    for each in options:
        one = replace(each, way=driven(each.way, wanted))
        key, why = broken(one.way, wanted)
        if key:
            rejected.because(f"{name}.{key}", why)
            nearest = nearest or f"; the first{missing(one.error)} breaks a limit: {why}"
        elif any(_same(one, other) for other in good):
            rejected.same()
        else:
            if one.curve is not None:
                cognates[one.curve].append(one)
                if len(cognates[one.curve]) > 1:
                    rejected.cognate()
                    continue
            good.append(one)
    chosen = [one if one.curve is None else _best_built(cognates[one.curve]) for one in good]
    candidates, reason = buildable(
        ((one.found,) for one in chosen), wanted.designs, rejected, progress, len(chosen)
    )
    if candidates:
        return Synthesis(tuple(candidates), (Finding.note(f"{name}.found", said()),), rejected.reasons)
    why = f"; none of those within the limits can be built: {reason}" if good else nearest
    return Synthesis(
        (),
        (
            Finding.error(
                f"{name}.none", "crank", f"{said()}{why}",
                remedy="widen the limits, move a position, or ask for fewer",
            ),
        ),
        rejected.reasons,
    )  # fmt: skip
