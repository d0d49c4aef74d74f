"""What is to be said of a crank that accelerates over its turn."""

import math
from collections.abc import Iterator, Sequence

from mechwright.contracts.finding import Finding
from mechwright.mechanics.planar.course import Course
from mechwright.tolerances import exceeds

FASTEST = 20000.0
"""rev/min, the most that a design may ask of a crank."""


def of_acceleration(code: str, course: Course, ratio: float, speed: float) -> Iterator[Finding]:
    """What the parameter ``acceleration_ratio`` of a design cannot be, or leads to.

    Parameters
    ----------
    code
        Of the findings.
    course
        The crank's way over a period.
    ratio
        As the design file says it, per radian.
    speed
        At the start, rev/min.
    """
    if course.rocks and ratio != 0:
        yield Finding.error(
            code,
            "acceleration_ratio",
            f"acceleration_ratio = {ratio:g} is of a crank that turns; this one is a lever, which swings "
            "harmonically and has accelerations of its own",
            ratio,
            0.0,
            remedy="set acceleration_ratio to 0",
        )
        return
    growth = ratio * course.travel
    last = speed * math.exp(growth)
    if exceeds(last, FASTEST) and growth > 0:
        most = math.log(FASTEST / speed) / course.travel
        least = FASTEST / math.exp(growth)
        yield Finding.warning(
            code,
            "acceleration_ratio",
            f"the crank begins with {speed:g} rev/min and ends the period with {last:.4g}, the limit is "
            f"{FASTEST:g} rev/min; poles, and rates over the speed squared, do not depend on it",
            last,
            FASTEST,
            "rpm",
            f"keep acceleration_ratio at {math.floor(abs(most) * 1e4) / math.copysign(1e4, most):g} or "
            f"nearer to 0, or begin with at most {least:.4g} rev/min",
        )


def common_ratio(ratios: Sequence[float]) -> float | None:
    """The acceleration ratio that all poles of a requirement share; None where they differ.

    >>> common_ratio((0.5, 0.5)), common_ratio((0.0, 0.5))
    (0.5, None)
    """
    return ratios[0] if len(set(ratios)) == 1 else None


def of_several_ratios(code: str, ratios: Sequence[float]) -> Finding:
    """A synthesis whose poles have ratios of their own, which no design has all at once."""
    said = ", ".join(f"{ratio:g}" for ratio in ratios)
    return Finding.note(
        code,
        f"the poles are there at the acceleration ratios {said}, each at its own; the designs have a crank "
        "of constant speed: set acceleration_ratio to see one",
    )
