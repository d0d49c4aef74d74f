"""Designs that meet a requirement, sought and written."""

import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import Any

from mechwright.contracts.family import Family
from mechwright.contracts.finding import Severity, errors
from mechwright.contracts.part import check_name
from mechwright.contracts.refused import RefusedError
from mechwright.contracts.shown import html_table
from mechwright.contracts.synthesis import Progress, Synthesis, unheard
from mechwright.designs.change import changed
from mechwright.designs.files import digest_of, read_bytes
from mechwright.designs.requirement import Requirement, load_requirement, requirement_of
from mechwright.designs.schema import FORMAT
from mechwright.output.folder import Output, write_folder
from mechwright.plugins.host import Host, host
from mechwright.reading import once
from mechwright.scripting.buildable import Buildable, found_buildable
from mechwright.scripting.changes import change_of
from mechwright.scripting.gallery import gallery, shown
from mechwright.scripting.mechanism import Mechanism
from mechwright.scripting.provenance import run_facts


@dataclass(frozen=True, repr=False)
class Found:
    """What a synthesis has found: a sequence of mechanisms, best first.

    Parameters
    ----------
    asked
        The requirement.
    buildable
        The candidates with their designs, what there is to say of each, and why others were not given.
    host
        What is installed.
    """

    asked: Requirement
    buildable: Buildable
    host: Host

    @property
    def result(self) -> Synthesis[Any]:
        """The candidates with their figures, what there is to say, and why others were not given."""
        return self.buildable.result

    def __len__(self) -> int:
        return len(self.result.candidates)

    def __getitem__(self, place: int) -> Mechanism:
        return self.mechanisms[place]

    def __iter__(self) -> Iterator[Mechanism]:
        return iter(self.mechanisms)

    def __repr__(self) -> str:
        return f"<Found {self.told}>"

    def _repr_html_(self) -> str:
        shown = [candidate.shown for candidate in self.result.candidates]
        columns = list(dict.fromkeys(name for figures in shown for name in figures))
        rows = (
            [name, *(figures.get(column, "") for column in columns)]
            for (name, _), figures in zip(self.texts, shown, strict=True)
        )
        return f"<p>{self.told}</p>" + html_table(["design", *columns], rows)

    @cached_property
    def texts(self) -> list[tuple[str, str]]:
        """Name and text of the design file of each candidate."""
        found, width = [], len(str(len(self)))
        for number, candidate in enumerate(self.result.candidates, start=1):
            name = check_name(f"{self.asked.name}-{number:0{width}}", "name of a design")
            found.append((name, self.asked.text(name, candidate.params)))
        return found

    @cached_property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        """The designs, best first; files that their tables name stand where the requirement's do."""
        named = zip(self.buildable.designs, self.texts, strict=True)
        return tuple(
            Mechanism(
                replace(
                    design,
                    name=name,
                    path=self.asked.path.with_name(f"{name}.toml"),
                    content={**design.content, "name": name},
                ),
                self.host,
            )
            for design, (name, _) in named
        )

    @property
    def told(self) -> str:
        """How many designs were found and are given, and why the others are not."""
        given, rejected = len(self), self.result.rejected
        why = ", ".join(map(str, rejected))
        found = given + sum(reason.count for reason in rejected)
        return f"{found} found, {given} given" + (f": {why}" if why else "")

    def gallery(self, minutes: bool = False) -> str:
        """A page with a moving picture of each design and its path, and what they are compared by.

        With ``minutes`` these are those on the mill as well: programs of all designs are made and proven.
        """
        family, result = self.asked.family, self.result
        notes = [finding for finding in result.findings if finding.severity is not Severity.ERROR]
        targets = family.targets(self.asked.kind, self.asked.table)
        designs = shown(result.candidates, self.mechanisms, minutes, targets)
        return gallery(self.asked.name, family.title, self.told, result.rejected, notes, designs)

    def require(self) -> None:
        """Do nothing if designs meet the requirement, else raise RefusedError with the reason."""
        if stopping := errors(self.result.findings):
            raise RefusedError(self.asked.path, stopping)

    @cached_property
    def summary(self) -> dict[str, Any]:
        """What ``synthesis.json`` holds."""
        family = self.asked.family
        listing = [
            {
                "design": f"{name}.toml",
                **candidate.as_dict(),
                "findings": [finding.as_dict() for finding in found],
            }
            for (name, _), candidate, found in zip(
                self.texts, self.result.candidates, self.buildable.findings, strict=True
            )
        ]
        return {
            "family": family.name,
            "kind": self.asked.kind,
            "requirement": self.asked.table.model_dump(mode="json"),
            "findings": [finding.as_dict() for finding in self.result.findings],
            "rejected": [asdict(reason) for reason in self.result.rejected],
            "candidates": listing,
        }

    def write(self, folder: str | Path, minutes: bool = False) -> tuple[str, ...]:
        """Write a design file each, ``gallery.html`` and ``synthesis.json``; gives the names of the files.

        With ``minutes`` the gallery compares the minutes on the mill as well.

        Raises RefusedError where no design meets the requirement, OutputError where the folder cannot be
        written; nothing is written then.
        """
        self.require()
        asked, output = self.asked, Output()
        with once():
            inputs = {name: digest_of(read_bytes(file)) for name, file in asked.inputs.items()}
            for name, file in asked.files.items():
                output.add(name, read_bytes(file))
        for name, text in self.texts:
            output.add(f"{name}.toml", text)
        if len(self):
            output.add("gallery.html", self.gallery(minutes))
        output.add("synthesis.json", json.dumps(self.summary, indent=2) + "\n")
        facts = run_facts(asked.name, asked.family, {asked.path.name: asked.digest, **inputs}, self.host)
        write_folder(Path(folder), output, "synthesize", facts)
        return tuple(sorted(output.files))


def synthesize(
    requirement: str | PathLike[str],
    kind: str = "",
    /,
    *,
    name: str = "",
    progress: Progress = unheard,
    **asked: object,
) -> Found:
    """Find designs that meet a requirement, best first.

    Parameters
    ----------
    requirement
        A requirement file; or a family as design files name it, with its requirement as keyword arguments.
    kind
        Of the requirement of a family, where it knows several.
    name
        Stem of the names of the designs; by default the family's.
    progress
        Told how far it is.
    asked
        The requirement of a family; a table, such as ``cam={"clearance": 8}``, goes into the designs.

    Raises
    ------
    DesignError
        The requirement is wrong, or the family has no synthesis of this kind.
    OutputError, PluginError
        The file cannot be read, the family is not installed.

    Examples
    --------
    >>> found = synthesize("slider-crank", "stroke", stroke=120, time_ratio=1.2)
    >>> found
    <Found 1 found, 1 given>
    >>> round(found[0].motion.scalars["stroke"].value, 6)
    120.0
    """
    installed = host()
    if not (kind or name or asked) and requirement not in installed.of(Family):
        return sought(load_requirement(Path(requirement), installed), installed, progress)
    family = installed.family(str(requirement))
    stem = name or family.name
    head = {"format": FORMAT, "family": family.name, "name": stem}
    table = {"requirement": {"kind": kind} if kind else {}}
    content = changed({**head, **table}, change_of(installed, asked, "requirement"))
    said = digest_of(json.dumps(content, indent=2, default=str))
    return sought(requirement_of(content, Path(f"{stem}.toml"), said, installed), installed, progress)


def sought(asked: Requirement, installed: Host, progress: Progress = unheard) -> Found:
    """What the family finds, without the designs that cannot be built as the requirement's tables say."""
    return Found(asked, found_buildable(asked, installed, progress), installed)
