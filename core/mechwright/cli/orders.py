"""What is asked for of each of several designs, and what becomes of it: one that fails stops no other."""

import time
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from mechwright.contracts.file_names import file_key
from mechwright.contracts.finding import Finding, Findings, Severity, Stage, errors
from mechwright.contracts.refused import RefusedError
from mechwright.contracts.synthesis import Progress
from mechwright.errors import DesignError
from mechwright.pipeline import Wanted
from mechwright.plugins.host import host
from mechwright.scripting.mechanism import Mechanism
from mechwright.scripting.performing import Written


@dataclass(frozen=True)
class Order:
    """What is asked for of one design.

    Parameters
    ----------
    path, wanted
        The design file, and what is asked of it besides.
    folder
        Where its files go; None for a check.
    empty
        As of :func:`~mechwright.scripting.performing.perform`.
    to
        The last stage of a check, or None.
    """

    path: Path
    wanted: Wanted
    folder: Path | None = None
    empty: str = ""
    to: Stage | None = None


@dataclass(frozen=True)
class Outcome:
    """What has become of an order.

    Parameters
    ----------
    name
        Of the design; that of its file where this cannot be read.
    ok
        Whether it was done.
    seconds
        How long it took.
    said
        What was written and found.
    fault
        Why it could not be done, in a line, where no finding says so.
    """

    order: Order
    name: str
    ok: bool
    seconds: float
    said: Written
    fault: str = ""

    @property
    def reason(self) -> str:
        """In a line why it is refused, or what is left out."""
        if self.fault:
            return self.fault
        if not self.ok:
            return str(errors(self.said.findings)[0])
        return f"without {', '.join(self.said.missing)}" if self.said.missing else ""


def into(designs: Iterable[Path], folder: Path) -> dict[Path, Path]:
    """The folder of each design in that of all: by the stem of its file.

    Raises DesignError, before anything is done, where two designs would have the same one.
    """
    places: dict[str, Path] = {}
    for path in designs:
        other = places.setdefault(file_key(path.stem), path)
        if other is not path:
            raise DesignError(
                f"{other} and {path} would both be written into {folder / path.stem}; rename one, or run "
                "the command once for each with another -o"
            )
    return {path: folder / path.stem for path in places.values()}


def done(order: Order, progress: Progress) -> Outcome:
    """Do what an order asks for; whatever goes wrong is told, and raises nothing."""
    begun = time.perf_counter()
    name, ok, fault = order.path.stem, True, ""
    folder = order.folder or Path()
    said = Written(folder, (), Findings())
    try:
        with Mechanism(order.path, host(), order.wanted) as build:
            name = build.design.name
            if order.folder is None:
                findings = build.check(progress, order.to)
                said, ok = Written(folder, (), _sorted(findings)), not errors(findings)
            else:
                said = build.write(folder, progress, order.empty)
    except RefusedError as refused:
        said, ok = Written(folder, (), refused.findings), False
    except Exception as error:  # noqa: BLE001,RUF100 - a fault of one design stops no other
        from mechwright.cli.failure import lines

        ok, fault = False, " ".join(lines(error))
    return Outcome(order, name, ok, time.perf_counter() - begun, said, fault)


def _sorted(findings: Iterable[Finding]) -> Findings:
    order = list(Severity)
    return Findings(sorted(findings, key=lambda finding: order.index(finding.severity)))


def killed(order: Order, seconds: float) -> Outcome:
    """What has become of an order whose process is gone."""
    fault = f"{order.path}: its process was killed, mostly for want of memory; take fewer --workers"
    said = Written(order.folder or Path(), (), Findings())
    return Outcome(order, order.path.stem, False, seconds, said, fault)
