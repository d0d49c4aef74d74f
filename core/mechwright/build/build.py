"""What has been made of a design so far. Whoever needs a thing asks the build; it is made once, and kept."""

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, cast

if TYPE_CHECKING:
    from collections.abc import Sequence

    from mechwright.contracts.finding import Finding
    from mechwright.contracts.motion import Motion
    from mechwright.contracts.part import Part
    from mechwright.designs.design import Design
    from mechwright.errors import MechwrightError
    from mechwright.plugins.host import Host

T = TypeVar("T")

SAMPLES = 721
"""Default number of samples of a motion: every half degree of one turn, both ends included."""


@dataclass(frozen=True)
class Wanted:
    """What a person asks of a build besides the design.

    Parameters
    ----------
    command
        The command that is run; pages and inspections say which ones they belong to.
    samples
        Of the motion over one period.
    at
        Where the assembly stands, as ``"40 deg"``; empty for the start of the motion.
    formats
        Names of exporters whose files are wanted besides.
    curves
        Kind of curves in drawings.
    """

    command: str = "build"
    samples: int = SAMPLES
    at: str = ""
    formats: tuple[str, ...] = ()
    curves: str = "spline"


class Build:
    """A design on its way from parameters to files.

    Parameters
    ----------
    design
        The design, or its file, which is then read when it is first asked for.
    host
        What is installed.
    wanted
        What is asked for besides.

    Rooms that make more of a design than the core knows of keep their results here as well, see :meth:`made`.
    A build is closed when it is done with, so that what runs beside it ends.
    """

    def __init__(self, design: "Design | Path", host: "Host", wanted: Wanted = Wanted()) -> None:
        self.host, self.wanted = host, wanted
        self.path = design if isinstance(design, Path) else design.path
        self.faults: list[str] = []
        """What could not be done and stops nothing, in whole sentences; a command tells it at its end."""
        self.missing: list[str] = []
        """What is left out because of findings or faults that are told, each in a few words."""
        self._given = design
        self._kept: dict[Callable[[Build], Any], Any] = {}
        self._closing = ExitStack()

    @cached_property
    def design(self) -> "Design":
        """The design; raises what :func:`mechwright.designs.design.load` does."""
        from mechwright.designs.design import load

        return load(self._given, self.host) if isinstance(self._given, Path) else self._given

    @cached_property
    def findings(self) -> "tuple[Finding, ...]":
        """What the family finds, and what there is to say of what stands around the mechanism."""
        return self.design.check()

    @cached_property
    def motion(self) -> "Motion":
        """The motion, with as many samples as are wanted."""
        return self.design.solve(self.wanted.samples)

    @cached_property
    def parts(self) -> "Sequence[Part]":
        """The parts, with what the design file asks of them; raises what :meth:`Design.parts` does."""
        return self.design.parts()

    def leave_out(self, what: str, error: "MechwrightError") -> None:
        """Note in a few words what there cannot be; the reason is told once, and not if a finding told it."""
        self.missing.append(what)
        known = [f"{one.parameter}: {one.message}; {one.remedy}" for one in self.findings]
        if str(error) not in (*known, *self.faults):
            self.faults.append(str(error))

    @cached_property
    def pose(self) -> "tuple[Motion, int]":
        """A motion, and the sample of it that the assembly shows; raises DesignError for a wrong ``--at``."""
        from mechwright.build import pose

        if not self.wanted.at:
            return self.design.solve(2), 0
        motion = self.design.solve(pose.SAMPLES)
        return motion, pose.sample_at(motion, self.wanted.at)

    def made(self, make: "Callable[[Build], T]") -> T:
        """What ``make`` makes of this build, such as a class that takes a build; made once, then kept."""
        if make not in self._kept:
            self._kept[make] = make(self)
        return cast("T", self._kept[make])

    def when_closed(self, close: Callable[[], object]) -> None:
        """Have something called when the build is closed."""
        self._closing.callback(close)

    def close(self) -> None:
        """End what still runs beside the build."""
        self._closing.close()

    def __enter__(self) -> "Build":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
