"""Study files: which designs are looked at, what they have to keep, and what is best.

They are laid out as design files are, with a table ``[study]`` besides::

    format = 1
    family = "four-bar"
    name = "short-links"

    [parameters]
    ground = 90

    [study]
    method = "sobol"
    count = 100000

    [study.ranges]
    crank = { least = 20, greatest = 45 }
    coupler = { least = 60, greatest = 120, step = 2.5 }

    [study.constraints]
    least_transmission_angle = { at_least = 40 }

    [study.objectives]
    alpha_b_max = "least"

Parameters without a range are those of ``[parameters]``; other tables, such as ``[cam]``, go into the
designs.
"""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

from pydantic import Field

from mechwright.contracts.family import Family
from mechwright.contracts.finding import Change, Stage
from mechwright.contracts.inputs import input_files
from mechwright.contracts.masses import is_mass
from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.table import Table
from mechwright.designs.change import changed
from mechwright.designs.design import Design, read_head, read_tables, telling_places
from mechwright.designs.files import read_toml
from mechwright.designs.inches import units_of
from mechwright.designs.schema import HEAD
from mechwright.designs.tables import read_table, unknown
from mechwright.errors import DesignError, MechwrightError
from mechwright.plugins.host import Host
from mechwright.reading import once
from mechwright.studies.axis import Axis, Range, axis_of, flat
from mechwright.units import convert

TABLE = "study"

MOST_BATCH = 1 << 22
"""Designs of a batch: their columns are in memory at once."""

MOST_TABLES = 1 << 18
"""Of a study, one for each batch: all of them are listed before the first one is begun."""

MOST = MOST_TABLES * MOST_BATCH
"""Designs of a study: at a million a second they take two weeks."""

BITS = 32
"""Of Sobol's points, of which there are 2 to this power: more cannot be entered in the middle."""

BOUNDS = frozenset(("at_least", "at_most"))
RANGE = frozenset(Range.model_fields)


class Asked(Parameters):
    """The table ``[study]``."""

    method: Literal["sobol", "latin-hypercube", "random", "grid"] = Field(
        "sobol", description="How designs are drawn from the ranges; a grid takes every one."
    )
    count: int = Field(10_000, ge=1, le=MOST, description="How many designs; a larger grid is refused.")
    seed: int = Field(1, ge=0, le=2**32 - 1, description="Of what is drawn; the same gives the same designs.")
    stage: Literal["motion", "parts"] = Field("parts", description="Up to which a design must have no error.")
    keep: Literal["feasible", "all"] = Field("feasible", description="Which designs get a row in the tables.")
    batch: int | None = Field(
        None, ge=1, le=MOST_BATCH, description="Designs that are evaluated together; by default the family's."
    )
    refine: int = Field(0, ge=0, le=50, description="Rounds of search around the best designs.")
    front: int = Field(12, ge=0, le=1000, description="Most designs of the front that become design files.")
    columns: tuple[str, ...] = Field((), description="Columns besides those that are asked for below.")
    ranges: dict[str, Any] = Field(description="Parameter to its range.")
    constraints: dict[str, Any] = Field({}, description="Column to its bounds: at_least, at_most.")
    objectives: dict[str, Any] = Field({}, description="Column to what is best: least or greatest.")


@dataclass(frozen=True)
class Bound:
    """What a column has to keep: ``low`` <= value <= ``high``, in the column's unit."""

    column: str
    low: float
    high: float


