"""The contract of a process, a way to make plates, and the key by which a design chooses one."""

from abc import abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from pydantic import Field

from mechwright.contracts.finding import Finding, Stage, errors
from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.plugin import Plugin
from mechwright.contracts.table import Table
from mechwright.designs.tables import read_table
from mechwright.designs.text import table_lines, toml
from mechwright.errors import DesignError, MechwrightError, did_you_mean
from mechwright.pipeline.build import Build
from mechwright.pipeline.inspection import Inspection

if TYPE_CHECKING:
    from mechwright.contracts.made_part import MadePart
    from mechwright.contracts.part import Part
    from mechwright.designs.design import Design

MILL = "mill"
"""The process of what a design says nothing of."""


@dataclass(frozen=True, slots=True)
class Spread:
    """How far plates of a process stray from one to the next, mm.

    Parameters
    ----------
    size
        Of a length between two walls, plus and minus.
    taper
        Largest difference of such a length between the faces.
    play, scatter
        What a joint has besides its own play, on the diameter, and that plus and minus: of holes that the
        process makes wider than drawn.
    """

    size: float
    taper: float = 0.0
    play: float = 0.0
    scatter: float = 0.0

    @property
    def wall(self) -> float:
        """By how much one wall may be off, mm: half of what two have, at the face where it is worst."""
        return (self.size + self.taper) / 2


class Process(Plugin):
    """A way to make the plates of a design, such as milling: its name is what ``process`` says."""

    kind = "process"
    plural = "processes"

    title: ClassVar[str]
    """What it is called in a sentence, such as "laser cutting"."""

    @abstractmethod
    def refuses(self, part: "Part", build: Build) -> str | None:
        """Why it cannot make a plate, in a clause such as "its pocket has a floor"; None where it can."""

    def objections(self, part: "Part", build: Build) -> Sequence[Finding]:  # noqa: ARG002 - for those with rules
        """What its rules find of a plate, whether or not the design has chosen it; by default nothing.

        Where an error has a remedy, the plate can be made with it. It is asked of refused plates, too: a
        reason that is told here is not told a second time.
        """
        return ()

    def loses(self, part: "Part", build: Build) -> Sequence[str]:  # noqa: ARG002 - for those that know
        """What the plate has less of than as drawn, each in a few words; by default nothing."""
        return ()

    by_material: ClassVar[bool] = False
    """Whether what it leaves on a wall differs by material and thickness, as a kerf does."""

    def spread(self, part: "Part", build: Build) -> Spread | None:  # noqa: ARG002 - for those that know
        """How far the plate strays; None, the default, where a proof bounds its walls."""
        return None

    def produced(self, part: "Part", build: Build) -> "Sequence[MadePart]":  # noqa: ARG002 - for those that know
        """Each copy of a plate as its program leaves it; by default nothing, and nothing is judged by it."""
        return ()

    def correction(self, off: float, walls: str, part: "Part", build: Build) -> str:  # noqa: ARG002
        """What to set for the next piece where stock stays on each wall, as a clause.

        Parameters
        ----------
        off
            That stock, mm; below 0 the walls are cut too deep.
        walls
            Of which ones: ``"all"``, ``"inside"`` or ``"outside"``.
        part
            One of those that were measured.
        build
            Whose design says how it is made.
        """
        return f"move the walls by {-off:+.4f} mm"

    def seconds(self, part: "Part", build: Build) -> float | None:  # noqa: ARG002 - for those that know
        """How long it takes for one piece by estimate; None, the default, where nothing gives it."""
        return None

    untimed: ClassVar[str] = "not known"
    """What gives the time of a plate without an estimate, such as "by the service", in place of one."""


class ProcessSettings(Parameters):
    """The keys of the table ``[process]``."""

    default: str = Field(MILL, description="The process of all plates of which `parts` says nothing.")
    parts: dict[str, str] = Field({}, description="Part name to the process of that plate.")


