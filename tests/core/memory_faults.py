"""Allocations that fail while a folder is written, and commands with less room than they need."""

import contextlib
import os
import resource
import shutil
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path

from mechwright.errors import OutputError
from mechwright.output.folder import Output, write_folder

LAST = 1 << 17
"""More allocations than writing takes."""
PATIENCE = 10
"""Seconds for one writing of some milliseconds."""
TELLS, SAYS_NOTHING, MISTAKEN, SUCCEEDS = 3, 4, 5, 0


def files(text: str) -> Output:
    """Four files that hold a text."""
    output = Output()
    for number in range(4):
        output.add(f"file-{number}", [f"{text} {number} ".encode() * 3000] * 2)
    return output


def stands(folder: Path) -> tuple[tuple[str, bytes], ...]:
    """What is below a folder, by name."""
    found = (path for path in sorted(folder.rglob("*")) if path.is_file())
    return tuple((str(path.relative_to(folder)), path.read_bytes()) for path in found)


def write(folder: Path, text: str) -> None:
    """Write the folder."""
    write_folder(folder / "out", files(text), "build", {"design": text})


def failing(folder: Path, first: int, last: int) -> int:
    """Exit code of a fork that writes while its allocations from ``first`` on fail, up to ``last``; 0 for all.

    ``TELLS`` where an error of ours or of memory came out that the command line says in one line.
    """
    import _testcapi  # noqa: PLC2701 - nobody else can

    child = os.fork()
    if not child:
        code, output = SAYS_NOTHING, files("new")
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.alarm(PATIENCE)
        with contextlib.suppress(BaseException):
            try:
                _testcapi.set_nomemory(first, last)
                write_folder(folder / "out", output, "build", {"design": "new"})
                _testcapi.remove_mem_hooks()
                code = SUCCEEDS
            except (MemoryError, OutputError):
                _testcapi.remove_mem_hooks()
                code = TELLS
            except TypeError as error:  # which the interpreter makes of it where it reads a path
                _testcapi.remove_mem_hooks()
                code = MISTAKEN if "PosixPath" in str(error) else SAYS_NOTHING
        os._exit(code)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def needed(folder: Path) -> int:
    """How many allocations writing takes: from so many on it does not matter that all others fail."""
    low, high = 0, LAST
    while low < high:
        middle = (low + high) // 2
        fresh(folder)
        low, high = (low, middle) if failing(folder, middle, 0) == SUCCEEDS else (middle + 1, high)
    return low


def fresh(folder: Path) -> None:
    """Nothing but the files of before."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    write(folder, "old")


def outcomes(folder: Path, steps: Iterable[int]) -> Iterator[tuple[str, int]]:
    """What comes of one failing allocation at each of these steps, and what stands in the folder then."""
    fresh(folder)
    before = stands(folder / "out")
    write(folder, "new")
    after = stands(folder / "out")
    for step in steps:
        fresh(folder)
        code = failing(folder, step, step + 1)
        what = {before: "old", after: "new"}.get(stands(folder / "out"), "mixed")
        left = [path.name for path in folder.iterdir() if path.name != "out"]
        yield _word(code, what, left), step


def _word(code: int, what: str, left: list[str]) -> str:
    if what == "mixed":
        return "mixed files"
    if left and code >= 0:
        return "left behind"
    if code == SUCCEEDS and what == "new":
        return "written"
    if code == TELLS and what == "old":
        return "refused"
    if code == MISTAKEN and what == "old":
        return "refused, as another error"
    if code < 0:
        return f"ended by {signal.Signals(-code).name}, {what} files"
    return f"wrong: code {code}, {what} files"


def bounded(words: list[str], megabytes: int) -> "subprocess.CompletedProcess[str]":
    """A command with so much room for addresses."""
    most = megabytes << 20

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (most, most))

    return subprocess.run(
        [sys.executable, "-m", "mechwright", *words],
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
        preexec_fn=limit,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
    )


def counted(folder: Path, every: int) -> tuple[int, Counter[str]]:
    """How many allocations there are, and outcomes of every so many of them."""
    count = needed(folder)
    return count, Counter(word for word, _ in outcomes(folder, range(0, count + 1, every)))
