"""Synthesis of a linkage whose coupler carries a body through poses."""

import math
from collections import Counter
from itertools import permutations

import numpy as np
from scipy.optimize import least_squares as fit

from mechwright import Array, Finding, Progress, Scalar, Synthesis
from mechwright.mechanics.multistart import distinct, least_squares
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.synthesis.burmester import dyads
from mechwright_four_bar.synthesis.burmester.dyads import Dyad, Poses
from mechwright_four_bar.synthesis.burmester.kept import WEIGHTS, Option, designs, driven, instead, penalties
from mechwright_four_bar.synthesis.burmester.rectify import Way, loosely, way_through
from mechwright_four_bar.synthesis.burmester.requirements import EXACT, PosesRequirement

INFINITE = "hold the body in a bearing at that point, or move a pose"
"""What to do where a body turns about one point."""

SPREAD = 2.0
"""Sizes of the poses within which joints are sought about the origin, and pivots about the middle."""

PAIRED = 60
"""Most dyads, the nearest to their poses first, that are joined with each other."""

FITTED = 12
"""Most linkages that are fitted to more than five poses, or near fewer."""

SAME = 0.01
"""Share of the poses' size within which two dyads are one."""

STEPS = 60
"""Most steps of a dyad that is fitted to more than five poses."""

NEAR_STEPS = 4
"""Steps of a dyad that a linkage near three to five poses begins with: more would lead to the exact ones."""

DEFECTIVE = 0.1
"""By so much, in squares of the poses' size, a start with a defect stands back."""

FAILED = 1e3
"""Error of a linkage that cannot be joined, while it is fitted."""


def through_poses(wanted: PosesRequirement, progress: Progress) -> Synthesis[FourBarParams]:
    """Linkages that carry the body through the poses in their order, on one branch and in one circuit.

    The coupler point of a design is the body's origin; the figure ``frame_angle`` is the direction of its
    frame from that of A to B. Of three to five poses, which are met exactly, the best transmission angle
    leads; of more the nearest. Where no exact linkage is within the limits, those within them that come
    nearest are given, with a warning.
    """
    table = np.array(wanted.poses, dtype=float)
    poses = Poses(table[:, 0] + 1j * table[:, 1], np.radians(table[:, 2]))
    if len(wanted.poses) == EXACT and dyads.of_five(poses).infinite:
        message = (
            "infinitely many dyads go through these five poses: the body turns about one point, or nearly"
        )
        return Synthesis((), (Finding.error("poses.infinite", "poses", message, remedy=INFINITE),))
    found, said = _dyads(poses, wanted)
    ways, defects = _ways(found, poses, 0.0 if len(wanted.poses) == EXACT else wanted.shortest_link / 2)
    progress(0.5, "linkages through the poses")
    ways.sort(key=lambda one: -driven(one[0], wanted).least_angle)
    options = [_option(way, one, two, poses) for way, one, two in ways]
    if len(wanted.poses) > EXACT:
        ways.sort(key=lambda one: _spread(one[1], poses) + _spread(one[2], poses))
        options = [_fitted(*one, poses, wanted) or _option(*one, poses) for one in ways[:FITTED]]
        options.sort(key=lambda one: one.error.value)

    def told() -> str:
        return f"{said}; {len(ways)} linkages of them go through the poses without a defect"

    result = designs(
        "poses", options, dict(defects), wanted, told, lambda part: progress(0.5 + part / 2, "designs")
    )
    if result.candidates or len(wanted.poses) > EXACT:
        return result
    return instead("poses", result, _near(poses, wanted, progress))


Joined = tuple[Way, Dyad, Dyad]


def _ways(found: list[Dyad], poses: Poses, apart: float) -> tuple[list[Joined], Counter[str]]:
    """Pairs of dyads that go through the poses without a defect, and how many have which defect.

    Joints of the body that are nearer than ``apart``, mm, make no linkage.
    """
    ways: list[Joined] = []
    defects: Counter[str] = Counter()
    for one, two in permutations(found, 2):
        if abs(one.joint - two.joint) < apart:
            continue
        way = way_through(one.pivot, two.pivot, poses.joints(one.joint), poses.joints(two.joint))
        if isinstance(way, str):
            defects[way] += 1
        else:
            ways.append((way, one, two))
    return ways, defects


