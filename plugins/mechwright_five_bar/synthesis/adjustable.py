"""Synthesis of adjustable five-bars: one set of links whose pivots are set to a path per phase."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from mechwright import Finding, Progress, Scalar, Synthesis
from mechwright.mechanics.adjustable import PlaneSpace, settings_of
from mechwright.mechanics.adjustable.designs import Phased, designs_of
from mechwright.mechanics.adjustable.machine import DIGITS, Machine
from mechwright_five_bar.defaults.complete_parameters import CompleteParams
from mechwright_five_bar.kinematics.dimensions import FiveBar
from mechwright_five_bar.kinematics.reach import transmission_range, turns_fully
from mechwright_five_bar.parameters import FiveBarParams
from mechwright_five_bar.requirements import AdjustablePathRequirement
from mechwright_five_bar.rules.motion import GOOD_TRANSMISSION
from mechwright_five_bar.rules.rule_table import DESIGN
from mechwright_five_bar.table import FiveBarTable


def through_phases(wanted: AdjustablePathRequirement, progress: Progress) -> Synthesis[FiveBarParams]:
    """Machines whose coupler point follows all paths, each as one design per phase; the best first."""
    return designs_of(PhasedFiveBar(wanted), progress)


LINKS = ("crank", "coupler", "rocker", "arm", "ground")


class PhasedFiveBar(Phased[AdjustablePathRequirement, FiveBarParams]):
    """A five-bar whose coupler pivots are set."""

    bars = 5
    out_of_bounds = "five-bar.out-of-bounds"
    good_transmission = GOOD_TRANSMISSION
    remedy = "allow a larger tolerance, leave points out, take other gears, or use more starts"
    params = CompleteParams

    @property
    def ratio(self) -> float:
        """Turns of the arm per turn of the crank."""
        return self.wanted.ratio

    def lengths(self, one: Machine, k: int) -> Sequence[float]:
        """Of all links, mm."""
        return bar_in(one, k, self.wanted).lengths

    def branch(self, one: Machine, k: int) -> int:
        """On which side of the line from A to B1 C lies."""
        branch: int = bar_in(one, k, self.wanted).branch
        return branch

    def turns_fully(self, one: Machine, k: int) -> bool:
        """Whether the crank does."""
        return turns_fully(bar_in(one, k, self.wanted))

    def transmission(self, one: Machine, k: int) -> float:
        """Least transmission angle of a phase, rad: over all turns, or as far as its points go."""
        bar, start = bar_in(one, k, self.wanted), start_of(one, k)
        way = math.tau * bar.turns if self.wanted.full_turn else float(one.theta[k][-1])
        least: float = transmission_range(bar, start, start + way)[0]
        return least

    def table(self, one: Machine, k: int) -> Mapping[str, object]:
        """As :func:`table_of`."""
        return table_of(one, k, self.wanted)

    def faults(self, params: FiveBarParams) -> Sequence[Finding]:
        """The findings."""
        return DESIGN.findings(FiveBarTable.of(params))

    def figures(self, one: Machine, k: int) -> dict[str, Scalar]:
        """How a phase is set, and crank, arm and rocker at each point."""
        settings = settings_of(PlaneSpace(0j), one.pins)
        bar, angles = bar_in(one, k, self.wanted), start_of(one, k) + one.theta[k]
        rocker = np.angle(bar.at(angles).bodies["rocker"].turning.direction)
        found = {
            "crank_turned": Scalar(float(settings.crank[k]), "rad"),
            "rocker_turned": Scalar(float(settings.follower[k]), "rad"),
        }
        for number, angle in enumerate(angles, start=1):
            found[f"crank_angle_{number}"] = Scalar(float(angle), "rad")
            found[f"arm_angle_{number}"] = Scalar(bar.offset + bar.ratio * float(angle), "rad")
            found[f"rocker_angle_{number}"] = Scalar(float(rocker[number - 1]), "rad")
        return found


def bar_in(one: Machine, phase: int, wanted: AdjustablePathRequirement) -> FiveBar:
    """Dimensions of a machine's phase, from 0."""
    names = ("a0", "a", "b0", "b1", "c")
    a0, a, b0, b1, c = (complex(getattr(one.pins, name)[phase]) for name in names)
    side = PlaneSpace(0j).side(np.array(a), np.array(b1), np.array(c))
    start, arm = start_of(one, phase), float(np.angle(b1 - b0))
    return FiveBar(
        abs(a - a0), abs(c - a), abs(c - b1), abs(b1 - b0), abs(b0 - a0), float(np.angle(b0 - a0)),
        arm - wanted.ratio * start, (wanted.crank_teeth, wanted.arm_teeth), 1 if wanted.idler else -1,
        int(side),
    )  # fmt: skip


def start_of(one: Machine, k: int) -> float:
    """Crank angle of a phase in the pose of setting, rad: that of the first phase and the turn from it on.

    A turn more would be half a turn of the arm where the ratio is a half, so it matters how it is counted.
    """
    first, own = (complex(one.pins.a[n] - one.pins.a0[n]) for n in (0, k))
    return float(np.angle(first) + np.angle(own / first))


def table_of(one: Machine, k: int, wanted: AdjustablePathRequirement) -> dict[str, object]:
    """The table ``[parameters]`` that shows a phase, from 0."""
    bar = bar_in(one, 0, wanted)
    a0, a, c, p = (complex(getattr(one.pins, name)[0]) for name in ("a0", "a", "c", "p"))
    point = (p - a) * (c - a).conjugate() / abs(c - a)
    table: dict[str, object] = {
        **{name: round(getattr(bar, name), DIGITS) for name in LINKS},
        "ground_angle": math.degrees(bar.ground_angle),
        "arm_angle": math.degrees(bar.offset),
        "branch": "open" if bar.branch > 0 else "crossed",
        "pivot_x": a0.real,
        "pivot_y": a0.imag,
        "coupler_point_x": point.real,
        "coupler_point_y": point.imag,
        "crank_teeth": wanted.crank_teeth,
        "arm_teeth": wanted.arm_teeth,
        "idler_teeth": wanted.crank_teeth if wanted.idler else 0,
    }
    phases = range(len(one.theta))
    swings = [_swing(one, number) for number in phases]
    if wanted.full_turn:
        table["direction"] = "ccw" if one.theta[k][-1] > 0 else "cw"
    else:
        table |= swings[0]
    if len(one.theta) > 1:
        settings = settings_of(PlaneSpace(0j), one.pins)
        turns = np.degrees([settings.crank, settings.follower]).T[1:].tolist()
        table["setting_angle"] = math.degrees(start_of(one, 0))
        table["phase"] = k + 1
        table["phases"] = [
            {"crank_turn": crank, "rocker_turn": rocker, **({} if wanted.full_turn else swings[number])}
            for number, (crank, rocker) in enumerate(turns, start=1)
        ]
    return table


def _swing(one: Machine, k: int) -> dict[str, float]:
    """From the pose of setting to a phase's last point, degrees, counted on from phase 1."""
    start = start_of(one, k)
    return {"swing_from": math.degrees(start), "swing_to": math.degrees(start + float(one.theta[k][-1]))}
