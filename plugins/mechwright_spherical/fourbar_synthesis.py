"""Path synthesis of a spherical four-bar: an atlas of random linkages, then least squares.

The size and the place of a path on the sphere cannot be taken out as in the plane, but its orientation can:
every linkage of the atlas is turned to lie on the path as well as it can (Kabsch), and the best are fitted.
Unknowns are the four arcs, the path point in the coupler, the orientation in space, and the input angle of
every point, or of the first one only where the timing is prescribed.
"""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from mechwright import Array, Candidate, Finding, GeometryError, Progress, Rejected, Scalar, Synthesis
from mechwright.contracts.finding import errors
from mechwright.mechanics.planar import Turning
from mechwright_spherical import checks
from mechwright_spherical.fit import assembled, fitted
from mechwright_spherical.fourbar import FourBar
from mechwright_spherical.linkage import linkage_of
from mechwright_spherical.mobility import mobility
from mechwright_spherical.params import FourBarTable, SphericalParams
from mechwright_spherical.requirements import FourBarPathRequirement
from mechwright_spherical.vectors import rotate, vector

_USUAL = math.radians(110.0)
"""Longest arcs of the atlas: an arc and its supplement are the same link."""

_INSIDE = 1e-6
"""rad. By how much a start of a fit keeps off the bounds of arcs."""

_CURVE = 72
"""Points of a coupler curve in the atlas: each 5 degrees of the input."""

_SPANS = (0.12, 0.25, 0.4, 0.6, 0.8)
"""Parts of a turn that an open path may take."""

_PRECISION = 1e-14
"""Tolerances of the fit: the last digits that a residual of some 1e-4 has."""

_PINCH = 0.15
"""Weight of a transmission angle below its bound against the path's error: 1 degree there is 2.6e-3 here."""

_EXTREMES = 5
"""Input angles at which the transmission angle can be least: both ends, and whole half turns between them."""

_MARGIN = 1e-7
"""rad. By how much a fit keeps inside the bound of transmission angles, so that rounding never breaks it."""

_OUTER, _PATIENT = 15, 4
"""Most changes of the multipliers that bring the transmission angle to its bound, and how many may not."""

DIGITS = 10
"""Decimals of degrees and directions in design files."""


def from_points(wanted: FourBarPathRequirement, progress: Progress) -> Synthesis[SphericalParams]:
    """Designs whose coupler point follows the points, best first."""
    try:
        targets = np.array([vector(point) for point in wanted.points]).T
    except GeometryError as error:
        return Synthesis((), (_fault("four_bar.path", str(error)),))
    progress(0.0, "atlas")
    problem = _Problem(wanted, targets)
    starts = problem.starts()
    if not starts:
        return Synthesis(
            (), (_fault("four_bar.path", "no linkage of the atlas can be compared with the path"),)
        )
    found: list[Candidate[SphericalParams]] = []
    refused: list[Finding] = []
    rejected = Rejected()
    best = math.inf
    for number, start in enumerate(starts):
        progress((number + 1) / (len(starts) + 1), "fitting")
        params = problem.design(problem.fit(start))
        if params is None:
            rejected.because("spherical.order", "the linkage does not run through the points in their order")
            continue
        best = min(best, _residual(params))
        faults = errors(checks.findings(params))
        refused += faults
        if not rejected.by(faults) and not any(_same(params, one.params) for one in found):
            found.append(_candidate(params))
    progress(1.0, "done")
    if not found:
        why = refused or [
            _fault("four_bar.path_angles", "no fitted linkage runs through the points in their order")
        ]
        return Synthesis((), tuple(dict.fromkeys(why)), rejected.reasons)
    found.sort(key=lambda one: one.residual.value)
    least = math.radians(wanted.least_transmission)
    bounded = [one for one in found if one.figures["transmission_min"].value >= least]
    for one in found:
        if one not in bounded:
            angle = math.degrees(one.figures["transmission_min"].value)
            rejected.because("spherical.transmission", f"the transmission angle falls to {angle:.4g} degrees")
    if not bounded:
        greatest = max(math.degrees(one.figures["transmission_min"].value) for one in found)
        said = (
            f"in {len(starts)} starts no four-bar was found that keeps a transmission angle of "
            f"{wanted.least_transmission:g} degrees: the best of them has {greatest:.4g}"
        )
        return Synthesis((), (_fault("least_transmission", said),), rejected.reasons)
    return Synthesis(tuple(bounded[: wanted.designs]), (), rejected.reasons)