def _near(poses: Poses, wanted: PosesRequirement, progress: Progress) -> Synthesis[FourBarParams]:
    """Linkages within the limits that come nearest to three to five poses.

    Fits begin at linkages that go roughly through the poses, those with a defect among them: what is fitted
    stays on one branch.
    """
    rng = np.random.default_rng(wanted.seed)
    far = SPREAD * max(poses.size, wanted.shortest_link)
    starts: list[tuple[float, Joined]] = []
    for one, two in permutations(_nearest(poses, wanted, rng, far, NEAR_STEPS), 2):
        if abs(one.joint - two.joint) < wanted.shortest_link / 2:
            continue
        joints = poses.joints(one.joint), poses.joints(two.joint)
        found = way_through(one.pivot, two.pivot, *joints)
        way = loosely(one.pivot, two.pivot, *joints) if isinstance(found, str) else found
        off = (_spread(one, poses) + _spread(two, poses)) / poses.size**2
        beyond = float(np.square(penalties(way.bar, way.phi, wanted, 1.0)).sum())
        starts.append((off + beyond + DEFECTIVE * isinstance(found, str), (way, one, two)))
    starts.sort(key=lambda start: start[0])
    fitted = [_fitted(*joined, poses, wanted) for _, joined in starts[:FITTED]]
    options = sorted((one for one in fitted if one is not None), key=lambda one: one.error.value)

    def told() -> str:
        return (
            f"of {len(starts)} linkages near the poses {len(fitted)} were fitted to them within the limits, "
            f"{len(options)} without a defect"
        )

    return designs(
        "poses", options, {}, wanted, told, lambda part: progress(1.0, f"designs near the poses, {part:.0%}")
    )


def _dyads(poses: Poses, wanted: PosesRequirement) -> tuple[list[Dyad], str]:
    """Cranks and followers that the poses allow, and how many there are."""
    count = len(wanted.poses)
    if count == EXACT:
        result = dyads.of_five(poses)
        sliding = f", {result.sliders} of them sliders" if result.sliders else ""
        return list(
            result.dyads
        ), f"five poses have {len(result.dyads) + result.sliders} real dyads of 4{sliding}"
    rng = np.random.default_rng(wanted.seed)
    far = SPREAD * max(poses.size, wanted.shortest_link)
    if count > EXACT:
        return _nearest(poses, wanted, rng, far), f"of {wanted.starts} joints the nearest were taken"
    found: list[Dyad] = []
    for x, y in rng.uniform(-far, far, (wanted.starts, 2)):
        if count == 3:
            one = dyads.of_three(poses, complex(x, y))
            found += [] if one is None else [one]
        else:
            found += dyads.of_four(poses, float(x))
    found = [
        one for one in found
        if wanted.shortest_link <= one.length <= wanted.longest_link and abs(one.joint) <= 2 * far
    ]  # fmt: skip
    many = "one" if count == 4 else "two"
    return found[
        :PAIRED
    ], f"{count} poses have dyads of {many} free number{'s' * (count == 3)}, {wanted.starts} were tried"


