"""Design files: TOML text in, a checked design out.

A design file is data. It names a family, gives its parameters and says how the parts are made::

    format = 1
    family = "elliptic-gears"
    name = "elliptic-pair"

    [parameters]
    eccentricity = 0.4

    [cam]
    work_offset = "G54"
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from mechwright.contracts.family import Family
from mechwright.contracts.file_names import file_key
from mechwright.contracts.finding import Change, Finding, Stage, errors
from mechwright.contracts.fit_settings import Fits
from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.part import Part, check_name, name_from
from mechwright.contracts.table import Table
from mechwright.designs.chains import STAGE, chain_of, chain_params, stage_schema
from mechwright.designs.change import changed
from mechwright.designs.files import read_text, read_toml
from mechwright.designs.fits_table import FitsTable
from mechwright.designs.hints import homes, placed
from mechwright.designs.inches import Units, in_millimetres, told_in
from mechwright.designs.schema import FORMAT, HEAD
from mechwright.designs.settling import settled, told
from mechwright.designs.tables import read_table, unknown
from mechwright.designs.text import design_text
from mechwright.errors import DesignError, GeometryError, PluginError
from mechwright.mechanics.chain import Chain, ChainParams
from mechwright.plugins.host import Host
from mechwright.reading import once
from mechwright.shell import file_word

if TYPE_CHECKING:
    from mechwright.contracts.axial_stack import AxialStack
    from mechwright.contracts.motion import Motion
    from mechwright.contracts.surroundings import Surroundings

V = TypeVar("V")


@dataclass(frozen=True)
class Design:
    """A design file that has been read and found well-formed; its name can be a file name.

    Parameters
    ----------
    params
        The table ``[parameters]``.
    digest
        SHA-256 of the bytes of the file ``path``; empty for a design that no file holds.
    tables
        Name to value of every table that is registered; see :meth:`table`.
    readers
        Those tables.
    content
        What the file says, as plain data; lengths in mm and speeds in mm/min and m/min, whatever its units.
    units
        Those of its bare numbers.
    chosen
        Keys that the file leaves out, as what stands around the mechanism wants them; they are in ``params``.
    """

    name: str
    family: Family[Any]
    params: Parameters
    path: Path
    digest: str
    tables: Mapping[str, Any] = field(default_factory=dict)
    readers: tuple[Table[Any], ...] = ()
    content: Mapping[str, Any] = field(default_factory=dict)
    units: Units = "mm"
    chosen: Change = field(default_factory=dict)

    @property
    def own_tables(self) -> "dict[str, Parameters]":
        """The tables of its family by the dotted keys that lead to them; a chain has one for each stage."""
        if isinstance(self.params, ChainParams):
            stages = enumerate(self.params.stage, start=1)
            return {f"{STAGE}.{number}.parameters": one.parameters for number, one in stages}
        return {"parameters": self.params}

    def table(self, contract: type[Table[V]]) -> V:
        """The value of a registered table, by the class that reads it."""
        value: V = self.tables[contract.name]
        return value

    def __repr__(self) -> str:
        return f"<Design {self.name} of {self.path}: {self.family.name}>"

    @property
    def text(self) -> str:
        """A file that holds the design, every key with a comment."""
        tables = [(reader, self.tables[reader.name]) for reader in self.readers]
        return design_text(self.family, self.name, self.params, tables)

    def parts(self) -> Sequence[Part]:
        """The parts as the family gives them and what stands around, with what the tables ask of them.

        Raises GeometryError for a part that cannot be made, DesignError for what a table cannot have.
        """
        parts: Sequence[Part] = self.family.parts(self.params)
        for around in self.surroundings:
            parts = [*(part for part in parts if part.name not in around.replaces), *around.parts]
        keys = [file_key(part.name) for part in parts]
        for part, key in zip(parts, keys, strict=True):
            if keys.count(key) > 1:  # the family's own are known to differ
                raise GeometryError(
                    f"part {part.name!r} stands in the mechanism and around it, and both have its files; "
                    "leave out the table that adds the second"
                )
        from mechwright.mechanics.mating.fitted import with_fits

        if any(part.instances for part in parts):
            reverses = any(around.reverses for around in self.surroundings)
            parts = with_fits(parts, self.solve(2), self.tables.get(FitsTable.name, Fits()), reverses)
        for reader in self.readers:
            parts = reader.parts(self.tables[reader.name], parts, self.path)
        return parts

    @property
    def stacks(self) -> "tuple[AxialStack, ...]":
        """The axial stacks of the mechanism and of what stands around it."""
        around = (one for around in self.surroundings for one in around.stacks)
        return (*self.family.stacks(self.params), *around)

    @cached_property
    def surroundings(self) -> "tuple[Surroundings, ...]":
        """What the tables put around the mechanism; nothing where the family's own check finds an error."""
        return () if errors(self._own_findings, Stage.PARTS) else self._around

    @cached_property
    def _around(self) -> "tuple[Surroundings, ...]":
        found = (
            reader.surroundings(self.tables[reader.name], self.family, self.params) for reader in self.readers
        )
        return tuple(one for one in found if one is not None)

    @cached_property
    def _own_findings(self) -> tuple[Finding, ...]:
        return tuple(self.family.check(self.params))

    def check(self) -> tuple[Finding, ...]:
        """What the family finds, and what there is to say of what stands around the mechanism."""
        chosen = (told(self.chosen),) if self.chosen else ()
        around = (one for around in self.surroundings for one in around.findings)
        return (*self._own_findings, *around, *chosen)

    def judge(self) -> tuple[Finding, ...]:
        """What :meth:`check` finds, as far as it is found fast; see :meth:`Family.judge`."""
        found = tuple(self.family.judge(self.params))
        if errors(found, Stage.PARTS):
            return found
        return (*found, *(one for around in self._around for one in around.findings))

    def solve(self, samples: int) -> "Motion":
        """The motion as the family gives it, with the bodies of what stands around the mechanism."""
        motion: Motion = self.family.solve(self.params, samples)
        for around in self.surroundings:
            motion = around.around(motion)
        return motion

    def stretches(self, samples: int) -> "Iterator[Motion]":
        """The same motion, a stretch after the other: see :meth:`Family.stretches`."""
        for motion in self.family.stretches(self.params, samples):
            for around in self.surroundings:
                motion = around.around(motion)
            yield motion

    def settings(self) -> "dict[str, Design]":
        """What the same machine is set to besides: see :meth:`Family.settings`."""
        others = self.family.settings(self.params)
        return {name: replace(self, params=params) for name, params in others.items()}

    def changed(self, change: Change, *, settle: bool = True) -> "Design":
        """The design that the file would hold with a change; raises as :func:`load` does.

        Without ``settle`` what was chosen for keys that the file leaves out stays: to choose anew may take
        seconds.
        """
        content = changed(self.content, change)
        for key in change:
            if key in {"family", "format", "units"}:
                raise DesignError(f"{self.path}: {key}: what all else hangs on is changed in the file")
        name = read_name(
            content, self.path, (*HEAD, "parameters", STAGE, *(one.name for one in self.readers))
        )
        chosen = {} if settle else {key: value for key, value in self.chosen.items() if key not in change}
        params = own_params(self.family, changed(content, chosen), self.path)
        touched = {key.partition(".")[0] for key in change}
        tables = table_values(self.readers, content, self.path, self.tables, touched)
        design = replace(self, name=name, params=params, tables=tables, content=content, chosen=chosen)
        return settled(design) if settle else design

    def choosing(self, change: Change) -> "Design":
        """The design with keys that its file leaves out, beside those that are chosen already."""
        chosen = {**self.chosen, **change}
        params = own_params(self.family, changed(self.content, chosen), self.path)
        return replace(self, params=params, chosen=chosen)


