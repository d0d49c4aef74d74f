"""What a check has to say about a design."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from enum import StrEnum
from functools import wraps
from typing import Any, TypeVar

from mechwright.contracts.shown import html_table
from mechwright.errors import LONGEST, DesignError, MechwrightError, shortened

S = TypeVar("S")

Change = Mapping[str, Any]
"""A change of a design file: dotted key, such as ``"parameters.ground"``, to its value (None: left out)."""


class Severity(StrEnum):
    """How grave a finding is."""

    ERROR = "error"
    """The part would be wrong or cannot be made: nothing is built."""
    WARNING = "warning"
    """It can be built, but an engineer should look."""
    NOTE = "note"
    """A figure worth knowing."""


class Stage(StrEnum):
    """What a finding is about, in the order of the work: an error stops its stage and the later ones."""

    MOTION = "motion"
    """Whether and how the mechanism moves: closure, assembly, a law that can be run."""
    PARTS = "parts"
    """Whether each part can be made: undercut, thin walls, strength, hardware."""
    ASSEMBLY = "assembly"
    """Whether the parts go together: collisions, contacts, screws, the drive."""
    MACHINING = "machining"
    """Whether they can be milled so: cutters, holding, stock, machine, control, the proof of each program."""
    OUTPUT = "output"
    """Whether the mechanism runs with its parts as they are made, and all files can be written."""

    def is_after(self, other: "Stage") -> bool:
        """Whether the work comes to this stage later than to another one.

        >>> Stage.PARTS.is_after(Stage.MOTION), Stage.PARTS.is_after(Stage.PARTS)
        (True, False)
        """
        order = list(Stage)
        return order.index(self) > order.index(other)


@dataclass(frozen=True, slots=True)
class Finding:
    """One result of a check.

    Parameters
    ----------
    code
        Stable, dotted, lower-case name of the check (``"gear.undercut"``).
    severity
        Error, warning or note.
    parameter
        The design-file key it is about (``"teeth"``, ``"cam.tools"``); empty if none.
    message
        One sentence that says what was found.
    value, limit
        The number found and the one it is compared with, in ``unit``; None where there is none.
    unit
        Unit of both.
    remedy
        What to do, in words; empty for a note.
    stage
        What it is about; by default the motion, whose errors stop everything.
    proposed
        Changes that should help, best first, from whoever knows the number. They are promises to nobody:
        the host tries them (:mod:`mechwright.remedies`) and looks on where none of them helps.
    fix
        The change that was tried: with it this finding is gone and no new error stands. None as long as
        nothing was tried, or where nothing helped; a check leaves it to the host.
    """

    code: str
    severity: Severity
    parameter: str
    message: str
    value: float | None = None
    limit: float | None = None
    unit: str = ""
    remedy: str = ""
    stage: Stage = Stage.MOTION
    proposed: tuple[Change, ...] = field(default=(), hash=False)
    fix: Change | None = field(default=None, hash=False)

    def __post_init__(self) -> None:
        for name in ("parameter", "message", "remedy"):
            said = getattr(self, name)
            if len(said) > LONGEST:
                object.__setattr__(self, name, shortened(said))

    @classmethod
    def error(
        cls,
        code: str,
        parameter: str,
        message: str,
        value: float | None = None,
        limit: float | None = None,
        unit: str = "",
        remedy: str = "",
        stage: Stage = Stage.MOTION,
        proposed: tuple[Change, ...] = (),
    ) -> "Finding":
        """An error; the arguments are those of the class."""
        return cls(code, Severity.ERROR, parameter, message, value, limit, unit, remedy, stage, proposed)

    @classmethod
    def warning(
        cls,
        code: str,
        parameter: str,
        message: str,
        value: float | None = None,
        limit: float | None = None,
        unit: str = "",
        remedy: str = "",
        stage: Stage = Stage.MOTION,
        proposed: tuple[Change, ...] = (),
    ) -> "Finding":
        """A warning; the arguments are those of the class."""
        return cls(code, Severity.WARNING, parameter, message, value, limit, unit, remedy, stage, proposed)

    @classmethod
    def note(cls, code: str, message: str, value: float | None = None, unit: str = "") -> "Finding":
        """A figure worth knowing: about no parameter, compared with nothing, nothing to do."""
        return cls(code, Severity.NOTE, "", message, value, unit=unit)

    def __str__(self) -> str:
        where = f"{self.parameter}: " if self.parameter else ""
        cure = f"; {self.remedy}" if self.remedy else ""
        return f"{self.severity} [{self.code}] {where}{self.message}{cure}"

    def __repr__(self) -> str:
        return f"<Finding {self}>"

    def as_dict(self) -> dict[str, Any]:
        """Give the finding as plain data for JSON; what was proposed and not tried is left out."""
        data = asdict(self)
        del data["proposed"]
        return data


class Findings(tuple[Finding, ...]):
    """Findings in their order; notebooks show them as a table.

    >>> Findings([Finding.note("gear.mass", "a gear weighs 215 g", 215.0, "g")])
    (<Finding note [gear.mass] a gear weighs 215 g>)
    """

    __slots__ = ()

    @property
    def errors(self) -> "Findings":
        """Those that forbid something."""
        return Findings(one for one in self if one.severity is Severity.ERROR)

    def __repr__(self) -> str:
        return "(" + ",\n ".join(map(repr, self)) + ")"

    def _repr_html_(self) -> str:
        rows = ([one.severity, one.code, one.parameter, one.message, one.remedy] for one in self)
        return html_table(["severity", "code", "parameter", "finding", "remedy"], rows)


def errors(findings: Iterable[Finding], stage: Stage = Stage.OUTPUT) -> list[Finding]:
    """Give the findings that forbid a stage: errors of it and of earlier stages; by default all errors."""
    return [one for one in findings if one.severity is Severity.ERROR and not one.stage.is_after(stage)]


def at_stage(stage: Stage, findings: Iterable[Finding]) -> list[Finding]:
    """Give the findings with a stage of their own."""
    return [replace(finding, stage=stage) for finding in findings]


def of_stage(
    stage: Stage,
) -> Callable[[Callable[[S], Iterable[Finding]]], Callable[[S], Iterator[Finding]]]:
    """Decorate a check all of whose findings are about one stage.

    Examples
    --------
    ::

        @of_stage(Stage.PARTS)
        def walls(params: ScotchYokeParams) -> Iterator[Finding]: ...
    """

    def decorate(check: Callable[[S], Iterable[Finding]]) -> Callable[[S], Iterator[Finding]]:
        @wraps(check)
        def staged(subject: S) -> Iterator[Finding]:
            yield from at_stage(stage, check(subject))

        return staged

    return decorate


def refuse(
    findings: Iterable[Finding],
    stage: Stage = Stage.OUTPUT,
    kind: type[MechwrightError] = DesignError,
) -> None:
    """Raise the first error that forbids a stage, as an error of a kind; do nothing if there is none."""
    for finding in errors(findings, stage):
        raise kind(f"{finding.parameter}: {finding.message}; {finding.remedy}")
