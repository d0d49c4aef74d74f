"""From dimensions that a synthesis has found to designs that can be built."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from pydantic import ValidationError

from mechwright import Candidate, Rejected, Scalar
from mechwright.contracts.finding import Severity, errors
from mechwright.mechanics.adjustable.machine import DIGITS
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.rules.motion_rules import GOOD_TRANSMISSION
from mechwright_four_bar.rules.rule_table import findings_of
from mechwright_four_bar.table import FourBarTable

GOOD_ANGLE = math.radians(GOOD_TRANSMISSION)
"""Transmission angle from which a larger one is not worth longer links."""


@dataclass(frozen=True)
class Found:
    """A linkage with its merits.

    Parameters
    ----------
    bar
        Its dimensions.
    residual
        By how much it misses the requirement.
    figures
        What to compare it by.
    pivot
        A0, x + i y, mm.
    point
        The coupler point in the coupler's frame, x + i y, mm.
    sense
        +1 for a crank that turns counter-clockwise, -1 for the other.
    acceleration_ratio
        Of the crank, per radian.
    swing
        Crank angles from X, rad, between which a lever swings; None for a crank that turns.
    digits
        Decimals of lengths, mm, and angles, degrees, in the design; None for all that a number has.
    """

    bar: FourBar
    residual: Scalar
    figures: dict[str, Scalar]
    pivot: complex = 0j
    point: complex | None = None
    sense: int = 1
    acceleration_ratio: float = 0.0
    swing: tuple[float, float] | None = None
    digits: int | None = DIGITS

    def table(self) -> dict[str, object]:
        """The table ``[parameters]``; what the synthesis does not say is left to its defaults."""
        bar = self.bar
        table: dict[str, object] = {
            "crank": bar.crank,
            "coupler": bar.coupler,
            "follower": bar.follower,
            "ground": bar.ground,
            "ground_angle": math.degrees(math.remainder(bar.ground_angle, math.tau)),
            "branch": "open" if bar.branch > 0 else "crossed",
            "direction": "ccw" if self.sense > 0 else "cw",
        }
        if self.swing is not None:
            one, two = map(math.degrees, self.swing)
            table |= {"direction": "ccw", "swing_from": one, "swing_to": two}
        if self.acceleration_ratio:
            table["acceleration_ratio"] = self.acceleration_ratio
        if self.pivot:
            table |= {"pivot_x": self.pivot.real, "pivot_y": self.pivot.imag}
        if self.point is not None:
            table |= {"coupler_point_x": self.point.real, "coupler_point_y": self.point.imag}
        if self.digits is None:
            return table
        return {
            key: round(value, self.digits) if isinstance(value, float) else value
            for key, value in table.items()
        }


def buildable(
    found: Iterable[Sequence[Found]],
    most: int,
    rejected: Rejected,
    progress: Callable[[float], None],
    count: int,
) -> tuple[list[Candidate[FourBarParams]], str]:
    """The first ``most`` of ``count`` linkages whose design has no error, and why the first other has one.

    Those that come after them are counted and not looked at. A linkage is given as all that it may be built
    as, such as its mirror image, of which the first without an error is taken.
    """
    candidates: list[Candidate[FourBarParams]] = []
    reason = ""
    for looked, ways in enumerate(found, start=1):
        said: list[tuple[str, str, str]] = []
        for one in ways:
            built = _built(one)
            if isinstance(built, FourBarParams):
                candidates.append(Candidate(built, one.residual, one.figures))
                break
            said.append(built)
        else:
            code, message, why = said[0]
            rejected.because(code, message)
            reason = reason or why
            continue
        progress(len(candidates) / most)
        if len(candidates) == most:
            rejected.beyond(most, count - looked)
            break
    return candidates, reason


def _built(one: Found) -> FourBarParams | tuple[str, str, str]:
    """The design; or of what speaks against it the code, the message and that in short."""
    try:
        params = FourBarParams.model_validate(one.table())
    except ValidationError as error:
        detail = error.errors(include_url=False)[0]
        said = f"{'.'.join(map(str, detail['loc']))}: {detail['msg']}"
        return "four-bar.out-of-bounds", said, said
    faults = errors(findings_of(FourBarTable.of(params)))
    if not faults:
        return params
    first = faults[0]
    return first.code, str(first), f"{first.parameter}: {first.message}"


def building(one: Found) -> tuple[int, int, float, float]:
    """How well a linkage builds, the least best: errors, warnings, transmission angle up to a good one, size.

    Figures of the linkage have ``least_transmission_angle`` and ``longest_link``.
    """
    try:
        params = FourBarParams.model_validate(one.table())
    except ValidationError:
        return (2, 0, 0.0, 0.0)
    told = [finding.severity for finding in findings_of(FourBarTable.of(params))]
    angle = min(one.figures["least_transmission_angle"].value, GOOD_ANGLE)
    longest = one.figures["longest_link"].value
    return int(Severity.ERROR in told), told.count(Severity.WARNING), -round(angle, 6), longest
