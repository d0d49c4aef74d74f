"""A build that a page has asked for: the command ``build`` in a process of its own."""

import os
import subprocess
import sys
import threading
from collections.abc import Mapping
from concurrent.futures import Future
from pathlib import Path
from typing import Any

from mechwright.cli.progress import IN_LINES, line_of
from mechwright.worker_pool.lifeline import COMMAND

_STAY = 5.0
"""Seconds that a process has to end after it was asked to."""


class Building:
    """At most one build at a time, which goes on when the page goes away and is there when it comes back."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._process: subprocess.Popen[str] | None = None
        self._said: list[str] = []
        self._at: dict[str, Any] = {}
        self._printed = ""
        self._lock = threading.Lock()

    @property
    def folder(self) -> Path:
        """Where the files go: beside the design file."""
        return self._path.with_name(f"{self._path.stem}-build")

    @property
    def runs(self) -> bool:
        """Whether a build is under way."""
        return self._process is not None and self._process.poll() is None

    def start(self) -> None:
        """Begin a build of the file as it is; nothing happens where one is under way."""
        with self._lock:  # two pages may ask at once
            if not self.runs:
                self._begin()

    def _begin(self) -> None:
        self._said, self._at, self._printed = [], {}, ""
        begun = Future[None]()
        threading.Thread(target=self._run, args=(begun,), daemon=True).start()
        begun.result()

    def _run(self, begun: Future[None]) -> None:
        """Start the process, which ends with the thread that started it, and listen to it."""
        try:
            self._process = self._started()
        except Exception as error:
            begun.set_exception(error)
            return
        begun.set_result(None)
        self._listen(self._process)

    def _started(self) -> "subprocess.Popen[str]":
        words = ["build", "-o", str(self.folder), "--", str(self._path)]
        return subprocess.Popen(  # noqa: S603 - our own interpreter and a file that the user named
            [sys.executable, "-P", "-c", COMMAND, str(os.getpid()), *words],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            encoding="utf-8",
            errors="replace",
            env={**os.environ, IN_LINES: "1", "NO_COLOR": "1", "PYTHONIOENCODING": "utf-8"},
            start_new_session=True,
        )

    def _listen(self, process: "subprocess.Popen[str]") -> None:
        assert process.stderr is not None  # noqa: S101 - asked for above
        assert process.stdout is not None  # noqa: S101
        for line in process.stderr:
            at = line_of(line)
            if at is None:
                self._said.append(line.rstrip())
            else:
                self._at = at
        self._printed = process.stdout.read().strip()
        process.wait()

    def state(self) -> Mapping[str, Any]:
        """How far it is: ``state`` is ``none``, ``runs``, ``done`` or ``failed``."""
        if self._process is None:
            return {"state": "none", "folder": self.folder.name}
        code = self._process.poll()
        state = "runs" if code is None else "done" if code == 0 else "failed"
        return {
            "state": state,
            "folder": self.folder.name,
            "at": self._at,
            "said": self._said[-50:],
            "printed": self._printed,
        }

    def stop(self) -> None:
        """End a build that is under way; what it was to write is not there then."""
        process = self._process
        if process is None or process.poll() is not None:
            return
        process.terminate()
        try:
            process.wait(_STAY)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
