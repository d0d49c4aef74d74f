"""The contract of a table of the design file: a room that has settings of its own registers theirs."""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

from mechwright.contracts.parameters import Parameters
from mechwright.contracts.part import Part
from mechwright.contracts.plugin import Plugin

if TYPE_CHECKING:
    from mechwright.contracts.family import Family
    from mechwright.contracts.surroundings import Surroundings

V = TypeVar("V")


class Table(Plugin, Generic[V]):
    """A table ``[name]`` beside ``[parameters]``, such as ``[cam]``.

    Reading, writing and the files that it names are the business of whoever registers it; a design keeps its
    value under its name and asks nothing of it.
    """

    kind = "table"
    plural = "tables"
    settings: ClassVar[type[Parameters] | None] = None
    """The model of its keys, whose bounds and choices a search for remedies keeps to; None if it has none."""

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
    def text(self, value: V | None = None) -> list[str]:
        """The lines of the table with a comment for each key; None stands for the defaults."""

    def first(self) -> list[str]:
        """The lines of the keys that one sets first, for the short form of a new file; none by default."""
        return []

    def schema(self) -> dict[str, Any]:
        """The JSON schema of the table, for editors; by default any table will do."""
        return {"type": "object"}

    def parts(self, value: V, parts: Sequence[Part], path: Path) -> Sequence[Part]:  # noqa: ARG002
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
    ) -> "Surroundings | None":
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
