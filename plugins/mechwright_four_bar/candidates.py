"""From dimensions that a synthesis has found to designs that can be built."""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from pydantic import ValidationError

from mechwright import Candidate, Rejected, Scalar
from mechwright.contracts.finding import errors
from mechwright_four_bar.checks import findings
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.params import FourBarParams


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
    """

    bar: FourBar
    residual: Scalar
    figures: dict[str, Scalar]
    pivot: complex = 0j
    point: complex | None = None
    sense: int = 1
    acceleration_ratio: float = 0.0
    swing: tuple[float, float] | None = None

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
        return table


def buildable(
    found: Iterable[Found], most: int, rejected: Rejected, progress: Callable[[float], None], count: int
) -> tuple[list[Candidate[FourBarParams]], str]:
    """The first ``most`` of ``count`` linkages whose design has no error, and why the first other has one.

    Those that come after them are counted and not looked at.
    """
    candidates: list[Candidate[FourBarParams]] = []
    reason = ""
    for looked, one in enumerate(found, start=1):
        try:
            params = FourBarParams.model_validate(one.table())
        except ValidationError as error:
            detail = error.errors(include_url=False)[0]
            said = f"{'.'.join(map(str, detail['loc']))}: {detail['msg']}"
            reason = reason or said
            rejected.because("four-bar.out-of-bounds", said)
            continue
        faults = errors(findings(params))
        if rejected.by(faults):
            reason = reason or f"{faults[0].parameter}: {faults[0].message}"
            continue
        candidates.append(Candidate(params, one.residual, one.figures))
        progress(len(candidates) / most)
        if len(candidates) == most:
            rejected.beyond(most, count - looked)
            break
    return candidates, reason
