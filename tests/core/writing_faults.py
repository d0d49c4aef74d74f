"""Faults of the disk at every step of writing a folder, one process each: what stands afterwards."""

import errno
import os
import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

SOURCE = Path(__file__).with_name("faults.c")
KINDS = {
    "no space": (errno.ENOSPC, ""),
    "input/output error": (errno.EIO, ""),
    "no rights": (errno.EACCES, ""),
    "rename": (errno.EIO, "rename"),
    "fsync": (errno.EIO, "fsync"),
}
"""Five kinds: which error, and of which call; empty for any."""

WRITER = """
import sys
from pathlib import Path
from mechwright.errors import OutputError
from mechwright.output.folder import Output, write_folder
output = Output()
for number in range(4):
    output.add(f"file-{number}", [f"{sys.argv[2]} {number} ".encode() * 3000] * 2)
try:
    write_folder(Path(sys.argv[1]), output, "build", {"design": sys.argv[2]})
except OutputError as error:
    sys.exit(str(error))
"""


@dataclass(frozen=True)
class Shim:
    """The library that makes calls fail, and a folder to work in."""

    library: Path
    folder: Path

    def write(self, text: str, **fault: object) -> "subprocess.CompletedProcess[str]":
        """Write a folder of files that hold a text, in a process of its own."""
        known = {f"FAULT_{key.upper()}": str(value) for key, value in fault.items()}
        environment = {**os.environ, **known}
        if fault:
            environment |= {"LD_PRELOAD": str(self.library), "FAULT_UNDER": str(self.folder)}
        call = [sys.executable, "-c", WRITER, str(self.folder / "out"), text]
        return subprocess.run(call, env=environment, capture_output=True, text=True, check=False, timeout=60)

    def steps(self, call: str, text: str) -> int:
        """How many calls there are that could fail."""
        log = self.folder.parent / "calls"
        log.unlink(missing_ok=True)
        self.write(text, at=0, call=call, log=log)
        return len(log.read_text().splitlines()) if log.exists() else 0

    def state(self) -> tuple[tuple[str, bytes], ...]:
        """What stands below the folder, by name."""
        found = (path for path in sorted(self.folder.rglob("*")) if path.is_file())
        return tuple((str(path.relative_to(self.folder)), path.read_bytes()) for path in found)


def built(folder: Path) -> Shim | None:
    """The library, compiled; None without a compiler or where nothing can be loaded before others."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None or not sys.platform.startswith("linux"):
        return None
    library = folder / "faults.so"
    words = [compiler, "-shared", "-fPIC", "-O1", "-o", str(library), str(SOURCE), "-ldl"]
    if subprocess.run(words, capture_output=True, check=False).returncode:
        return None
    (folder / "work").mkdir()
    return Shim(library, folder / "work")


def outcomes(shim: Shim, kind: str, every: int = 1, *, old: bool = True) -> Iterator[tuple[str, int]]:
    """What comes of a fault at each step, or at every so many: words, and the number of the step."""
    number, call = KINDS[kind]
    work = shim.folder

    def fresh() -> None:
        shutil.rmtree(work)
        work.mkdir()
        if old:
            shim.write("old")

    fresh()
    before = shim.state()
    count = shim.steps(call, "new")
    after = shim.state()
    for step in range(1, count + 1, every):
        fresh()
        done = shim.write("new", at=step, errno=number, call=call)
        stands = {before: "old", after: "new"}.get(shim.state(), "mixed")
        left = [path.name for path in work.iterdir() if path.name != "out"]
        said = "told" if os.strerror(number) in done.stderr and "nothing was changed" in done.stderr else ""
        lines = len(done.stderr.splitlines())
        yield _word(done.returncode, stands, said, lines, left), step


def _word(code: int, stands: str, said: str, lines: int, left: list[str]) -> str:
    if left:
        return f"left behind: {left[0]}"
    if code == 0 and stands == "new":
        return "written"
    if code == 1 and stands == "old" and said and lines == 1:
        return "refused"
    return f"wrong: code {code}, {stands} files, {lines} lines{', told' if said else ''}"


def counted(shim: Shim, every: int = 1) -> dict[str, Counter[str]]:
    """Outcomes of each kind, over a folder that is there, and one that is not."""
    return {
        f"{kind}, {'old' if old else 'no'} folder": Counter(
            word for word, _ in outcomes(shim, kind, every, old=old)
        )
        for kind in KINDS
        for old in (True, False)
    }
