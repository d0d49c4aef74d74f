"""The file that a page shows and follows: read, watched, written where the page says so."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from mechwright.contracts.part import check_name
from mechwright.designs.bounded_toml import DEEP, toml_of
from mechwright.designs.change import rewritten
from mechwright.designs.files import read_text
from mechwright.designs.hints import schemas_of
from mechwright.designs.inches import units_of, written
from mechwright.errors import DesignError, MechwrightError
from mechwright.output.folder import ChangedError, rewrite, write_new
from mechwright.plugins.host import Host

Change = Mapping[str, Any]
Asked = Mapping[str, Any]
"""What a page sends: an object of JSON."""
MOST_KEYS = 1000
"""Keys of a change: a page has some hundreds of fields."""
MOST_VALUES = 10_000
"""Texts, numbers, lists and tables in the values of a change: points of a path, rows of a table."""
DEEPEST_VALUE = 8
"""Lists and tables in each other in a value."""
LONGEST_CHANGE = 500
"""Characters of a key of a change."""
Answering = Callable[[Asked], Mapping[str, Any]]


class Following(ABC):
    """A file on disk and the page that shows it; nothing of the file is written unless the page asks."""

    def __init__(self, path: Path, host: Host) -> None:
        self.path, self.host = path, host

    @property
    @abstractmethod
    def asks(self) -> dict[str, Answering]:
        """What a page can ask, by the last part of the address."""

    @property
    @abstractmethod
    def states(self) -> dict[str, Callable[[], Mapping[str, Any]]]:
        """What a page looks at again and again, by the last part of the address."""

    @abstractmethod
    def described(self, change: Change) -> dict[str, Any]:
        """What a page needs to begin; raises MechwrightError where the file cannot be read."""

    @abstractmethod
    def accept(self, content: Mapping[str, Any]) -> None:
        """Do nothing if a file with this content could be shown; raises MechwrightError if not."""

    @abstractmethod
    def close(self) -> None:
        """End what runs beside."""

    def digest(self) -> str:
        """SHA-256 of the file as it is now; empty where it cannot be read."""
        try:
            return read_text(self.path)[1]
        except MechwrightError:
            return ""

    def save(self, change: Change, digest: str) -> str:
        """Write the change into the file, whose comments and order stay; gives the words that say so.

        Raises
        ------
        ChangedError
            The file is another than the page knows. Of several saves of one state at once, one is written.
        DesignError
            The change cannot be written, or the new file could not be read.
        """
        said = f"{self.path.name}: has changed on disk since; look at it first, then save again"
        text, now = read_text(self.path)
        if now != digest:
            raise ChangedError(said)
        try:
            rewrite(self.path, self._text(text, change), known=now)
        except ChangedError:
            raise ChangedError(said) from None
        return f"{self.path.name}: saved"

    def _saved(self, body: Asked) -> Mapping[str, Any]:
        """Where the file is another by now, what it holds goes with the error."""
        try:
            return {"said": self.save(change_of(body), text_of(body, "digest"))}
        except ChangedError as error:
            text, digest = read_text(self.path)
            return {"error": str(error), "changed": {"text": text, "digest": digest}}

    def save_as(self, change: Change, name: str) -> str:
        """Write what is shown to a new file beside the old one; raises as :meth:`save` does."""
        return self.write(name, self._text(read_text(self.path)[0], change))

    def write(self, name: str, text: str) -> str:
        """Write a new file beside the old one, told in words; raises OutputError where there is one."""
        target = self.path.with_name(f"{check_name(name, 'the new name')}.toml")
        write_new(target, text)
        return f"{target.name}: written"

    def _text(self, text: str, change: Change) -> str:
        said = toml_of(text, self.path)
        own = "requirement" if "requirement" in said else "parameters"
        units = units_of(said, self.path)
        schemas = schemas_of(self.host, said, own) if units == "inch" else {}
        new = rewritten(text, written(change, units, schemas))
        self.accept(toml_of(new, self.path))
        return new

    def common(self) -> dict[str, Answering]:
        """What every page can ask."""
        return {
            "described": lambda body: self.described(change_of(body)),
            "save": self._saved,
            "save-as": lambda body: {"said": self.save_as(change_of(body), text_of(body, "name"))},
        }


def text_of(body: Asked, key: str) -> str:
    """A text of a request; raises DesignError where it is none."""
    found = body.get(key)
    if not isinstance(found, str):
        raise DesignError(f"the page sent no {key}")
    return found


def _require_short(change: Change) -> None:
    """Raise DesignError for values that no page sends; they are looked at level by level."""
    level, count = list(change.values()), 0
    for _ in range(DEEPEST_VALUE):
        count += len(level)
        if count > MOST_VALUES:
            raise DesignError(f"the page sent more than {MOST_VALUES:,} values; write them into the file")
        level = [
            one
            for value in level
            if isinstance(value, (list, dict))
            for one in (value.values() if isinstance(value, dict) else value)
        ]
        if not level:
            return
    raise DesignError(f"the page sent a value deeper than {DEEPEST_VALUE} lists; write it into the file")


def change_of(body: Asked) -> dict[str, Any]:
    """The change of a request: dotted keys to values; raises DesignError where it is none."""
    found = body.get("change")
    if not isinstance(found, dict) or len(found) > MOST_KEYS:
        raise DesignError("the page sent no change")
    for key in found:
        if len(key) > LONGEST_CHANGE or key.count(".") >= DEEP:
            raise DesignError(
                f"the page sent the key {key[:40]!r}...: a key has at most {DEEP} parts and {LONGEST_CHANGE} "
                "characters"
            )
    _require_short(found)
    if any(key.partition(".")[0] in {"family", "format", "name", ""} for key in found):
        raise DesignError("family, format and name of a design are changed in its file")
    return found