class ProcessTable(Table[ProcessSettings]):
    """Reads ``process = "laser"`` in the head of a file, or a table ``[process]``."""

    name = "process"
    settings = ProcessSettings

    def read(self, content: object, path: Path) -> ProcessSettings:
        """The processes; one name stands for all plates."""
        return read_table(
            ProcessSettings,
            {"default": content} if isinstance(content, str) else content,
            str(path),
            self.name,
        )

    def text(self, value: ProcessSettings | None = None) -> list[str]:
        """A table where single plates have processes of their own; else the key in the head is all."""
        return [] if value is None or not value.parts else table_lines(ProcessSettings, self.name, value)

    def head(self, value: ProcessSettings | None = None) -> list[str]:
        """The key, where all plates are made alike by another process than milling."""
        plain = value is None or value.parts or value.default == MILL
        return [] if value is None or plain else [f"process = {toml(value.default)}"]

    def schema(self) -> dict[str, Any]:
        """A name, or a table."""
        name = {"type": "string", "description": "The process by which all plates are made. Default: mill."}
        return {"anyOf": [name, model_schema(ProcessSettings)]}

    def parts(self, value: ProcessSettings, parts: "Sequence[Part]", path: Path) -> "Sequence[Part]":
        """The same parts; raises DesignError for the process of what is no plate of the design."""
        plates = [part.name for part in plates_of(parts)]
        for name in value.parts:
            if name not in plates:
                hint = did_you_mean(name, plates) or f"there is: {', '.join(plates)}"
                raise DesignError(f"{path}: process.parts.{name}: no plate has this name; {hint}")
        return parts


def plates_of(parts: "Iterable[Part]") -> "list[Part]":
    """The parts that are made of a plate."""
    return [part for part in parts if part.outline is not None and part.bought is None]


def process_of(design: "Design", part: str) -> str:
    """The name of the process by which a plate of a design is made."""
    said: ProcessSettings = design.table(ProcessTable)
    return said.parts.get(part, said.default)


def plates_by(design: "Design", parts: "Iterable[Part]", process: str) -> "list[Part]":
    """The plates among some parts of a design that are made by a process."""
    return [part for part in plates_of(parts) if process_of(design, part.name) == process]


class ChosenProcesses(Inspection):
    """Whether the process that is chosen for each plate is installed, and can make it."""

    name = "processes"
    stage = Stage.MACHINING
    order = 15
    doing = "drawings and programs"

    def findings(self, build: Build) -> Sequence[Finding]:
        """An error for each plate that its process cannot make."""
        return [*_refused(build)]


def _refused(build: Build) -> Iterator[Finding]:
    known = {one.name: one for one in build.host.all(Process)}
    said: ProcessSettings = build.design.table(ProcessTable)
    for part in plates_of(build.parts):
        name, own = process_of(build.design, part.name), part.name in said.parts
        key = f"process.parts.{part.name}" if own else "process"
        if name not in known:
            if own or name != MILL:  # without milling, nothing of it is asked for
                hint = did_you_mean(name, known) or f"there is: {', '.join(sorted(known))}"
                lack = f"no process is named {name!r}; {hint}"
                yield Finding.error("process.unknown", key, lack, stage=Stage.MACHINING)
        elif (why := known[name].refuses(part, build)) and not _is_told(known[name], part, build, why):
            able = _able(known.values(), part, build)
            yield Finding.error(
                "process.refused",
                key,
                f"{known[name].title} does not make {part.name}: {why}",
                remedy=_remedy(build.design, part.name, able),
                stage=Stage.MACHINING,
            )


def _is_told(process: Process, part: "Part", build: Build, why: str) -> bool:
    """Whether the rules of the process tell the reason themselves, with a remedy of their own."""
    try:
        return any(one.message == why for one in errors(process.objections(part, build)))
    except MechwrightError:
        return False


def _able(processes: "Iterable[Process]", part: "Part", build: Build) -> list[str]:
    """Processes that make a plate: first those that need no other key, and of these what loses least."""
    ranked = []
    for one in processes:
        if not one.refuses(part, build):
            try:
                wrong, lost = errors(one.objections(part, build)), len(one.loses(part, build))
            except MechwrightError:  # such as a table of its own that cannot be obeyed
                continue
            ranked.append((bool(wrong), lost, one.name))
    needless = [name for wrong, _, name in sorted(ranked) if not wrong]
    return needless or [name for _, _, name in sorted(ranked)]


def _remedy(design: "Design", part: str, able: "Sequence[str]") -> str:
    """The line for the first process, and the names of the others."""
    if not able:
        return "no other process that is installed makes it either; change the part"
    others = " or ".join(toml(name) for name in able[1:])
    return _line(design, part, able[0]) + (f', or {others} in place of "{able[0]}"' if others else "")


def _line(design: "Design", part: str, process: str) -> str:
    """The line that gives one more plate a process of its own."""
    said: ProcessSettings = design.table(ProcessTable)
    parts = {**said.parts, part: process}
    own = ", ".join(f"parts.{name} = {toml(of)}" for name, of in parts.items())
    return f"process = {{ default = {toml(said.default)}, {own} }}"
