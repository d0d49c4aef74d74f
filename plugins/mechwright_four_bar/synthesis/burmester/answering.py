"""Synthesis of a linkage whose follower answers angles of the crank."""

import math
from collections import Counter
from collections.abc import Sequence

import numpy as np

from mechwright import Array, Finding, Progress, Scalar, Synthesis
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.synthesis.burmester import freudenstein
from mechwright_four_bar.synthesis.burmester.fitting import nearest
from mechwright_four_bar.synthesis.burmester.freudenstein import Answering
from mechwright_four_bar.synthesis.burmester.kept import Option, designs, driven, instead
from mechwright_four_bar.synthesis.burmester.rectify import Way, way_through
from mechwright_four_bar.synthesis.burmester.requirements import FunctionRequirement


def through_angles(wanted: FunctionRequirement, progress: Progress) -> Synthesis[FourBarParams]:
    """Linkages whose follower stands at its angles when the crank stands at its own, on one branch, in order.

    As many pairs as there are unknowns are met exactly: 3, with the follower counted from anywhere 4, with
    both links 5; the best transmission angle leads. More, and those that no linkage within the limits meets,
    are met as nearly as can be, by least squares of the follower's error.
    """
    phi, psi = np.radians(wanted.crank_angles), np.radians(wanted.follower_angles)
    exact = {"none": 3, "follower": 4, "both": 5}[wanted.offsets]
    if phi.size > exact:
        progress(0.0, "linkages that answer")
        return _told(_designs(nearest(phi, psi, wanted), phi, psi, wanted, False, progress), wanted)
    solve = {3: freudenstein.of_three, 4: freudenstein.of_four, 5: freudenstein.of_five}[exact]
    first = _designs(solve(phi, psi), phi, psi, wanted, True, progress)
    if first.candidates:
        return first
    near = _designs(nearest(phi, psi, wanted), phi, psi, wanted, False, progress)
    return _told(instead("function", first, near), wanted)


def _designs(
    found: Sequence[Answering],
    phi: Array,
    psi: Array,
    wanted: FunctionRequirement,
    exactly: bool,
    progress: Progress,
) -> Synthesis[FourBarParams]:
    """Designs of linkages that answer, exactly or nearly."""
    progress(0.5, "linkages that answer")
    defects: Counter[str] = Counter()
    options: list[Option] = []
    for one in found:
        way = _way(one, phi, psi, wanted.ground)
        if isinstance(way, str):
            defects[way] += 1
        else:
            options.append(_option(way, psi))
    options.sort(key=lambda one: -driven(one.way, wanted).least_angle if exactly else one.error.value)
    how = "exactly" if exactly else "nearly"
    return designs(
        "function",
        options,
        dict(defects),
        wanted,
        lambda: (
            f"{len(found)} linkages answer {phi.size} pairs {how}, {len(options)} of them without a defect"
        ),
        lambda part: progress(0.5 + part / 2, "designs"),
    )


def _told(result: Synthesis[FourBarParams], wanted: FunctionRequirement) -> Synthesis[FourBarParams]:
    """The same, with a warning where all err by more than the tolerance."""
    if not result.candidates or not wanted.tolerance:
        return result
    best = math.degrees(min(one.residual.value for one in result.candidates))
    if best <= wanted.tolerance:
        return result
    missed = Finding.warning(
        "function.missed",
        "follower",
        f"no linkage was found whose follower errs by at most {wanted.tolerance:g} degrees: the best one "
        f"errs by {best:.4g}",
        best,
        wanted.tolerance,
        "deg",
        "allow a larger tolerance, or count more angles from anywhere (offsets)",
    )
    return Synthesis(result.candidates, (*result.findings, missed), result.rejected)


def _way(one: Answering, phi: Array, psi: Array, ground: float) -> Way | str:
    """How the crank goes through its angles, the joints at their wanted places."""
    a = one.crank * ground * np.exp(1j * (phi - phi[0] + one.phi))
    b = ground + one.follower * ground * np.exp(1j * (psi - psi[0] + one.psi))
    way = way_through(0j, complex(ground), a, b)
    if isinstance(way, str):
        return way
    return Way(one.bar(ground, way.bar.branch), way.phi, way.full)


def _option(way: Way, psi: Array) -> Option:
    """A linkage with the greatest error of its follower, whose offset is the one that makes it least."""
    answer = np.angle(close(way.bar, way.phi).follower.direction * np.exp(-1j * psi))
    turned = np.unwrap(answer)
    middle = (turned.max() + turned.min()) / 2
    figures = {
        "mean_error": Scalar(float(np.sqrt(np.mean((turned - middle) ** 2))), "rad"),
        "first_follower_angle": Scalar(float((middle + psi[0]) % math.tau), "rad"),
    }
    return Option(way, Scalar(float(np.ptp(turned) / 2), "rad"), figures)