@once()
def load(path: Path, host: Host) -> Design:
    """Read a design file.

    Raises OutputError where it cannot be read; DesignError with one line for each wrong thing in it;
    PluginError where its family is not installed.
    """
    content, digest = read_toml(path)
    with telling_places(path, content, host, "parameters"):
        return design_of(content, path, digest, host)


@contextmanager
def telling_places(path: Path, content: Mapping[str, Any], host: Host, own: str) -> Iterator[None]:
    """Tell of every unknown key on which line it stands, and to which table it belongs.

    ``own`` is the table of the family: ``parameters`` or ``requirement``.
    """
    try:
        yield
    except DesignError as error:
        said = placed(str(error), read_text(path)[0], homes(host, content, own))
        raise DesignError(said) from error


def design_of(content: Mapping[str, Any], path: Path, digest: str, host: Host) -> Design:
    """The design that a file ``path`` with this content holds; raises as :func:`load` does."""
    tables = host.of(Table)
    keys = (*HEAD, "parameters", STAGE, *tables)
    _check_kind(content, path, set(keys))
    family: Family[Any]
    if STAGE in content:
        name = read_name(content, path, keys)
        family = chain_of(content, path, host)
        schema = {STAGE: stage_schema(family.families)}
    else:
        name, family = read_head(content, path, host, keys)
        schema = {"parameters": model_schema(family.Params)}
    readers = tuple(entry.item for entry in tables.values())
    units, content = in_millimetres(content, path, schema, readers)
    with told_in(units):
        params = own_params(family, content, path)
        values = table_values(readers, content, path)
    return settled(Design(name, family, params, path, digest, values, readers, content, units))


