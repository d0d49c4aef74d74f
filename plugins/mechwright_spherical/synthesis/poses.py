"""Synthesis of a spherical four-bar whose coupler carries a body through five orientations."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import permutations, product

import numpy as np

from mechwright import Array, Candidate, Finding, Progress, Rejected, Scalar, Synthesis
from mechwright.contracts.finding import errors
from mechwright.contracts.synthesis import ALIKE
from mechwright.mechanics.linkage.passing import passing
from mechwright_spherical.defaults.complete_parameters import CompleteParams
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.mobility import input_ways, mobility
from mechwright_spherical.kinematics.vectors import arc, azimuth, cross, dot, norm, vector
from mechwright_spherical.parameters import FourBarTable, SphericalParams
from mechwright_spherical.requirements import PosesRequirement
from mechwright_spherical.rules.assembly import least_transmission
from mechwright_spherical.rules.rule_table import findings_of
from mechwright_spherical.synthesis.dyads import COUNT, Dyad, of_five, turns

DIGITS = 12
"""Decimals of degrees and directions in design files: a pose is then met to a millionth of a micrometre."""

DEFECTS = {
    "spherical.branch": "the poses lie on both branches: the linkage would have to be taken apart",
    "spherical.circuit": "the input cannot come from one pose to the next: they lie in separate circuits",
    "spherical.order": "the input passes the poses in another order",
}


@dataclass(frozen=True)
class Carrying:
    """A linkage that carries a body through its poses.

    Parameters
    ----------
    o, c
        (3,) input and output axis.
    a, b
        (3, n) moving axes at the poses.
    theta
        (n,) input angles from the arc oc, rad, one way.
    full
        Whether the input turns fully.
    """

    o: Array
    c: Array
    a: Array
    b: Array
    theta: Array
    full: bool

    @property
    def arcs(self) -> tuple[float, float, float, float]:
        """Ground, input, coupler, output, rad."""
        return arcs(self.o, self.c, self.a[:, 0], self.b[:, 0])

    @property
    def side(self) -> int:
        """The sign of c.(a x b), its branch."""
        return 1 if float(dot(self.c, cross(self.a[:, 0], self.b[:, 0]))) > 0 else -1


def arcs(o: Array, c: Array, a: Array, b: Array) -> tuple[float, float, float, float]:
    """Ground, input, coupler and output of axes (3,), rad."""
    return float(arc(o, c)), float(arc(o, a)), float(arc(a, b)), float(arc(c, b))


def carrying(one: Dyad, two: Dyad, turned: Array) -> Carrying | str:
    """The linkage of an input and an output dyad; else its defect.

    An axis may be held at either of its ends: of the eight ways the one with the shortest arcs is taken.

    Parameters
    ----------
    turned
        (n - 1, 3, 3) turns of the body from the first pose.
    """
    ways = product((one.fixed,), *((v, -v) for v in (two.fixed, one.moving, two.moving)))
    o, c, a1, b1 = min(ways, key=lambda way: sum(arcs(*way)))
    every = np.concatenate((np.eye(3)[None], turned))
    a, b = (every @ a1).T, (every @ b1).T
    sides = dot(c[:, None], cross(a, b))
    if not ((sides > 0).all() or (sides < 0).all()):
        return "branch"
    lengths = arcs(o, c, a1, b1)
    theta = azimuth(np.broadcast_to(o[:, None], a.shape), np.broadcast_to(c[:, None], a.shape), a)
    full = bool(mobility(*lengths).input_full)
    passed = passing(theta, None if full else input_ways(*lengths))
    return passed if isinstance(passed, str) else Carrying(o, c, a, b, passed, full)


def from_five(wanted: PosesRequirement, progress: Progress) -> Synthesis[SphericalParams]:
    """Every linkage through the poses that keeps the limits, the best transmission angle leading.

    Of the six dyads of five poses each real one can be the input and each other one the output. Those that
    would have to be taken apart between poses, that cannot come from one to the next, or that pass them in
    another order, are counted and left out.
    """
    rotations = wanted.rotations
    dyads = of_five(rotations)
    if dyads is None:
        message = "through these poses go infinitely many dyads: they turn about one axis, or repeat a turn"
        return Synthesis((), (_fault("poses", message, "move a pose"),))
    progress(0.3, "linkages through the poses")
    found: list[Candidate[SphericalParams]] = []
    rejected = Rejected()
    sound = 0
    for one, two in permutations(dyads, 2):
        linkage = carrying(one, two, turns(rotations))
        if isinstance(linkage, str):
            code = f"spherical.{linkage}"
            rejected.because(code, DEFECTS[code])
            continue
        sound += 1
        if wanted.drive != "any" and linkage.full != (wanted.drive == "crank"):
            said = "the input turns fully" if linkage.full else "the input cannot turn fully"
            rejected.because("spherical.limits", said)
            continue
        found += _kept(design(linkage, wanted), wanted, rejected)
    progress(1.0, "designs")
    found.sort(key=lambda one: -one.figures["least_transmission"].value)
    found = _distinct(found, rejected)
    said = (
        f"five poses have {len(dyads)} real dyads of {COUNT}; {sound} linkages of them go through the poses "
        "without a defect"
    )
    if found:
        note = Finding.note("spherical.poses", said)
        rejected.beyond(wanted.designs, len(found) - wanted.designs)
        return Synthesis(tuple(found[: wanted.designs]), (note,), rejected.reasons)
    why = next(iter(reason.message for reason in rejected.reasons), "none is real")
    fault = _fault("poses", f"{said}, and none that can be built within the limits: {why}", "move a pose")
    return Synthesis((), (fault,), rejected.reasons)


def _distinct(
    found: list[Candidate[SphericalParams]], rejected: Rejected
) -> list[Candidate[SphericalParams]]:
    """The candidates but those whose arcs and input axis are nearly those of an earlier one."""
    kept: list[Candidate[SphericalParams]] = []
    rows: list[Array] = []
    for one in found:
        table = one.params.four_bar
        arcs_ = np.radians([table.ground, table.input, table.coupler, table.output])
        row = np.concatenate((arcs_, np.array(table.input_axis), np.array(table.output_towards)))
        if any(np.abs(row - other).max() < ALIKE * arcs_.min() for other in rows):
            rejected.same()
        else:
            kept.append(one)
            rows.append(row)
    return kept


def _fault(parameter: str, message: str, remedy: str) -> Finding:
    return Finding.error("spherical.synthesis", parameter, message, remedy=remedy)


def design(linkage: Carrying, wanted: PosesRequirement) -> SphericalParams:
    """The linkage as a design that starts in the first pose."""
    places = (wanted.rotations @ vector(wanted.point)).T
    a, b, p = linkage.a[:, 0], linkage.b[:, 0], places[:, 0]
    m = cross(a, b) / norm(cross(a, b))
    ground, input_, coupler, output = np.degrees(linkage.arcs).round(DIGITS).tolist()
    theta = linkage.theta
    travel = math.copysign(math.tau, theta[-1] - theta[0]) if linkage.full else theta[-1] - theta[0]
    azimuth_ = math.atan2(float(dot(p, cross(m, a))), float(dot(p, a)))
    table = FourBarTable(
        ground=ground,
        input=input_,
        coupler=coupler,
        output=output,
        branch=1 if linkage.side > 0 else -1,
        point_azimuth=round(math.degrees(azimuth_), DIGITS),
        point_elevation=round(math.degrees(math.asin(float(np.clip(dot(p, m), -1, 1)))), DIGITS),
        start=round(math.degrees(math.remainder(float(theta[0]), math.tau)), DIGITS),
        travel=round(math.degrees(float(travel)), DIGITS),
        input_axis=tuple(linkage.o.round(DIGITS).tolist()),
        output_towards=tuple(linkage.c.round(DIGITS).tolist()),
        path=tuple(map(tuple, places.T.round(DIGITS).tolist())),
        path_angles=tuple(np.degrees(theta - theta[0]).round(DIGITS).tolist()),
    )
    return CompleteParams(
        kind="four-bar",
        radius=wanted.radius,
        speed=wanted.speed,
        least_transmission=wanted.least_transmission,
        four_bar=table,
    )


def _kept(
    params: SphericalParams, wanted: PosesRequirement, rejected: Rejected
) -> Iterator[Candidate[SphericalParams]]:
    """The design as a candidate where it keeps the limits and has no error; else it is counted."""
    if rejected.by(errors(findings_of(params))):
        return
    (phase,) = linkage_of(params).phases
    angle = least_transmission(phase)
    if angle < math.radians(wanted.least_transmission):
        said = f"the transmission angle falls to {math.degrees(angle):.3g} degrees"
        rejected.because("spherical.transmission", said)
        return
    errors_ = params.radius * phase.path_errors
    yield Candidate(
        params,
        Scalar(float(np.sqrt(np.mean(errors_**2))), "mm"),
        {
            "least_transmission": Scalar(angle, "rad"),
            "path_error_max": Scalar(float(errors_.max()), "mm"),
        },
    )
