"""Plugins of others are loaded in a second process first; one that ends or spoils it is named and not used.

Glossary
--------
trial
    Loading what a distribution registers, in a process of its own that may die of it.
verdict
    Why a plugin is not used, in words that follow its name; empty if nothing is wrong with it.
"""

import contextlib
import json
import os
import pickle
import signal
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import EntryPoint

from mechwright.contracts import guard
from mechwright.systems import kill_group

VERDICTS = "MECHWRIGHT_PLUGIN_VERDICTS"
"""Environment variable by which processes that this one starts know what it has found, as JSON."""
DEAF = 78
"""Exit code of a trial whose answers lead nowhere any more."""
WHILE, AT_END = "while it is loaded", "when the program ends"
"""What is being done with a plugin."""
_MORE = 15.0
"""Seconds above the time for loading, within which the alarm of the process itself should have ended it."""

_TRY = (
    "import pickle, sys; sys.path[:], *setup = pickle.load(sys.stdin.buffer); "
    "from mechwright.plugins.trial_process import attempt; attempt(*setup)"
)


@dataclass(frozen=True)
class Candidate:
    """A plugin that is to be tried."""

    distribution: str
    point: EntryPoint

    @property
    def key(self) -> str:
        """By which a verdict is known."""
        return f"{self.distribution}: {self.point.group}: {self.point.name} = {self.point.value}"


def verdicts(candidates: Sequence[Candidate]) -> dict[str, str]:
    """Verdict of each by its key; none of those for whom no process can be started.

    All are tried in one process. If it dies, whoever was being loaded is named and the rest is tried in
    another one. Processes that this one starts know the verdicts and try nothing.
    """
    known = _known()
    found = {one.key: known[one.key] for one in candidates if one.key in known}
    rest = [one for one in candidates if one.key not in found]
    while rest:
        tried = _tried(rest)
        if tried is None:
            break
        found |= tried
        rest = [one for one in rest if one.key not in found]
    os.environ[VERDICTS] = json.dumps(known | found)
    return found


def _known() -> dict[str, str]:
    with contextlib.suppress(ValueError):
        found = json.loads(os.environ.get(VERDICTS, "{}"))
        if isinstance(found, dict):
            return {str(key): str(value) for key, value in found.items()}
    return {}


def _tried(candidates: Sequence[Candidate]) -> dict[str, str] | None:
    """The verdicts of one process: at least one; None where no process can be started."""
    setup = sys.path, sys.argv, [(one.distribution, one.point) for one in candidates], guard.LOADING
    try:
        code, lines = _answers(pickle.dumps(setup), len(candidates) * (guard.LOADING + _MORE))
    except OSError:
        return None
    last = {number: (when, said) for number, when, said in lines}
    if not last.pop(-1, None) or not last:
        return None
    return {
        candidates[number].key: _death(code, when) if said is None else said
        for number, (when, said) in last.items()
    }


def _answers(setup: bytes, seconds: float) -> tuple[int | None, list[tuple[int, str, str | None]]]:
    """Exit code, None if it took too long; and number, what was done, and verdict of each line."""
    with tempfile.TemporaryFile() as out:
        process = subprocess.Popen(  # noqa: S603 - our own interpreter and words
            [sys.executable, "-P", "-c", _TRY],
            stdin=subprocess.PIPE,
            stdout=out,
            stderr=subprocess.DEVNULL,
            start_new_session=True,  # a signal to its group is not for this process
        )
        code: int | None = None
        try:
            process.communicate(setup, seconds)
            code = process.returncode
        except subprocess.TimeoutExpired:
            pass
        finally:
            kill_group(process)
        out.seek(0)
        lines = out.read().decode(errors="replace").splitlines()
    found = []
    for line in lines:
        with contextlib.suppress(ValueError):
            number, when, said = json.loads(line)
            found.append((number, when, said))
    return code, found


def _death(code: int | None, when: str) -> str:
    if code is None:
        return f"takes more than {guard.LOADING:g} s {when}"
    if code == DEAF:
        return f"closes files that others have open, or spoils the interpreter, {when}"
    if code < 0:
        with contextlib.suppress(ValueError):
            return f"is killed by {signal.Signals(-code).name} {when}"
    return f"ends the program with exit code {code} {when}"
