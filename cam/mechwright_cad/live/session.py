"""The design file that a page shows: what it holds, and what happens to it when a page says so."""

import hashlib
import threading
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mechwright.beside import Beside
from mechwright.contracts.part import check_name
from mechwright.designs.change import rewritten
from mechwright.designs.design import Design, design_of, load
from mechwright.designs.files import read_text
from mechwright.errors import DesignError, OutputError
from mechwright.output.folder import rewrite, write_new
from mechwright.plugins.host import Host
from mechwright_cad.live import answers
from mechwright_cad.live.fields import fields_of

_REMEDIES = ("mechwright.remedies", "mechwright_cad.live.answers")


@dataclass
class Session:
    """A design file and those who look at it."""

    path: Path
    host: Host
    _design: Design | None = None
    _beside: Beside | None = None
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def digest(self) -> str:
        """SHA-256 of the file as it is now; empty where it cannot be read."""
        try:
            return hashlib.sha256(self.path.read_bytes()).hexdigest()
        except OSError:
            return ""

    def design(self) -> Design:
        """The design that the file holds now; raises as :func:`~mechwright.designs.design.load` does."""
        with self._lock:
            if self._design is None or self._design.digest != self.digest():
                self._design = load(self.path, self.host)
            return self._design

    def changed(self, change: Mapping[str, Any]) -> Design:
        """The design with what the page says; raises DesignError where that cannot be."""
        return self.design().changed(change) if change else self.design()

    def described(self, change: Mapping[str, Any]) -> dict[str, Any]:
        """What the page needs to begin: names, digest and fields."""
        design = self.changed(change)
        return {
            "name": design.name,
            "file": self.path.name,
            "family": design.family.name,
            "title": design.family.title,
            "digest": self.design().digest,
            "fields": fields_of(design),
        }

    def remedies(self, change: Mapping[str, Any]) -> list[dict[str, Any]] | None:
        """The findings with remedies that were tried, by a second process; None if a newer question came."""
        self.design().changed(change)  # what is wrong with it is told here
        with self._lock:
            if self._beside is not None:
                self._beside.close()
            mine = self._beside = Beside(_REMEDIES)
        mine.ask(answers.remedies, self.path, dict(change))
        found = mine.answer(list)
        return found if self._beside is mine else None

    def save(self, change: Mapping[str, Any], digest: str) -> str:
        """Write the change into the file, whose comments and order stay; gives the words that say so.

        Raises
        ------
        OutputError
            The file is another than the page knows.
        DesignError
            The change cannot be written, or the new file could not be read.
        """
        text, now = read_text(self.path)
        if now != digest:
            raise OutputError(
                f"{self.path.name}: has changed on disk since; look at it first, then save again"
            )
        rewrite(self.path, self._text(text, change))
        return f"{self.path.name}: saved"

    def save_as(self, change: Mapping[str, Any], name: str) -> str:
        """Write the changed design to a new file beside the old one; raises as :meth:`save` does."""
        target = self.path.with_name(f"{check_name(name, 'the new name')}.toml")
        write_new(target, self._text(read_text(self.path)[0], change))
        return f"{target.name}: written"

    def _text(self, text: str, change: Mapping[str, Any]) -> str:
        design = self.design()
        new = rewritten(text, change)
        design_of(design.changed(change).content, self.path, design.digest, self.host)
        return new

    def close(self) -> None:
        """End what runs beside."""
        if self._beside is not None:
            self._beside.close()


def text_of(body: Mapping[str, Any], key: str) -> str:
    """A text of a request; raises DesignError where it is none."""
    found = body.get(key)
    if not isinstance(found, str):
        raise DesignError(f"the page sent no {key}")
    return found


def change_of(body: Mapping[str, Any]) -> dict[str, Any]:
    """The change of a request: dotted keys to values; raises DesignError where it is none."""
    found = body.get("change")
    if not isinstance(found, dict) or len(found) > 1000:
        raise DesignError("the page sent no change")
    if any(key.partition(".")[0] in {"family", "format", "name", ""} for key in found):
        raise DesignError("family, format and name of a design are changed in its file")
    return found
