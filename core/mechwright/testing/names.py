"""What the family contract asks of names: those of parts and bodies keep apart, and a design may have any."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest

from mechwright.contracts.exporter import Exporter
from mechwright.contracts.file_names import name_fault
from mechwright.contracts.part import Part, check_name
from mechwright.designs.design import Design, design_of
from mechwright.errors import DesignError, MechwrightError
from mechwright.geometry import Loop, Outline
from mechwright.pipeline import Build, FileName, Wanted
from mechwright.pipeline.file_names import FileNames, files_of
from mechwright.plugins.host import host

NEUTRAL = "name-that-nothing-has"
"""Of a design, with which those of other names are compared."""

TRIED = 5
"""Names of one design that are written in every format."""

_SQUARE = Outline(Loop.polygon([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]))


class NameTests:
    """The part of :class:`mechwright.testing.FamilyContract` that is about names."""

    def _file(self, design: Mapping[str, Any], folder: Path) -> Mapping[str, Any]:
        """The design file of an example."""
        raise NotImplementedError

    def test_any_name_of_the_design(self, design: Mapping[str, Any], tmp_path: Path) -> None:
        """A design that is called like a part, a body or a file of its own is written as others are."""
        content = self._file(design, tmp_path)
        whole = design_of({**content, "name": NEUTRAL}, tmp_path / "design.toml", "", host())
        names = design_names(whole)
        faults = name_faults(whole, names)
        bodies = [name for name in whole.solve(2).poses if name in names]
        rest = [name for name in names if name not in bodies]
        tried = dict.fromkeys((*spread(bodies, TRIED - 2), *spread(rest, 2)))
        faults += writing_faults(whole, tried, host().all(Exporter))
        assert not faults, "; ".join(faults)


def design_names(whole: Design) -> list[str]:
    """Names that a design can have and something of it has: bodies, parts, stems of its files."""
    stems = (one.name.partition(".")[0] for one in planned_files(whole))
    names = dict.fromkeys((*whole.solve(2).poses, *(part.name for part in whole.parts()), *stems))
    return [name for name in names if _can_be(name)]


def planned_files(whole: Design) -> list[FileName]:
    """The files of ``model`` in every format that is installed."""
    wanted = Wanted("model", formats=tuple(sorted(host().of(Exporter))))
    return files_of(Build(whole, host(), wanted), wanted)


def name_faults(whole: Design, names: Iterable[str]) -> list[str]:
    """What is wrong with the names of a design's files, whatever it is called."""
    files = planned_files(whole)
    found = [f"{one.name} {fault}" for one in files if (fault := name_fault(one.name))]
    for name in names:
        called = whole.changed({"name": name}, settle=False)
        assert called.name == name
        wanted = Wanted("model", formats=tuple(sorted(host().of(Exporter))))
        found += [f"{name}: {one}" for one in FileNames().findings(Build(called, host(), wanted))]
        for other in {name.upper(), name.capitalize()} - {name}:
            with pytest.raises(DesignError, match="cannot be a file name"):
                whole.changed({"name": other}, settle=False)
    return found


def writing_faults(whole: Design, names: Iterable[str], exporters: Iterable[Exporter]) -> list[str]:
    """Formats that hold the mechanism under a neutral name and not under one of these; parts are squares."""
    squares = [plain(part) for part in whole.parts()]
    motion, found = whole.solve(2), []
    names = list(names)
    for exporter in exporters:
        if not exporter.takes_assemblies or not any(part.instances for part in squares):
            continue

        def refusal(name: str, exporter: Exporter = exporter) -> str:
            try:
                exporter.assembly(name, squares, motion)
            except MechwrightError as error:
                return str(error)
            return ""

        if not refusal(NEUTRAL):
            found += [f"{exporter.name}: {name}: {said}" for name in names if (said := refusal(name))]
    return found


def plain(part: Part) -> Part:
    """A square plate with the name and the places of a part: no solid of it takes any time."""
    return Part(part.name, _SQUARE, 1.0, "steel", part.instances, part.colour)


def spread(names: Sequence[str], count: int) -> list[str]:
    """So many of the names, from the first to the last.

    >>> spread("abcdefg", 3), spread("ab", 3), spread("", 2)
    (['a', 'd', 'g'], ['a', 'b'], [])
    """
    if len(names) <= count:
        return list(names)
    return [names[place * (len(names) - 1) // (count - 1)] for place in range(count)]


def _can_be(name: str) -> bool:
    try:
        return check_name(name) == name
    except DesignError:
        return False