def _fault(parameter: str, message: str) -> Finding:
    return Finding.error(
        "spherical.synthesis",
        parameter,
        message.split(";")[0],
        remedy="ask for a larger atlas, more starts, fewer points, or a lower least_transmission",
    )


@dataclass(frozen=True, slots=True)
class _Start:
    """A linkage that lies on the path roughly: orientation (3, 3), arcs and point (6,), side, angles (n,)."""

    frame: Array
    shape: Array
    side: float
    angles: Array


class _Problem:
    def __init__(self, wanted: FourBarPathRequirement, targets: Array) -> None:
        self._wanted, self._targets = wanted, targets
        self._least, self._greatest = math.radians(wanted.least_arc), math.radians(wanted.greatest_arc)
        self._given = np.radians(np.array(wanted.angles, dtype=float)) if wanted.angles else None
        if self._given is not None:
            self._given = self._given - self._given[0]

    # The atlas

    def starts(self) -> list[_Start]:
        """The best of the atlas, turned onto the path; one for each linkage."""
        shapes, sides = self._random()
        count = shapes.shape[1]
        theta = np.arange(_CURVE) * math.tau / _CURVE
        with np.errstate(invalid="ignore"):
            curves = np.moveaxis(
                _linkage(shapes, sides).loop().position(np.broadcast_to(theta, (count, _CURVE))), 0, -1
            )
        good = np.isfinite(curves).all(axis=(1, 2))
        shapes, sides, curves = shapes[:, good], sides[good], curves[good]
        best = np.full(len(curves), np.inf)
        frames = np.zeros((len(curves), 3, 3))
        angles = np.zeros((len(curves), self._targets.shape[1]))
        for places in self._places(curves):
            at = np.take_along_axis(curves, places[..., None], axis=1)
            frame, error = _kabsch(at, self._targets.T)
            better = error < best
            best = np.where(better, error, best)
            frames[better] = frame[better]
            angles[better] = np.unwrap(theta[places[better]], axis=1)
        order = np.argsort(best, kind="stable")[: self._wanted.starts]
        return [_Start(frames[i], shapes[:, i], float(sides[i]), angles[i]) for i in order.tolist()]

    def _random(self) -> tuple[Array, Array]:
        """Shapes (6, m) and sides (m,) of random linkages whose input turns all the way round."""
        generator = np.random.default_rng(self._wanted.seed)
        found, sides, count = [], [], 0
        while count < self._wanted.atlas:
            arcs = generator.uniform(self._least, min(self._greatest, _USUAL), (4, 4 * self._wanted.atlas))
            arcs = arcs[:, mobility(*arcs).input_full]
            size = arcs.shape[1]
            point = np.stack([generator.uniform(-1.5, 2.5, size), generator.uniform(-1.0, 1.0, size)])
            found.append(np.concatenate([arcs, point]))
            sides.append(generator.choice([-1.0, 1.0], size))
            count += size
        return np.concatenate(found, axis=1)[:, : self._wanted.atlas], np.concatenate(sides)[
            : self._wanted.atlas
        ]

    def _places(self, curves: Array) -> "list[np.typing.NDArray[np.int64]]":
        """Indices (m, n) of the curves' points that may belong to the path's, in several ways."""
        n = self._targets.shape[1]
        step = 2 if self._given is None else 1
        if self._given is not None:
            steps = self._given / math.tau * _CURVE
            return [
                np.broadcast_to(np.round(first + sense * steps).astype(np.int64) % _CURVE, (len(curves), n))
                for first in range(0, _CURVE, step)
                for sense in (1, -1)
            ]
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(self._targets, axis=1), axis=0))])
        if self._wanted.closed:
            whole = along[-1] + float(np.linalg.norm(self._targets[:, 0] - self._targets[:, -1]))
            return [
                self._by_length(curves, along / whole, first, 1.0, s)
                for first in range(0, _CURVE, step)
                for s in (1, -1)
            ]
        return [
            self._by_length(curves, along / along[-1], first, span, s)
            for first in range(0, _CURVE, 2 * step)
            for span in _SPANS
            for s in (1, -1)
        ]

    def _by_length(
        self, curves: Array, shares: Array, first: int, span: float, sense: int
    ) -> "np.typing.NDArray[np.int64]":
        """Indices at the same shares of the length, from a point on, over part of a turn, either way."""
        steps = np.arange(round(span * _CURVE) + 1)
        order = (first + sense * steps) % _CURVE
        pieces = np.linalg.norm(np.diff(curves[:, order], axis=1), axis=2)
        length = np.concatenate([np.zeros((len(curves), 1)), np.cumsum(pieces, axis=1)], axis=1)
        length /= length[:, -1:] + 1e-300  # a point that stands still is a bad start, not a fault
        nearest = np.abs(length[:, :, None] - shares[None, None, :]).argmin(axis=1)
        return np.asarray(order[nearest])

    # The fit

    def fit(self, start: _Start) -> _Start:
        """Least squares from a start."""
        timing = start.angles[:1] if self._given is not None else start.angles
        sense = 1.0 if start.angles[-1] >= start.angles[0] else -1.0
        x = np.concatenate([start.shape, np.zeros(3), timing])
        low = np.full(x.size, -np.inf)
        high = np.full(x.size, np.inf)
        low[:4], high[:4] = self._least, self._greatest
        low[5], high[5] = -math.pi / 2, math.pi / 2
        multipliers, before = np.zeros(_EXTREMES), math.inf
        best = x
        for number in range(_OUTER):
            bounded = partial(self._residuals, start=start, sense=sense, multipliers=multipliers)
            best = np.clip(best, low + _INSIDE, high - _INSIDE)
            best = fitted(bounded, best, _PRECISION, 150, bounds=(low, high))
            over = self._pinched(best[:, None], start, sense)[0]
            broken = float(over.max())
            # A start that does not come nearer to the bound has no linkage there that keeps it.
            if not broken > 0 or (number >= _PATIENT and not broken < before):
                break
            multipliers, before = np.maximum(0.0, multipliers + _PINCH * over), broken
        at = best[:, None]
        angles = self._angles(at, sense)[0]
        frame = (_rotation(at[6:9])[:, :, 0]) @ start.frame
        return self._shortest(_Start(frame, best[:6], start.side, angles))

    def _angles(self, x: Array, sense: float) -> Array:
        """Input angles (designs, n)."""
        if self._given is None:
            return x[9:].T
        found: Array = x[9][:, None] + sense * self._given
        return found

    def _pinched(self, x: Array, start: _Start, sense: float) -> Array:
        """By how much the transmission angle is below its bound (designs, extremes), rad; else below 0."""
        loop = _linkage(x[:6], np.full(x.shape[1], start.side)).loop()
        with np.errstate(invalid="ignore", divide="ignore"):
            mu = loop.at(Turning.of(self._extremes(self._angles(x, sense), sense)), 0).transmission
        bound = math.radians(self._wanted.least_transmission) + _MARGIN
        return np.asarray(bound - np.minimum(mu, np.pi - mu))

    def _residuals(self, x: Array, start: _Start, sense: float, multipliers: Array) -> Array:
        """Misses of the points, and of the bound as an augmented Lagrangian has it."""
        linkage = _linkage(x[:6], np.full(x.shape[1], start.side))
        loop = linkage.loop()
        angles = self._angles(x, sense)
        with np.errstate(invalid="ignore", divide="ignore"):
            own = loop.position(angles)
            turn = np.einsum("ijd,jk->ikd", _rotation(x[6:9]), start.frame)
            misses = np.einsum("ikd,kdn->din", turn, own) - self._targets
        pinch = np.maximum(_PINCH * self._pinched(x, start, sense) + multipliers, 0.0)
        whole = np.concatenate([misses.reshape(x.shape[1], -1), pinch], axis=1)
        return assembled(whole)

    def _extremes(self, angles: Array, sense: float) -> Array:
        """Input angles (designs, extremes) at one of which the transmission angle is least.

        It follows the diagonal from c to a, which goes one way between whole half turns of the input.
        """
        first = angles[:, :1]
        last = first + sense * math.tau if self._wanted.closed else angles[:, -1:]
        low, high = np.minimum(first, last), np.maximum(first, last)
        halves = (np.ceil(low / np.pi) + np.arange(_EXTREMES - 2)) * np.pi
        return np.concatenate([low, high, np.clip(halves, low, high)], axis=1)

    def _shortest(self, found: _Start) -> _Start:
        """The same linkage with the shortest arcs within the bounds: an axis may be held at either end.

        With the output axis at its other end, ground and output become their supplements, and x and the
        input angle turn round; with the pin b at its other end, coupler and output do, and the coupler's
        normal turns round.
        """
        options = [found]
        for flip_c in (False, True):
            for flip_b in (False, True):
                shape, frame, angles, side = found.shape.copy(), found.frame, found.angles, found.side
                if flip_c:
                    shape[[0, 3]] = np.pi - shape[[0, 3]]
                    frame, angles, side = frame * (-1.0, -1.0, 1.0), angles + np.pi, -side
                if flip_b:
                    shape[[2, 3]] = np.pi - shape[[2, 3]]
                    shape[4:] *= -1
                    side = -side
                options.append(_Start(frame, shape, side, angles))
        kept = [
            one
            for one in options
            if one.shape[:4].min() >= self._least and one.shape[:4].max() <= self._greatest
        ]
        return min(kept or options, key=lambda one: float(one.shape[:4].sum()))

    def design(self, start: _Start) -> SphericalParams | None:
        """The design of a fit; None if it does not run through the points in their order."""
        angles = start.angles
        sense = 1.0 if angles[-1] >= angles[0] else -1.0
        steps = sense * np.diff(angles)
        travel = sense * math.tau if self._wanted.closed else angles[-1] - angles[0]
        if (steps <= 0).any() or abs(angles[-1] - angles[0]) > abs(travel) + 1e-12 or travel == 0:
            return None
        first = math.remainder(angles[0], math.tau)
        degrees = np.degrees(start.shape).round(DIGITS).tolist()
        table = FourBarTable(
            ground=degrees[0],
            input=degrees[1],
            coupler=degrees[2],
            output=degrees[3],
            branch=1 if start.side > 0 else -1,
            point_azimuth=round(math.degrees(math.remainder(start.shape[4], math.tau)), DIGITS),
            point_elevation=degrees[5],
            start=round(math.degrees(first), DIGITS),
            travel=round(math.degrees(travel), DIGITS),
            input_axis=tuple(start.frame[:, 2].round(DIGITS + 2).tolist()),
            output_towards=tuple(start.frame[:, 0].round(DIGITS + 2).tolist()),
            path=tuple(map(tuple, self._targets.T.round(DIGITS + 2).tolist())),
            path_angles=tuple(np.degrees(angles - angles[0]).round(DIGITS).tolist()),
        )
        return SphericalParams(
            kind="four-bar",
            radius=self._wanted.radius,
            speed=self._wanted.speed,
            least_transmission=self._wanted.least_transmission,
            four_bar=table,
        )


