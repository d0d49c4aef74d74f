"""Keys that a file leaves out, as what stands around its mechanism wants them.

A frame needs holes for its screws in a ground plate, a shaft for which a coupling is sold, and screws beside
what moves; so does a chain. Where the file says nothing of such a key it is the program's to choose.
"""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from typing import Any, Protocol, Self, TypeVar

from mechwright.contracts.family import Family
from mechwright.contracts.finding import Change, Finding, Severity, Stage, errors
from mechwright.contracts.parameters import Parameters, is_fitted
from mechwright.contracts.surroundings import Surroundings
from mechwright.contracts.table import Table
from mechwright.designs.change import found_at
from mechwright.designs.text import toml
from mechwright.errors import MechwrightError
from mechwright.mechanics.chain import Chain, StageTable

ROUNDS = 8
"""Changes that are chosen one after the other: each may bring the next one to light."""

CHOSEN = "design.chosen"
"""Code of the note that tells of them."""


class _Open(Protocol):
    """A design, as far as keys are chosen for it."""

    @property
    def family(self) -> Family[Any]: ...
    @property
    def params(self) -> Parameters: ...
    @property
    def readers(self) -> tuple[Table[Any], ...]: ...
    @property
    def tables(self) -> Mapping[str, Any]: ...
    @property
    def content(self) -> Mapping[str, Any]: ...
    @property
    def own_tables(self) -> Mapping[str, Any]: ...
    @property
    def surroundings(self) -> tuple[Surroundings, ...]: ...

    def choosing(self, change: Change) -> Self:
        """The design with keys that its file leaves out."""


D = TypeVar("D", bound=_Open)

CHAIN = "chain."
"""How the codes of findings begin that are about what joins stages."""


def settled(design: D) -> D:
    """The design with the keys that its frame or its chain wants and its file leaves out.

    It is the design itself where nothing stands around the mechanism, nothing is wanted, or nothing helps.
    """
    if not (isinstance(design.family, Chain) or any(_stands(design, reader) for reader in design.readers)):
        return design
    with suppress(MechwrightError):
        for _ in range(ROUNDS):
            better = next(_better(design), None)
            if better is None:
                break
            design = better
    return design


def _stands(design: _Open, reader: Table[Any]) -> bool:
    """Whether a table may put something around the mechanism."""
    usual = reader.settings
    return (
        type(reader).surroundings is not Table.surroundings
        and usual is not None
        and design.tables[reader.name] != usual()
    )


def _better(design: D) -> Iterator[D]:
    """The designs that an error is gone with and that differ in nothing that the file says.

    Those with which nothing is left of its kind for the same key come first; of a frame, which has several
    screws, another place may be left.
    """
    for finding in _wishes(design):
        changed: list[D] = []
        for change in finding.proposed:
            if not change or not all(_open(key, design) for key in change):
                continue
            with suppress(MechwrightError):
                other = design.choosing(change)
                left = [one for one in _wishes(other) if one.code == finding.code]
                if all(one.parameter != finding.parameter for one in left):
                    yield other
                elif not finding.code.startswith(CHAIN) and all(
                    one.message != finding.message for one in left
                ):
                    changed.append(other)
        yield from changed


def _wishes(design: _Open) -> list[Finding]:
    """The errors of what joins stages or stands around a mechanism, where it has none of its own."""
    found: Iterable[Finding] = design.family.judge(design.params)
    if isinstance(design.family, Chain):
        return [one for one in found if one.severity is Severity.ERROR and one.code.startswith(CHAIN)]
    own = tuple(found)
    if errors(own, Stage.PARTS):
        return []
    around = (one for some in design.surroundings for one in some.findings)
    return [one for one in around if one.severity is Severity.ERROR]


def _open(key: str, design: _Open) -> bool:
    """Whether the file leaves a key out whose value follows from others."""
    table, _, name = key.rpartition(".")
    own = (path for path in design.own_tables if f"{key}.".startswith(f"{path}."))
    start = next(own, None)
    if found_at(design.content, key)[0]:
        return False
    if start is None:
        return isinstance(design.family, Chain) and is_fitted(StageTable.model_fields.get(name))
    steps = table.removeprefix(start).split(".")[1:]
    model: Any = design.own_tables[start]
    for step in steps:
        model = getattr(model, step, None)
    if not isinstance(model, Parameters) or name not in type(model).model_fields:
        return False
    field = type(model).model_fields[name]
    follows = not field.is_required() and field.get_default(call_default_factory=True) is None
    return follows or is_fitted(field)


def told(chosen: Mapping[str, Any]) -> Finding:
    """What was chosen."""
    said = ", ".join(f"{key.removeprefix('parameters.')} = {_shown(value)}" for key, value in chosen.items())
    return Finding.note(CHOSEN, f"defaults chosen for the frame or the chain: {said}")


def _shown(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else toml(value)
