"""What a proof says."""

import math
from dataclasses import asdict, dataclass, field
from typing import Any

from mechwright.contracts.shown import html_table
from mechwright.errors import ProofError


@dataclass(frozen=True, slots=True)
class Check:
    """One question that the proof asked."""

    passed: bool
    """The answer."""
    message: str
    """One line: what is wrong, where, the limit, what to do; for a pass, what was found."""
    line: int | None = None
    """Line of the program text, None where no single line is to blame."""
    value: float | None = None
    limit: float | None = None
    """What was found and what is allowed, in ``unit``."""
    unit: str = ""
    at: tuple[float, float, float] | None = None
    """Place in work coordinates, mm."""
    told: bool = False
    """Whether a pass is worth a remark: what was found forbids nothing, and is not as usual."""
    name: str = ""
    """That of the rule that asked (``"gouge"``, ``"length-offset"``), which the proof fills in."""
    file: int = 0
    """Of a program in several files, the place of the one that has the line."""


@dataclass(frozen=True, slots=True)
class Spot:
    """Stock that stays on the part: its deepest place, its depth normal to the wall and its area, mm."""

    x: float
    y: float
    z: float
    depth: float
    area: float


@dataclass(frozen=True, slots=True)
class OperationTime:
    """Time and path of one operation, s and mm; ``cutting_s`` is what of the time is spent at a feed."""

    name: str
    tool: int
    time_s: float
    cutting_mm: float
    cutting_s: float = 0.0


@dataclass(frozen=True)
class Proof:
    """The result of a simulation."""

    part: str
    """Name of the part."""
    checks: dict[str, Check]
    """Name to answer, in the order they were asked."""
    gouge_max_mm: float
    """Deepest cut into the finished part or its tabs."""
    leftover_reachable_max_mm: float
    """Thickest stock left on a wall that a cutter of the program could have reached."""
    unreachable_area_mm2: float
    unreachable_max_mm: float
    """Stock that no cutter of the program reaches: area seen from above, and greatest depth."""
    unreachable: tuple[Spot, ...]
    """Where that is, deepest first; at most :data:`mechwright_cam.proof.unreachable_stock.SPOTS`."""
    rapids_in_stock: int
    """Number of rapid moves that meet material."""
    time_estimate_s: float
    """See :mod:`mechwright_cam.proof.timing`."""
    cutting_length_mm: float
    """Length of all feed moves."""
    operations: tuple[OperationTime, ...] = ()
    """In program order."""
    notes: tuple[str, ...] = field(default=())
    """Remarks that forbid nothing."""

    def __repr__(self) -> str:
        said = "proven" if self.ok else f"fails: {', '.join(check.name for check in self.failures)}"
        return (
            f"<Proof of {self.part}: {said}, {len(self.checks)} checks, {self.time_estimate_s / 60:.3g} min>"
        )

    def _repr_html_(self) -> str:
        rows = (
            [check.name, "passed" if check.passed else "failed", check.message]
            for check in self.checks.values()
        )
        return html_table(["check", "result", "what was found"], rows)

    @property
    def failures(self) -> tuple[Check, ...]:
        """The checks that did not pass, in the order of the lines that they name.

        A cause comes before its effects; those that blame no line come last.
        """
        failed = [check for check in self.checks.values() if not check.passed]
        return tuple(sorted(failed, key=lambda check: (check.line is None, check.file, check.line or 0)))

    @property
    def ok(self) -> bool:
        """Whether the program may be written."""
        return not self.failures

    @property
    def tool_times_s(self) -> dict[int, float]:
        """T number to its time, s."""
        return self._by_tool("time_s")

    @property
    def tool_cutting_s(self) -> dict[int, float]:
        """T number to its time at a feed, s: what wears its edges."""
        return self._by_tool("cutting_s")

    def _by_tool(self, name: str) -> dict[int, float]:
        times: dict[int, float] = {}
        for operation in self.operations:
            times[operation.tool] = times.get(operation.tool, 0.0) + getattr(operation, name)
        return times

    def require(self) -> None:
        """Do nothing if the program is proven.

        Raises
        ------
        ProofError
            One line: the first failure, and how many more there are.
        """
        failures = self.failures
        if failures:
            more = f" (and {len(failures) - 1} more: {', '.join(c.name for c in failures[1:])})"
            raise ProofError(
                f"the program of {self.part} fails its proof [{failures[0].name}]: {failures[0].message}"
                + (more if len(failures) > 1 else "")
            )

    def as_dict(self) -> dict[str, Any]:
        """Plain data for ``proof.json``; lengths to a tenth of a micrometre."""
        data = asdict(self)
        data["checks"] = {
            name: {key: value for key, value in check.items() if _says(key, value)}
            for name, check in data["checks"].items()
        }
        data["tool_times_s"] = self.tool_times_s
        data["tool_cutting_s"] = self.tool_cutting_s
        plain: dict[str, Any] = _plain({"ok": self.ok, **data})
        return plain


def _says(key: str, value: Any) -> bool:
    """Whether a field of a check stands in ``proof.json``: its name is the key, and remarks are notes."""
    return key not in ("name", "told", "file") and value not in (None, "")


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return round(value, 4) if math.isfinite(value) else None
    return value
