"""Synthesis of adjustable four-bars: one set of links whose pivots are set to a path per phase."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from mechwright import Finding, Progress, Scalar, Synthesis
from mechwright.mechanics.adjustable import Moves, PlaneSpace, settings_of
from mechwright.mechanics.adjustable.designs import Phased, designs_of
from mechwright.mechanics.adjustable.machine import DIGITS, Machine
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.phases import in_phase
from mechwright_four_bar.requirements import LINKS, AdjustablePathRequirement
from mechwright_four_bar.rules.motion_rules import GOOD_TRANSMISSION
from mechwright_four_bar.rules.rule_table import findings_of
from mechwright_four_bar.table import FourBarTable


def through_phases(wanted: AdjustablePathRequirement, progress: Progress) -> Synthesis[FourBarParams]:
    """Machines whose coupler point follows all paths, each as one design per phase; the best first."""
    return designs_of(PhasedFourBar(wanted), progress)


class PhasedFourBar(Phased[AdjustablePathRequirement, FourBarParams]):
    """A four-bar of which pivots are set."""

    bars = 4
    out_of_bounds = "four-bar.out-of-bounds"
    good_transmission = GOOD_TRANSMISSION
    remedy = 'allow a larger tolerance, leave points out, set moves = "both", or use more starts'
    params = FourBarParams

    @property
    def moves(self) -> Moves:
        """Which pivots are set."""
        return self.wanted.moves

    def lengths(self, one: Machine, k: int) -> Sequence[float]:
        """Of all links, mm."""
        return bar_in(one, k).lengths

    def branch(self, one: Machine, k: int) -> int:
        """On which side of the line from A to B0 B lies."""
        return bar_in(one, k).branch

    def turns_fully(self, one: Machine, k: int) -> bool:
        """Whether the crank does."""
        return bar_in(one, k).kind.full_turn

    def transmission(self, one: Machine, k: int) -> float:
        """Least transmission angle of a phase, rad: over a turn, or as far as its points go."""
        bar = bar_in(one, k)
        if self.wanted.full_turn:
            return bar.least_transmission_angle()
        start = start_of(one, k) - bar.ground_angle
        return bar.transmission_range(start, start + float(one.theta[k][-1]))[0]

    def table(self, one: Machine, k: int) -> Mapping[str, object]:
        """As :func:`table_of`."""
        return table_of(one, k, self.wanted)

    def faults(self, params: FourBarParams) -> Sequence[Finding]:
        """The findings."""
        return tuple(findings_of(FourBarTable.of(in_phase(params))))

    def figures(self, one: Machine, k: int) -> dict[str, Scalar]:
        """How a phase is set, and crank and follower at each point."""
        settings = settings_of(PlaneSpace(0j), one.pins)
        angles = start_of(one, k) + one.theta[k]
        follower = np.angle(close(bar_in(one, k), angles).follower.direction)
        found = {
            "crank_turned": Scalar(float(settings.crank[k]), "rad"),
            "follower_turned": Scalar(float(settings.follower[k]), "rad"),
        }
        for number, angle in enumerate(angles, start=1):
            found[f"crank_angle_{number}"] = Scalar(float(angle), "rad")
            found[f"follower_angle_{number}"] = Scalar(float(follower[number - 1]), "rad")
        return found


def bar_in(one: Machine, phase: int) -> FourBar:
    """Dimensions of a machine's phase, from 0."""
    a0, a, b0, c = (complex(getattr(one.pins, name)[phase]) for name in ("a0", "a", "b0", "c"))
    side = PlaneSpace(0j).side(np.array(a), np.array(b0), np.array(c))
    return FourBar(abs(a - a0), abs(c - a), abs(c - b0), abs(b0 - a0), float(np.angle(b0 - a0)), int(side))


def start_of(one: Machine, k: int) -> float:
    """Crank angle of a phase in the pose of setting, rad."""
    return float(np.angle(one.pins.a[k] - one.pins.a0[k]))


def table_of(one: Machine, k: int, wanted: AdjustablePathRequirement) -> dict[str, object]:
    """The table ``[parameters]`` that shows a phase, from 0."""
    settable = wanted.moves == "moving"
    own = 0 if settable else k
    bar = bar_in(one, own)
    a0, a, c, p = (complex(getattr(one.pins, name)[own]) for name in ("a0", "a", "c", "p"))
    point = (p - a) * (c - a).conjugate() / abs(c - a)
    table: dict[str, object] = {
        **{name: round(getattr(bar, name), DIGITS) for name in LINKS},
        "ground_angle": math.degrees(bar.ground_angle),
        "branch": "open" if bar.branch > 0 else "crossed",
        "pivot_x": a0.real,
        "pivot_y": a0.imag,
        "coupler_point_x": point.real,
        "coupler_point_y": point.imag,
    }
    start = math.degrees(start_of(one, k))
    if wanted.full_turn:
        table["direction"] = "ccw" if one.theta[k][-1] > 0 else "cw"
    else:
        table |= {"swing_from": start, "swing_to": start + math.degrees(one.theta[k][-1])}
    if settable and len(one.theta) > 1:
        settings = settings_of(PlaneSpace(0j), one.pins)
        table["setting_angle"] = math.degrees(start_of(one, 0))
        table["phase"] = k + 1
        table["phases"] = [
            {"crank_turn": crank, "follower_turn": follower}
            for crank, follower in np.degrees([settings.crank, settings.follower]).T[1:].tolist()
        ]
    return table
