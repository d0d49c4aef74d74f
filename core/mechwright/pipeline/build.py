"""What has been made of a design so far. Whoever needs a thing asks the build; it is made once, and kept."""

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, TypeVar, cast

from mechwright.contracts.guard import is_foreign
from mechwright.contracts.sampling import SAMPLES
from mechwright.errors import GeometryError, KinematicsError, MechwrightError, PluginFaultError
from mechwright.pipeline.work import LOOK, WORK, Work

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    import cadquery as cq

    from mechwright.contracts.finding import Finding, Findings
    from mechwright.contracts.motion import Motion
    from mechwright.contracts.named import Named
    from mechwright.contracts.part import Part
    from mechwright.designs.design import Design
    from mechwright.pipeline.proven import Proven
    from mechwright.plugins.host import Host

T = TypeVar("T")


@dataclass(frozen=True)
class Wanted:
    """What a person asks of a build besides the design.

    Parameters
    ----------
    command
        The command that is run; pages say which ones they belong to.
    samples
        Of the motion over one period.
    at
        Where the assembly stands, as ``"40 deg"``; empty for the start of the motion.
    formats
        Names of exporters whose files are wanted besides.
    curves
        Kind of curves in drawings.
    work
        How far the run goes, and what it makes; None leaves it to the command.
    """

    command: str = "build"
    samples: int = SAMPLES
    at: str = ""
    formats: tuple[str, ...] = ()
    curves: str = "spline"
    work: Work | None = None

    @property
    def extent(self) -> Work:
        """How far the run goes; of a command that is not known all is looked at, and nothing made for it."""
        return WORK.get(self.command, LOOK) if self.work is None else self.work


class Build:
    """A design on its way from parameters to files.

    Rooms that make more of a design than the core knows of keep their results here as well, see :meth:`made`.
    A build is closed when it is done with, so that what runs beside it ends.

    Parameters
    ----------
    design
        The design, or its file, which is then read when it is first asked for.
    host
        What is installed.
    wanted
        What is asked for besides.
    """

    def __init__(self, design: "Design | Path", host: "Host", wanted: Wanted = Wanted()) -> None:
        self.host, self.wanted = host, wanted
        self.path = design if isinstance(design, Path) else design.path
        self.faults: list[str] = []
        """What could not be done and stops nothing, in whole sentences; a command tells it at its end."""
        self.missing: list[str] = []
        """What is left out because of findings or faults that are told, each in a few words."""
        self.progress: Callable[[float], None] = lambda done: None  # noqa: ARG005
        """Told by work that takes long how far it is, 0 to 1."""
        self._given = design
        self._kept: dict[object, Any] = {}
        self._closing = ExitStack()

    def asking(self, **wanted: Any) -> Self:
        """The same design with other wishes; what does not depend on these is made once for both."""
        other = type(self)(self._given, self.host, replace(self.wanted, **wanted))
        other._kept = self._kept
        return other

    @property
    def design(self) -> "Design":
        """The design; raises what :func:`mechwright.designs.design.load` does."""
        if not isinstance(self._given, Path):
            return self._given
        from mechwright.designs.design import load

        given = self._given
        return self._once("design", lambda: load(given, self.host))

    @property
    def findings(self) -> "Findings":
        """What the family finds, and what there is to say of what stands around the mechanism."""
        from mechwright.contracts.finding import Findings

        return self._once("findings", lambda: Findings(self.design.check()))

    @property
    def motion(self) -> "Motion":
        """The motion, with as many samples as are wanted."""
        samples = self.wanted.samples
        return self._once(("motion", samples), lambda: self.design.solve(samples))

    def stretches(self) -> "Iterator[Motion]":
        """The same, a stretch after the other: nothing is kept of what is long, and short motions are one."""
        from mechwright.contracts.stretch import TOGETHER

        if self.wanted.samples <= TOGETHER:
            return iter((self.motion,))
        return self.design.stretches(self.wanted.samples)

    @property
    def parts(self) -> "Named[Part]":
        """The parts, with what the design file asks of them; raises what :meth:`Design.parts` does."""
        from mechwright.contracts.named import Named

        return self._once("parts", lambda: Named(self.design.parts()))

    def result(self, name: str) -> Any:
        """What a plugin makes of this build, see :class:`~mechwright.contracts.result.Result`; made once.

        Raises PluginError where nobody makes it.
        """
        from mechwright.contracts.result import Result, maker

        known = {one.name: one for one in self.host.all(Result)}
        return self.made(maker(self, name, known).make)

    @property
    def assembly(self) -> "cq.Assembly":
        """All parts in their places, an assembly of CadQuery; it stands where ``wanted.at`` says.

        Raises GeometryError where it cannot be made, PluginError where nothing is installed that makes it.
        """
        whole: cq.Assembly = self.result("assembly")
        return whole

    @property
    def programs(self) -> "Named[Proven]":
        """The proven programs by the names of their parts, as ``mechwright cam`` writes them.

        Raises
        ------
        RefusedError
            A finding forbids them.
        ToolError
            A cutter that the work needs is not there.
        ProofError
            A program would not cut the right part.
        PluginError
            Nothing is installed that makes programs.
        """
        programs: Named[Proven] = self.result("programs")
        return programs

    def require(self, findings: "Iterable[Finding] | None" = None) -> None:
        """Do nothing if no finding is an error, by default of the family; raises RefusedError with them."""
        from mechwright.contracts.finding import errors
        from mechwright.contracts.refused import RefusedError

        if stopping := errors(self.findings if findings is None else findings):
            raise RefusedError(self.path, stopping)

    def leave_out(self, what: str, error: "MechwrightError") -> None:
        """Note in a few words what there cannot be; the reason is told once, and not if a finding told it."""
        self.missing.append(what)
        known = [f"{one.parameter}: {one.message}; {one.remedy}" for one in self.findings]
        if str(error) not in (*known, *self.faults):
            self.faults.append(str(error))

    @cached_property
    def pose(self) -> "tuple[Motion, int]":
        """A motion, and the sample of it that the assembly shows; raises DesignError for a wrong ``--at``."""
        from mechwright.pipeline import pose

        if not self.wanted.at:
            return self.design.solve(2), 0
        motion = self.design.solve(pose.SAMPLES)
        return motion, pose.sample_at(motion, self.wanted.at)

    def made(self, make: "Callable[[Build], T]") -> T:
        """What ``make`` makes of this build, such as a class that takes a build; made once, then kept.

        It must not depend on what is wanted besides the design; see :meth:`made_as_wanted`.
        """
        return self._once(make, lambda: make(self))

    def made_as_wanted(self, make: "Callable[[Build], T]") -> T:
        """What ``make`` makes of this build and of what is wanted besides, made once for the same wishes."""
        return self._once((make, self.wanted), lambda: make(self))

    def _once(self, key: object, make: "Callable[[], T]") -> T:
        if key not in self._kept:
            self._kept[key] = make()
        return cast("T", self._kept[key])

    def when_closed(self, close: Callable[[], object]) -> None:
        """Have something called when the build is closed."""
        self._closing.callback(close)

    def close(self) -> None:
        """End what still runs beside the build."""
        self._closing.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        self.close()
        said = isinstance(error, (PluginFaultError, GeometryError, KinematicsError)) or (
            isinstance(error, MechwrightError) and is_foreign(str(error))
        )
        if error is not None and said and str(self.path) not in str(error):
            error.args = (f"{self.path}: {error}",)