@dataclass(frozen=True)
class Study:
    """A study file that has been read and found well-formed.

    Parameters
    ----------
    asked
        The table ``[study]``.
    content
        The table ``[parameters]``, as the file says it.
    axes
        What is varied.
    units
        Column to its unit, of all that are written.
    bounds
        The constraints.
    objectives
        Column to 1 where the least is best, -1 where the greatest is.
    tables
        The other tables as the file has them; they go into the designs.
    """

    name: str
    family: Family[Any]
    asked: Asked
    content: Mapping[str, Any]
    axes: tuple[Axis, ...]
    units: Mapping[str, str]
    bounds: tuple[Bound, ...]
    objectives: Mapping[str, int]
    tables: Mapping[str, Any]
    path: Path
    file: Mapping[str, Any] = field(repr=False)

    @property
    def measured(self) -> tuple[str, ...]:
        """Columns that the family finds."""
        varied = {axis.name for axis in self.axes}
        return tuple(name for name in self.units if name not in varied)

    @property
    def stage(self) -> Stage:
        """Up to which a design must have no error."""
        return Stage(self.asked.stage)

    @property
    def count(self) -> int:
        """How many designs are drawn."""
        return grid_size(self.axes) if self.asked.method == "grid" else self.asked.count

    @property
    def batch(self) -> int:
        """Designs that are evaluated together."""
        return self.asked.batch or self.family.batch

    @property
    def batches(self) -> int:
        """How many batches there are."""
        return -(-self.count // self.batch)

    @cached_property
    def digest(self) -> str:
        """SHA-256 of all that its results depend on; comments and the order of keys do not count."""
        kept = {key: value for key, value in self.file.items() if key in {"family", "parameters", TABLE}}
        table = {key: value for key, value in kept.get(TABLE, {}).items() if key != "front"}
        said = json.dumps({**kept, TABLE: table}, sort_keys=True, default=str)
        return hashlib.sha256(said.encode()).hexdigest()


@once()
def load_study(path: Path, host: Host, change: Change | None = None) -> Study:
    """Read a study file, with a change of its content; raises as ``load`` of a design does."""
    content: Mapping[str, Any] = read_toml(path)[0]
    content = changed(content, change or {})
    with telling_places(path, content, host, "parameters"):
        return study_of(content, path, host)


def study_of(content: Mapping[str, Any], path: Path, host: Host) -> Study:
    """The study that a file ``path`` with this content holds; raises as ``load_study`` does."""
    if "stage" in content:
        raise DesignError(
            f"{path}: stage: a chain is of no one family, and a study varies designs of one; sweep a stage "
            "by itself"
        )
    tables = host.of(Table)
    name, family = read_head(content, path, host, (*HEAD, "parameters", TABLE, *tables))
    if units_of(content, path) != "mm":
        raise DesignError(f'{path}: units: a study is in mm; leave units out, or write "2 in" for a length')
    if TABLE not in content:
        raise DesignError(f"{path}: has no table [{TABLE}]; give [{TABLE}.ranges], or use mechwright check")
    given = content.get("parameters", {})
    params = read_table(family.Params, given, str(path), "parameters", path)
    for key in input_files(params):
        raise DesignError(f"{path}: parameters.{key}: a study carries no files; vary the design by hand")
    asked = read_table(Asked, content[TABLE], str(path), TABLE)
    axes = _axes(family, asked, path)
    if asked.method == "sobol" and asked.count > 1 << BITS:
        raise DesignError(
            f"{path}: {TABLE}.count: is {asked.count:,}, and Sobol has {1 << BITS:,} points; take "
            'method = "random"'
        )
    known = _known(family, params, path) | {axis.name: unit_of(family.Params, axis.name) for axis in axes}
    bounds = _bounds(asked, known, path)
    objectives = _objectives(asked, known, path)
    for axis in axes:
        table = "objectives" if axis.name in objectives else "constraints"
        if axis.is_text and axis.name in {*objectives, *(one.column for one in bounds)}:
            raise DesignError(f"{path}: {TABLE}.{table}.{axis.name}: has no numbers; leave it out")
    for column in asked.columns:
        _require(column, known, f"{path}: {TABLE}.columns")
    wanted = dict.fromkeys([*(axis.name for axis in axes), *(one.column for one in bounds), *objectives])
    units = {column: known[column] for column in dict.fromkeys([*wanted, *asked.columns])}
    weighed = next(filter(is_mass, units), None)
    if weighed and asked.stage == "motion":
        raise DesignError(
            f'{path}: {TABLE}.stage: is "motion", and {weighed} is of parts, which are not looked at then; '
            'take stage = "parts"'
        )
    if asked.refine and not objectives:
        raise DesignError(f"{path}: {TABLE}.refine: needs objectives; there is no best without one")
    rest = read_tables(content, path, host)
    study = Study(name, family, asked, given, axes, units, bounds, objectives, rest, path, content)
    if study.batches > MOST_TABLES:
        raise DesignError(
            f"{path}: {TABLE}.count: {study.count:,} designs in batches of {study.batch:,} make "
            f"{study.batches:,} tables; at most {MOST_TABLES:,}: raise {TABLE}.batch or take fewer designs"
        )
    return study


def _axes(family: Family[Any], asked: Asked, path: Path) -> tuple[Axis, ...]:
    found = []
    for name, table in flat(asked.ranges, RANGE).items():
        key = f"{TABLE}.ranges.{name}"
        asked_range = read_table(Range, table, str(path), key)
        found.append(axis_of(family.Params, name, asked_range, f"{path}: {key}"))
    if not found:
        raise DesignError(f"{path}: {TABLE}.ranges: is empty; a study varies at least one parameter")
    if asked.method == "grid":
        for axis in found:
            if axis.levels is None:
                where = f"{path}: {TABLE}.ranges.{axis.name}"
                raise DesignError(f"{where}: a grid needs a count, a step or values")
        if grid_size(tuple(found)) > asked.count:
            raise DesignError(
                f"{path}: {TABLE}.count: the grid has {grid_size(tuple(found)):,} designs and the count is "
                f"{asked.count:,}; raise the count or take wider steps"
            )
    return tuple(found)


def grid_size(axes: tuple[Axis, ...]) -> int:
    """How many designs a grid has."""
    size = 1
    for axis in axes:
        size *= 1 if axis.levels is None else axis.levels.size
    return size


def unit_of(model: type[Parameters], name: str) -> str:
    """Unit of a parameter, as its field declares it; empty for a number, a choice or a name."""
    schema = model_schema(model)
    table = schema
    for step in name.split("."):
        table = table.get("properties", {}).get(step, {})
        choices = [table, *table.get("allOf", ()), *table.get("anyOf", ())]
        for choice in choices:
            if "$ref" in choice:
                table = schema["$defs"][choice["$ref"].rpartition("/")[2]]
                break
    units = [one["unit"] for one in (table, *table.get("anyOf", ())) if "unit" in one]
    return str(units[0]) if units else ""


def _known(family: Family[Any], params: Parameters, path: Path) -> dict[str, str]:
    try:
        return dict(family.measures(params))
    except MechwrightError as error:
        raise DesignError(
            f"{path}: parameters: the design that the study starts from does not move: {error}; change it, "
            "so that its columns can be told"
        ) from error


def _require(column: str, known: Mapping[str, str], where: str) -> None:
    if column not in known:
        raise DesignError(f"{where}: {unknown(column, tuple(known), 'column')}")


def _bounds(asked: Asked, known: Mapping[str, str], path: Path) -> tuple[Bound, ...]:
    found = []
    for column, table in flat(asked.constraints, BOUNDS).items():
        where = f"{path}: {TABLE}.constraints.{column}"
        _require(column, known, where)
        if not isinstance(table, Mapping) or not table or set(table) - BOUNDS:
            raise DesignError(f"{where}: write {{ at_least = ... }}, {{ at_most = ... }} or both")
        low, high = (_number(table.get(key, end), known[column], f"{where}.{key}") for key, end in ENDS)
        if not low <= high:
            raise DesignError(f"{where}: nothing is at least {low:g} and at most {high:g}")
        found.append(Bound(column, low, high))
    return tuple(found)


ENDS = (("at_least", -float("inf")), ("at_most", float("inf")))


def _number(value: object, unit: str, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        raise DesignError(f"{where}: {value!r} is no number")
    try:
        return convert(value, unit) if isinstance(value, str) else float(value)
    except ValueError as error:
        raise DesignError(f"{where}: {error}") from None


def _objectives(asked: Asked, known: Mapping[str, str], path: Path) -> dict[str, int]:
    signs = {"least": 1, "greatest": -1}
    found = {}
    for column, wanted in flat(asked.objectives, None).items():
        where = f"{path}: {TABLE}.objectives.{column}"
        _require(column, known, where)
        if wanted not in signs:
            raise DesignError(f'{where}: {wanted!r} is none of "least" and "greatest"')
        found[column] = signs[str(wanted)]
    return found


def design_of(study: Study, name: str, params: Parameters, host: Host) -> Design:
    """A design of the study, as its file will be read."""
    readers = tuple(entry.item for entry in host.of(Table).values())
    content = {key: value for key, value in study.file.items() if key not in {"parameters", TABLE, "name"}}
    return Design(name, study.family, params, study.path, "", study.tables, readers, content)
