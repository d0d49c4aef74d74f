"""A synthesis that a page has asked for, in a process of its own: a newer question ends the older one."""

import math
import threading
import time
from collections import OrderedDict
from collections.abc import Mapping
from concurrent.futures import Future
from contextlib import suppress
from pathlib import Path
from typing import Any

from mechwright.contracts.synthesis import Progress
from mechwright.designs.change import changed
from mechwright.designs.files import read_toml
from mechwright.designs.requirement import requirement_of
from mechwright.errors import MechwrightError
from mechwright.plugins.host import host
from mechwright.scripting.synthesis import sought
from mechwright.worker_pool.budget import available_cores
from mechwright.worker_pool.pool import WorkerPool
from mechwright.worker_pool.serving import report_progress
from mechwright_cad.live.answers import findings_as_json

KEPT = 16
"""Results that are kept, so that undo shows at once what was found before."""

NOTHING = 1e-9
"""A figure below this is rounding, whether it is mm, degrees or a ratio."""

_MODULES = ("mechwright_cad.live.seeking",)

Found = dict[str, Any]


def designs(path: Path, change: Mapping[str, Any], progress: Progress) -> Found:
    """What a requirement file with a change leads to, as plain data; ``error`` says why it leads nowhere."""
    try:
        content, digest = read_toml(path)
        installed = host()
        asked = requirement_of(changed(content, change), path, digest, installed)
        found = sought(asked, installed, progress)
    except MechwrightError as error:
        return {"error": str(error)}
    except Exception as error:  # a plugin may raise anything
        return {"error": f"{type(error).__name__}: {error}; please report it"}
    result = found.result
    return {
        "told": found.told,
        "findings": findings_as_json(result.findings),
        "rejected": [
            {"count": one.count, "code": one.code, "message": one.message} for one in result.rejected
        ],
        "designs": [
            {
                "name": name,
                "text": text,
                "figures": [
                    {"name": key, "value": _value(one.value), "unit": one.unit}
                    for key, one in candidate.shown.items()
                ],
            }
            for (name, text), candidate in zip(found.texts, result.candidates, strict=True)
        ],
    }


def _value(value: float) -> float | None:
    """A figure as JSON holds it; what is rounding is 0."""
    if not math.isfinite(value):
        return None
    return 0.0 if abs(value) < NOTHING else value


class Run:
    """A process that is ready for a synthesis or at one, and how far it is."""

    def __init__(self) -> None:
        self.at: dict[str, Any] = {}
        self._since = time.monotonic()
        self.began = self._since
        self.pool = WorkerPool([available_cores()], _MODULES, quiet=True)

    def _progress(self, done: float, what: str) -> None:
        if what != self.at.get("doing"):
            self._since = time.monotonic()
        self.at = {"done": done, "doing": what}

    def begin(self, path: Path, change: Mapping[str, Any]) -> Future[Found]:
        """Start the synthesis."""
        self.began = self._since = time.monotonic()
        return self.pool.submit(designs, path, dict(change), report_progress, progress=self._progress)

    def state(self) -> dict[str, Any]:
        """What it is at, the seconds it took, and those that are left of what it is at, None if not known."""
        now, done = time.monotonic(), float(self.at.get("done", 0.0))
        left = (now - self._since) * (1 - done) / done if done > 0 else None
        return {"at": self.at, "seconds": now - self.began, "left": left}


class Seeking:
    """The newest synthesis of a requirement file."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._lock = threading.Lock()
        self._number = 0  # of the question: a page knows by it that an answer is that of its own
        self._run: Run | None = None
        self._ready: Run | None = None
        self._took = 0.0
        self._found: Found | None = None
        self._known: OrderedDict[str, tuple[float, Found]] = OrderedDict()

    def start(self, change: Mapping[str, Any], key: str) -> None:
        """Begin a synthesis and end the one before; ``key`` is what tells one requirement from another."""
        with self._lock:
            self._end()
            self._found = None
            if key in self._known:
                self._took, self._found = self._known[key]
                return
            mine, self._ready = self._ready or Run(), None
            self._run = mine
        found = mine.begin(self._path, change)
        threading.Thread(target=self._wait, args=(mine, found, key), daemon=True).start()

    def prepare(self) -> None:
        """Let a process import what a synthesis needs, so that the next one begins at once."""
        with self._lock:
            self._ready = self._ready or Run()

    def _wait(self, mine: Run, answer: Future[Found], key: str) -> None:
        found: Found | None = None
        with mine.pool, suppress(Exception):
            found = mine.pool.result(answer)
        with self._lock:
            if mine is not self._run:
                return
            self._took = time.monotonic() - mine.began
            self._run = None
            self._found = found or {"error": "the search broke off; please report it"}
            if found and "error" not in found:
                self._known[key] = self._took, found
                while len(self._known) > KEPT:
                    self._known.popitem(last=False)
        self.prepare()

    def state(self) -> dict[str, Any]:
        """How far it is, and what it has found: ``state`` is ``none``, ``runs`` or ``done``."""
        with self._lock:
            number = self._number
            if self._run is not None:
                return {"state": "runs", "number": number, "last": self._took or None, **self._run.state()}
            if self._found is None:
                return {"state": "none", "number": number}
            listed = [
                {key: value for key, value in one.items() if key != "text"}
                for one in self._found.get("designs", ())
            ]
            return {
                **self._found,
                "state": "done",
                "number": number,
                "seconds": self._took,
                "designs": listed,
            }

    def text(self, name: str) -> str:
        """The text of a design that was found; KeyError if it is none of them."""
        with self._lock:
            for one in (self._found or {}).get("designs", ()):
                if one["name"] == name:
                    return str(one["text"])
        raise KeyError(name)

    def stop(self) -> None:
        """End a synthesis that is under way."""
        with self._lock:
            self._end()

    def _end(self) -> None:
        self._number += 1
        run, self._run = self._run, None
        if run is not None:
            run.pool.close()

    def close(self) -> None:
        """End all processes."""
        self.stop()
        if self._ready is not None:
            self._ready.pool.close()