def _nearest(
    poses: Poses, wanted: PosesRequirement, rng: np.random.Generator, far: float, steps: int = STEPS
) -> list[Dyad]:
    """Dyads fitted to poses in so many steps, the nearest first."""
    size, middle = max(poses.size, wanted.shortest_link), complex(poses.places.mean())
    d, e = (poses.places - middle) / size, poses.directions

    def residual(x: Array) -> Array:
        joints = d + (x[:, :1] + 1j * x[:, 1:2]) * e
        distances: Array = np.abs(joints - (x[:, 2:3] + 1j * x[:, 3:4])) - x[:, 4:5]
        return distances / math.sqrt(d.size)

    starts = rng.uniform(-far / size, far / size, (wanted.starts, 4))
    joints = d + (starts[:, :1] + 1j * starts[:, 1:2]) * e
    reach = np.abs(joints - (starts[:, 2:3] + 1j * starts[:, 3:4])).mean(axis=1)
    x, costs = least_squares(residual, np.column_stack((starts, reach)), steps, 1e-26)
    x = x[np.argsort(costs, kind="stable")]
    x = x[(x[:, 4] * size >= wanted.shortest_link / 2) & (x[:, 4] * size <= 2 * wanted.longest_link)]
    x = x[distinct(x, SAME)][:PAIRED] if len(x) else x
    return [Dyad(complex(a, b) * size, complex(c, g) * size + middle, float(r) * size) for a, b, c, g, r in x]


def _spread(one: Dyad, poses: Poses) -> float:
    """Variance of a dyad's length over the poses, mm²."""
    return float(np.var(np.abs(poses.joints(one.joint) - one.pivot)))


def _option(way: Way, one: Dyad, two: Dyad, poses: Poses) -> Option:
    """A linkage with the errors of its poses at its crank angles."""
    along = two.joint - one.joint
    frame = math.atan2(along.imag, along.real)
    point = -one.joint * complex(math.cos(frame), -math.sin(frame))
    loop = close(way.bar, way.phi)
    places = one.pivot + loop.joint_a + point * loop.coupler.direction
    turned = np.angle(loop.coupler.direction * np.exp(-1j * (frame + poses.angles)))
    figures = {
        "angle_error": Scalar(float(np.sqrt(np.mean(turned**2))), "rad"),
        "frame_angle": Scalar(math.remainder(-frame, math.tau), "rad"),
    }
    error = Scalar(float(np.sqrt(np.mean(np.abs(places - poses.places) ** 2))), "mm")
    return Option(way, error, figures, one.pivot, point)


def _fitted(way: Way, one: Dyad, two: Dyad, poses: Poses, wanted: PosesRequirement) -> Option | None:
    """The linkage fitted to places and directions at once, each crank angle free, within its limits.

    None where it has a defect then.
    """
    size = poses.size

    def linkage(x: Array) -> tuple[FourBar, Dyad, Dyad, Array]:
        w, v, g, h = (complex(*x[2 * k : 2 * k + 2]) * size for k in range(4))
        a, b = (float(length) for length in np.exp(x[8:10]) * size)
        ground = h - g
        bar = FourBar(a, abs(v - w), b, abs(ground), math.atan2(ground.imag, ground.real), way.bar.branch)
        return bar, Dyad(w, g, a), Dyad(v, h, b), x[10:]

    def residual(x: Array, weight: float) -> Array:
        bar, first, last, phi = linkage(x)
        loop = close(bar, phi)
        along = last.joint - first.joint
        direction = loop.coupler.direction * np.conj(along) / abs(along)
        places = first.pivot + loop.joint_a - first.joint * direction
        error = (places - poses.places) / size
        turned = np.angle(direction * np.exp(-1j * poses.angles)) * wanted.arm / size
        values = np.concatenate((error.real, error.imag, turned, penalties(bar, phi, wanted, weight)))
        return np.nan_to_num(values, nan=FAILED)

    start = [part / size for z in (one.joint, two.joint, one.pivot, two.pivot) for part in (z.real, z.imag)]
    x = np.array([*start, math.log(one.length / size), math.log(two.length / size), *way.phi])
    for weight in WEIGHTS:
        x = fit(residual, x, xtol=1e-14, ftol=1e-14, gtol=1e-14, max_nfev=200, args=(weight,)).x
    bar, first, last, phi = linkage(x)
    loop = close(bar, phi)
    joints = first.pivot + np.stack((loop.joint_a, loop.joint_b))
    again = (
        way_through(first.pivot, last.pivot, joints[0], joints[1]) if np.isfinite(joints).all() else "branch"
    )
    if isinstance(again, str):
        return None
    return _option(again, first, last, poses)
