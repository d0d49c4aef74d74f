"""The contract of a table of the design file: a room that has settings of its own registers theirs."""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

from mechwright.contracts.parameters import Parameters
from mechwright.contracts.plugin import Plugin

if TYPE_CHECKING:
    from mechwright.contracts.answers import Around, Parts
    from mechwright.contracts.family import Family
    from mechwright.contracts.in_hand import InHand
    from mechwright.contracts.part import Part
    from mechwright.contracts.schema_check import Lines, Schema

V = TypeVar("V")


class Table(Plugin, Generic[V]):
    """A table ``[name]`` beside ``[parameters]``, such as ``[cam]``.

    Reading, writing and the files that it names are the business of whoever registers it; a design keeps its
    value under its name and asks nothing of it.
    """

    kind = "table"
    plural = "tables"
    limited = True
    settings: ClassVar[type[Parameters] | None] = None
    """The model of its keys, whose bounds and choices a search for remedies keeps to; None if it has none."""
    lender: ClassVar[bool] = False
    """Whether it lends keys to other tables, see :meth:`lends`; it is read before them then."""

    @abstractmethod
    def read(self, content: object, path: Path) -> V:
        """The value of the table, as it stands in the file ``path``; an empty one where the file has none.

        Raises
        ------
        DesignError
            One line for each thing that is wrong.
        OutputError
            A file that it names cannot be read.
        """

    @abstractmethod
    def text(self, value: V | None = None) -> "Lines":
        """The lines of the table with a comment for each key; None stands for the defaults."""

    def first(self) -> "Lines":
        """The lines of the keys that one sets first, for the short form of a new file; none by default."""
        return []

    def head(self, value: V | None = None) -> "Lines":  # noqa: ARG002 - for tables that are one key
        """Lines above all tables, for what a file says in one key of its head; none by default."""
        return []

    def lends(self, value: V) -> Mapping[str, Mapping[str, Any]]:  # noqa: ARG002 - for lenders
        """Name of another table to keys that it has where the file does not say them; none by default."""
        return {}

    def in_hand(self, value: V) -> "InHand | None":  # noqa: ARG002 - for lenders
        """What ``new --shop`` makes a design of; None, the default, where the table knows of no plates."""
        return None

    def laid_over(self, own: object, lent: Mapping[str, Any]) -> object:
        """What the file says of this table, laid over what another one lends it; key by key by default."""
        return laid_over(own, lent)

    def schema(self) -> "Schema":
        """The JSON schema of the table, for editors; by default any table will do."""
        return {"type": "object"}

    def file_schema(self) -> "Schema":
        """The JSON schema of the file that the table names, for ``mechwright schema``; empty without one."""
        return {}

    def parts(self, value: V, parts: "Sequence[Part]", path: Path) -> "Parts":  # noqa: ARG002
        """The parts of the design with what the table asks of them, such as broken edges.

        Solids, drawings, programs and proofs are made of these; by default they are as the family gives them.

        Raises
        ------
        DesignError
            What is asked cannot be done, or of a part that is not there; it begins with ``path`` and the key.
        """
        return parts

    def surroundings(
        self,
        value: V,  # noqa: ARG002 - for tables that put something around a mechanism
        family: "Family[Any]",  # noqa: ARG002
        params: Parameters,  # noqa: ARG002
    ) -> "Around":
        """What the table puts around a mechanism, such as a frame; None, the default, for nothing.

        It is asked where the family's own check finds no error, and what cannot be had is a finding.
        """
        return None

    def inputs(self, value: V, path: Path) -> Mapping[str, Path]:  # noqa: ARG002 - for tables that name files
        """The files that the table names, by the names it gives them; the manifest has their hashes."""
        return {}

    def carried(self, value: V, path: Path) -> tuple[V, Mapping[str, Path]]:  # noqa: ARG002
        """The table of designs that a requirement file asks for, and the files that go along with them.

        Parameters
        ----------
        value
            What the requirement file says.
        path
            That file.

        Returns
        -------
        value
            For the designs, which stand in another folder.
        files
            New name to the file that is copied beside them.
        """
        return value, {}


def laid_over(own: object, lent: Mapping[str, Any]) -> object:
    """One table over another, key by key; what is no table stands for itself.

    >>> laid_over({"post": {"cycles": False}}, {"post": {"restart": True}, "clearance": 7})
    {'post': {'restart': True, 'cycles': False}, 'clearance': 7}
    """
    if not isinstance(own, Mapping):
        return own
    merged = dict(lent)
    for key, value in own.items():
        under = merged.get(key)
        merged[key] = laid_over(value, under) if isinstance(under, Mapping) else value
    return merged
