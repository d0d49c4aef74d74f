"""Pickles that leave out what the reader has: such objects are written as their place in a list."""

import pickle
from collections.abc import Sequence
from typing import IO, Any


class KnownPickler(pickle.Pickler):
    """Writes an object of ``known`` as its index, so that the reader puts its own object there."""

    def __init__(self, file: IO[bytes], known: Sequence[object]) -> None:
        super().__init__(file, pickle.HIGHEST_PROTOCOL)
        self._known = known  # an id is that of the object as long as the object lives
        self._indices = {id(one): index for index, one in enumerate(known)}

    def persistent_id(self, thing: object) -> int | None:
        """The index of a known object."""
        return self._indices.get(id(thing))


class KnownUnpickler(pickle.Unpickler):  # noqa: S301 - of what a process of our own has written
    """Reads what :class:`KnownPickler` has written; ``known`` are the reader's objects."""

    def __init__(self, file: IO[bytes], known: Sequence[object]) -> None:
        super().__init__(file)
        self._known = known

    def persistent_load(self, index: Any) -> object:
        """The known object of an index."""
        return self._known[index]