def _check_kind(content: Mapping[str, Any], path: Path, known: Set[str]) -> None:
    """Raises DesignError for a file of another kind, with what it is for; ``known`` are a design's keys."""
    if "requirement" in content and "parameters" not in content:
        raise DesignError(
            f"{path}: requirement: this file says what is asked of a design, and is none; find designs by "
            f"mechwright synthesize {file_word(path.name)} -o FOLDER, or in Python by mechwright.synthesize"
        )
    if "study" in content:
        raise DesignError(
            f"{path}: study: this file is a study of many designs; sweep it by mechwright sweep "
            f"{file_word(path.name)} -o FOLDER, which writes the designs of its front, or in Python by "
            "mechwright.sweep"
        )
    if not {"family", STAGE, "parameters"} & content.keys() and content.keys() - known:
        raise DesignError(
            f"{path}: family: missing, so that this file is no design; what a shop has is named in the head "
            f'of one: shop = "{path.name}"'
        )


def own_params(family: Family[Any], content: Mapping[str, Any], path: Path) -> Parameters:
    """The parameters that a file gives to its family, or to the stages of a chain; raises as :func:`load`."""
    if isinstance(family, Chain):
        return chain_params(family.families, content, path)
    params: Parameters = read_table(
        family.Params, content.get("parameters", {}), str(path), "parameters", path
    )
    return params


def read_tables(content: Mapping[str, Any], path: Path, host: Host) -> dict[str, Any]:
    """The values of all registered tables of a file; raises as :meth:`Table.read` does."""
    return table_values(host.all(Table), content, path)


def table_values(
    readers: Iterable[Table[Any]],
    content: Mapping[str, Any],
    path: Path,
    known: Mapping[str, Any] | None = None,
    touched: Set[str] = frozenset(),
) -> dict[str, Any]:
    """The values of tables of a file, with what some of them lend to others.

    Those that are ``known`` stay, but for the ``touched`` ones; all are read anew where a touched one lends.
    Raises as :meth:`Table.read` does.
    """
    values: dict[str, Any] = {}
    lent: dict[str, Mapping[str, Any]] = {}
    readers = tuple(readers)
    if known is None or any(reader.lender and reader.name in touched for reader in readers):
        known = {}
    stays = known.keys() - touched
    for reader in sorted(readers, key=lambda reader: not reader.lender):
        name, own = reader.name, content.get(reader.name, {})
        if name in stays:
            values[name] = known[name]
        else:
            values[name] = reader.read(reader.laid_over(own, lent[name]) if name in lent else own, path)
        if reader.lender:
            lent |= reader.lends(values[name])
    return {reader.name: values[reader.name] for reader in readers}


def read_head(
    content: Mapping[str, Any], path: Path, host: Host, keys: tuple[str, ...]
) -> tuple[str, Family[Any]]:
    """Name and family of a file whose top level may hold ``keys``; raises as :func:`load` does."""
    name = read_name(content, path, keys)
    family_name = content.get("family")
    if not isinstance(family_name, str):
        fault = "is missing" if family_name is None else f"{family_name!r} is no text"
        known = ", ".join(sorted(host.of(Family))) or "none is installed"
        raise DesignError(f"{path}: family: {fault}; name one of: {known}")
    try:
        return name, host.family(family_name)
    except PluginError as error:
        raise PluginError(f"{path}: family: {error}") from error


def read_name(content: Mapping[str, Any], path: Path, keys: tuple[str, ...]) -> str:
    """Name of a file whose top level may hold ``keys``; raises as :func:`load` does."""
    for key in content:
        if key not in keys:
            raise DesignError(f"{path}: {unknown(key, keys)}")
    layout = content.get("format", FORMAT)
    if type(layout) is not int or layout != FORMAT:  # true and 1.0 equal 1
        raise DesignError(f"{path}: format: {layout!r} is not known; this program reads format {FORMAT}")
    name = content.get("name", name_from(path.stem, "design"))
    if not isinstance(name, str):
        raise DesignError(f"{path}: name: {name!r} is no text")
    try:
        check_name(name)
    except DesignError as error:
        raise DesignError(f"{path}: {error}") from error
    return name