def _linkage(shapes: Array, sides: Array) -> FourBar:
    """Four-bars (m,) of shapes (6, m), their fields (m, 1) for many input angles each."""
    a1, a2, a3, a4, kappa, eta = shapes[:, :, None]
    return FourBar(a1, a2, a3, a4, sides[:, None], kappa, eta)


def _rotation(x: Array) -> Array:
    """Rotation matrices (3, 3, designs) of rotation vectors (3, designs)."""
    angle = np.sqrt((x**2).sum(axis=0))
    axis = np.where(angle > 0, x / np.where(angle > 0, angle, 1.0), np.array([[1.0], [0.0], [0.0]]))
    units = np.broadcast_to(np.eye(3)[:, :, None], (3, 3, x.shape[1]))
    return np.stack([rotate(axis, angle, units[:, column]) for column in range(3)], axis=1)


def _kabsch(points: Array, targets: Array) -> tuple[Array, Array]:
    """Rotations (m, 3, 3) that bring points (m, n, 3) nearest to targets (n, 3); mean square errors (m,)."""
    u, s, vt = np.linalg.svd(np.einsum("mni,nj->mij", points, targets))
    sign = np.sign(np.linalg.det(u) * np.linalg.det(vt))
    fix = np.ones_like(s)
    fix[:, 2] = sign
    frames = np.einsum("mji,mj,mkj->mik", vt, fix, u)
    return frames, 2 - 2 * (s * fix).sum(axis=1) / len(targets)


_ALIKE = 0.01
"""Degrees by which two linkages differ at least: fits from two starts end within a millionth of each
other."""


def _same(one: SphericalParams, two: SphericalParams) -> bool:
    names = ("ground", "input", "coupler", "output", "point_azimuth", "point_elevation", "start")
    return all(abs(getattr(one.four_bar, name) - getattr(two.four_bar, name)) < _ALIKE for name in names)


def _residual(params: SphericalParams) -> float:
    (phase,) = linkage_of(params).phases
    return float(params.radius * np.sqrt(np.mean(phase.path_errors**2)))


def _candidate(params: SphericalParams) -> Candidate[SphericalParams]:
    (phase,) = linkage_of(params).phases
    sine = checks.weakest(phase)[1]
    return Candidate(
        params,
        Scalar(_residual(params), "mm"),
        {
            "path_error_max": Scalar(float(params.radius * phase.path_errors.max()), "mm"),
            "transmission_min": Scalar(math.asin(min(1.0, sine)), "rad"),
        },
    )
