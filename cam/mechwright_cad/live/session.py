"""A design file that a page shows: its motion and parts, what the family finds, and builds of it."""

import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from mechwright.designs.design import Design, design_of, load
from mechwright.errors import DesignError
from mechwright.plugins.host import Host
from mechwright.worker_pool.budget import available_cores
from mechwright.worker_pool.pool import WorkerPool
from mechwright_cad.live import answers
from mechwright_cad.live.building import Building
from mechwright_cad.live.fields import fields_of
from mechwright_cad.live.following import Answering, Asked, Change, Following, change_of
from mechwright_cad.live.places import dragged, drawn

_REMEDIES = ("mechwright.remedies", "mechwright_cad.live.answers")


class Session(Following):
    """A design file and those who look at it."""

    def __init__(self, path: Path, host: Host) -> None:
        super().__init__(path, host)
        self.building = Building(path)
        self._design: Design | None = None
        self._pool: WorkerPool | None = None
        self._lock = threading.Lock()

    @property
    def asks(self) -> dict[str, Answering]:
        """Motion, the mechanism's parts, all parts, remedies, and builds."""
        return {
            **self.common(),
            "motion": lambda body: answers.motion(self.changed(change_of(body), settle=False)),
            "drag": self._drag,
            "mechanism": lambda body: answers.mechanism(self.changed(change_of(body), settle=False)),
            "parts": lambda body: answers.parts(self.changed(change_of(body))),
            "remedies": lambda body: {"findings": self.remedies(change_of(body))},
            "build": self._build,
            "stop": self._stop,
        }

    @property
    def states(self) -> dict[str, Callable[[], Mapping[str, Any]]]:
        """How far a build is."""
        return {"building": self.building.state}

    def design(self) -> Design:
        """The design that the file holds now; raises as :func:`~mechwright.designs.design.load` does."""
        with self._lock:
            if self._design is None or self._design.digest != self.digest():
                self._design = load(self.path, self.host)
            return self._design

    def changed(self, change: Change, *, settle: bool = True) -> Design:
        """The design with what the page says; raises DesignError where that cannot be."""
        return self.design().changed(change, settle=settle) if change else self.design()

    def described(self, change: Change) -> dict[str, Any]:
        """Names, digest and fields."""
        design = self.changed(change)  # whose digest is that of the file all of this is from
        return {
            "name": design.name,
            "file": self.path.name,
            "family": design.family.name,
            "title": design.family.title,
            "digest": design.digest,
            "fields": fields_of(design),
        }

    def remedies(self, change: Change) -> list[dict[str, Any]] | None:
        """The findings with remedies that were tried, by a second process; None if a newer question came."""
        self.design().changed(change)  # what is wrong with it is told here
        with self._lock:
            if self._pool is not None:
                self._pool.close()
            mine = self._pool = WorkerPool([available_cores()], _REMEDIES, quiet=True)
        with mine, suppress(Exception):
            found = mine.result(mine.submit(answers.remedies, self.path, dict(change)))
            return found if self._pool is mine else None
        return None

    def accept(self, content: Mapping[str, Any]) -> None:
        """As :func:`~mechwright.designs.design.design_of` raises."""
        design_of(content, self.path, "", self.host)

    def _drag(self, body: Asked) -> Mapping[str, Any]:
        """What a target dragged to a place makes of the change."""
        change = change_of(body)
        moved = dragged(answers.targets(self.changed(change, settle=False)), body)
        after = {**change, **{f"parameters.{key}": value for key, value in moved.items()}}
        return {"change": after, "targets": drawn(answers.targets(self.changed(after, settle=False)))}

    def _build(self, body: Asked) -> Mapping[str, Any]:
        if change_of(body):
            raise DesignError("a build is made of the file: save first")
        self.building.start()
        return self.building.state()

    def _stop(self, _: Asked) -> Mapping[str, Any]:
        self.building.stop()
        return self.building.state()

    def close(self) -> None:
        """End what runs beside, a build too."""
        self.building.stop()
        if self._pool is not None:
            self._pool.close()
