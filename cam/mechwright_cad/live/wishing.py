"""A requirement file that a page shows: what it asks for as places to drag, and the designs that meet it."""

import json
import threading
import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from mechwright.contracts.target import Target
from mechwright.designs.change import changed, rewritten
from mechwright.designs.design import design_of
from mechwright.designs.files import read_toml
from mechwright.designs.inches import units_of
from mechwright.designs.requirement import Requirement, load_requirement, requirement_of
from mechwright.errors import DesignError
from mechwright.plugins.host import Host
from mechwright.shell import file_word
from mechwright_cad.live import answers
from mechwright_cad.live.fields import fields_of_requirement
from mechwright_cad.live.following import Answering, Asked, Change, Following, change_of, text_of
from mechwright_cad.live.places import dragged, drawn, still
from mechwright_cad.live.seeking import Seeking


class Wishing(Following):
    """A requirement file and those who look at it."""

    def __init__(self, path: Path, host: Host) -> None:
        super().__init__(path, host)
        self.seeking = Seeking(path)
        self._asked: Requirement | None = None
        self._lock = threading.Lock()

    @property
    def asks(self) -> dict[str, Answering]:
        """Places, drags, searches, and the designs that were found."""
        return {
            **self.common(),
            "targets": self._targets,
            "drag": self._drag,
            "seek": self._seek,
            "shown": self._shown,
            "take": self._take,
            "stop": self._stop,
        }

    @property
    def states(self) -> dict[str, Callable[[], Mapping[str, Any]]]:
        """How far a search is."""
        return {"seeking": self.seeking.state}

    def requirement(self, change: Change) -> Requirement:
        """What the file asks for with a change; raises as ``load_requirement`` does."""
        digest = self.digest()
        with self._lock:
            if self._asked is None or self._asked.digest != digest:
                self._asked = load_requirement(self.path, self.host)
            asked = self._asked
        if not change:
            return asked
        return requirement_of(self._content(change), self.path, asked.digest, self.host)

    def _content(self, change: Change) -> dict[str, Any]:
        content = read_toml(self.path)[0]
        if units_of(content, self.path) == "inch":
            raise DesignError(
                f"{self.path}: units: pages ask in mm, and this file is in inches; use mechwright synthesize"
            )
        return changed(content, change)

    def described(self, change: Change) -> dict[str, Any]:
        """Names, digest and fields; a process for the first search gets ready meanwhile."""
        asked = self.requirement(change)
        self.seeking.prepare()
        return {
            "name": asked.name,
            "file": self.path.name,
            "family": asked.family.name,
            "title": f"{asked.family.title}: {asked.kind.replace('-', ' ')}",
            "digest": self.requirement({}).digest,
            "fields": fields_of_requirement(asked, self._content(change)),
            "seeks": True,
        }

    def accept(self, content: Mapping[str, Any]) -> None:
        """As :func:`~mechwright.designs.requirement.requirement_of` raises."""
        requirement_of(content, self.path, "", self.host)

    def _places(self, change: Change) -> tuple[Target, ...]:
        asked = self.requirement(change)
        return tuple(asked.family.targets(asked.kind, asked.table))

    def _targets(self, body: Asked) -> Mapping[str, Any]:
        places = self._places(change_of(body))
        return {"targets": drawn(places), "scene": still(places)}

    def _drag(self, body: Asked) -> Mapping[str, Any]:
        """What a target dragged to a place makes of the change."""
        change = change_of(body)
        moved = dragged(self._places(change), body)
        after = {**change, **{f"requirement.{key}": value for key, value in moved.items()}}
        return {"change": after, "targets": drawn(self._places(after))}

    def _seek(self, body: Asked) -> Mapping[str, Any]:
        change = change_of(body)
        self.requirement(change)  # what is wrong with it is told here
        self.seeking.start(change, json.dumps([self.digest(), sorted(change.items())]))
        return self.seeking.state()

    def _stop(self, _: Asked) -> Mapping[str, Any]:
        self.seeking.stop()
        return self.seeking.state()

    def _shown(self, body: Asked) -> Mapping[str, Any]:
        """A design that was found, over what is asked for."""
        content = tomllib.loads(self._text_of(body))
        design = design_of(content, self.path, "", self.host)
        places = self._places(change_of(body))
        return {"scene": still(places, answers.motion(design)["scene"]), "targets": drawn(places)}

    def _take(self, body: Asked) -> Mapping[str, Any]:
        """Write a design that was found to a file beside the requirement."""
        text, name = self._text_of(body), text_of(body, "name")
        said = self.write(name, rewritten(text, {"name": name}))
        file = file_word(self.path.with_name(f"{name}.toml"))
        return {"said": f"{said}; mechwright live {file} shows it"}

    def _text_of(self, body: Asked) -> str:
        name = text_of(body, "design")
        try:
            return self.seeking.text(name)
        except KeyError:
            raise DesignError(f"{name}: is none of the designs that were found last") from None

    def close(self) -> None:
        """End the search."""
        self.seeking.close()
