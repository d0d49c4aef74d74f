"""Files as nobody should write them, given to whoever reads them: read, or refused by name, in time and memory.

Glossary
--------
reader
    What takes a kind of file: ``design``, ``requirement``, ``study``, ``motion-table``, ``tools-...``, ``dxf``,
    ``program-...``.
seed
    A file that is right; cases are changed seeds.
find
    A case that ended otherwise. It goes into ``tests/corpus/READER``, and every file there is tried each day.
"""

import contextlib
import os
import random
import re
import resource
import signal
import tempfile
import time
import traceback
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from hypothesis import strategies as st

from mechwright.contracts.finding import Stage, errors
from mechwright.designs.design import load
from mechwright.designs.requirement import load_requirement
from mechwright.drawings.asked import Asked
from mechwright.drawings.meaning import Meaning
from mechwright.drawings.plate import Cut, part_of
from mechwright.drawings.reading import read
from mechwright.errors import MechwrightError, PluginFaultError
from mechwright.plugins.host import host
from mechwright.reading import read_bytes
from mechwright.studies.study import load_study
from mechwright_cam.controls.contract import Control
from mechwright_cam.shop.formats.known import format_of
from mechwright_cam.shop.library import built_in, load_library
from mechwright_cam.shop.toml_text import library_text

ROOT = Path(__file__).parents[1]
CORPUS = Path(__file__).with_name("corpus")
SECONDS = 20.0
"""Of processor time for one case: a right file of these sizes takes one or two."""
MEGABYTES = 1500
"""That the process may grow to at most."""
LONGEST = 110_000
"""Characters of what is said: fifty lines of two thousand."""

READ, REFUSED = "read", "refused by name"
TRICKY = (
    *("0", "-1", "1", "-0.0", "1e308", "-1e308", "1e-320", "nan", "inf", "true", "false", "[]", "{}", "[[]]"),
    *("''", '""', "9007199254740993", "1e400"),
    "99999999999999999999",
    "'" + "x" * 3000 + "'",
    "[" * 300,
    "(" * 300,
    "\0",
    "\x1b[31m",
    "\ufeff",
    "ſ½²",
    "\u2028",
    "1979-05-27T07:32:00Z",
    "0x7fffffffffffffff",
    "'12 furlongs'",
    "-" * 50,
    "#1=[#1+1]",
    "G2 I0 J0",
    "M98 P1 L99999999",
    "%",
)
_NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
_WORD = re.compile(r"[A-Za-z_][\w-]*")


@dataclass(frozen=True)
class Reader:
    """How a kind of file is read, and right ones of it by the ends of their names."""

    take: Callable[[Path], object]
    seeds: tuple[tuple[str, bytes], ...]


class SlowError(BaseException):
    """The processor time of a case is over."""


def mutated(data: bytes, seed: int, other: bytes = b"") -> bytes:
    """A file with one to six changes: of lines, words, numbers, bytes, or with a piece of another one."""
    rng = random.Random(seed)  # noqa: S311 - changes, no secrets
    text = data.decode("latin-1")
    for _ in range(rng.choice((1, 1, 1, 2, 3, 6))):
        text = rng.choice(_CHANGES)(text, rng, other.decode("latin-1"))
    return text.encode("latin-1", "replace") if rng.random() < 0.5 else text.encode()


def _lines(text: str, rng: random.Random, _: str) -> str:
    lines = text.splitlines(keepends=True) or [""]
    one, two = rng.randrange(len(lines)), rng.randrange(len(lines))
    match rng.randrange(4):
        case 0:
            del lines[one]
        case 1:
            lines.insert(two, lines[one])
        case 2:
            lines[one], lines[two] = lines[two], lines[one]
        case _:
            lines[one:two] = []
    return "".join(lines)


def _replaced(pattern: re.Pattern[str]) -> Callable[[str, random.Random, str], str]:
    def change(text: str, rng: random.Random, _: str) -> str:
        found = list(pattern.finditer(text))
        if not found:
            return text
        one = rng.choice(found)
        if rng.random() < 0.5:
            new = rng.choice(TRICKY)
        elif pattern is _NUMBER:
            new = f"{float(one[0]) * rng.choice((-1, 0, 0.5, 2, 10, 1e3, 1e6, 1e-6)):.6g}"
        else:
            new = rng.choice(found)[0]
        return text[: one.start()] + new + text[one.end() :]

    return change


def _characters(text: str, rng: random.Random, _: str) -> str:
    at = rng.randrange(len(text) + 1)
    return text[:at] + chr(rng.randrange(256)) + text[at + rng.randrange(3) :]


def _cut(text: str, rng: random.Random, _: str) -> str:
    return text[: rng.randrange(len(text) + 1)]


def _spliced(text: str, rng: random.Random, other: str) -> str:
    at, start = rng.randrange(len(text) + 1), rng.randrange(len(other) + 1)
    return text[:at] + other[start : start + rng.randrange(1, 300)] + text[at:]


def _inserted(text: str, rng: random.Random, _: str) -> str:
    at = rng.randrange(len(text) + 1)
    return text[:at] + rng.choice(TRICKY) + text[at:]


_CHANGES = (
    _lines,
    _lines,
    _replaced(_NUMBER),
    _replaced(_NUMBER),
    _replaced(_NUMBER),
    _replaced(_WORD),
    _characters,
    _cut,
    _spliced,
    _inserted,
)


def outcome(reader: str, suffix: str, data: bytes) -> str:
    """What becomes of a file: :data:`READ`, :data:`REFUSED`, or what was wrong, with its place."""
    with tempfile.TemporaryDirectory() as place:
        path = Path(place) / f"case{suffix}"
        path.write_bytes(data)
        begun, had = time.process_time(), memory()
        try:
            with alarm(3 * SECONDS):
                readers()[reader].take(path)
            found = READ
        except PluginFaultError as error:
            found = f"plugin: {str(error).replace(str(path), '')[:200]}"
        except MechwrightError as error:
            said = str(error)
            found = REFUSED if 0 < len(said) <= LONGEST else f"says {len(said)} characters"
        except SlowError:
            return f"slow: more than {3 * SECONDS:g} s"
        except (Exception, SystemExit) as error:  # noqa: BLE001,RUF100 - which is what is sought
            last = traceback.extract_tb(error.__traceback__)[-1]
            found = f"{type(error).__name__} at {Path(last.filename).name}:{last.lineno}: {str(error)[:100]}"
        if time.process_time() - begun > SECONDS:
            return f"slow: {time.process_time() - begun:.0f} s"
        if peak() - had > 1000 * MEGABYTES:
            return "takes much memory"
        return found


def memory() -> int:
    """What the process has, kB, from which its peak is counted anew; where that cannot be, its peak until now."""
    with contextlib.suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5")
    return peak()


def peak() -> int:
    """The most that the process had since :func:`memory` was asked, kB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


@contextlib.contextmanager
def alarm(seconds: float) -> Iterator[None]:
    """Raise SlowError after so many seconds of processor time."""

    def up(*_: object) -> None:
        raise SlowError

    before = signal.signal(signal.SIGVTALRM, up)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def _design(path: Path) -> None:
    design = load(path, host())
    found = design.judge()
    if not errors(found, Stage.MOTION):
        design.solve(91)
    if not errors(found, Stage.PARTS):
        design.parts()


def _drawing(path: Path) -> None:
    asked = Asked()
    drawn = read(read_bytes(path), asked, Meaning("through"))
    part_of(drawn, asked, Cut("case", 5.0, "aluminium"))


def _files(*patterns: str) -> tuple[tuple[str, bytes], ...]:
    found = sorted(path for pattern in patterns for path in (ROOT / "examples").glob(pattern))
    return tuple((path.suffix, path.read_bytes()) for path in found)


_CAM_TABLE = b"""family = "cam-follower"
[parameters]
laws = ["table"]
table = [[0, 0], [0.25, 0.05], [0.5, 0.5], [0.75, 0.95], [1, 1]]
"""


def _libraries() -> Mapping[str, Reader]:
    tools = list(built_in())[:6]
    found = {"tools-own": Reader(load_library, ((".toml", library_text(tools).encode()),))}
    for name in ("crib.json", "crib.tools", "crib.tbl"):
        path = Path(name)
        form = format_of(path)
        assert form is not None
        seeds = tuple((one.suffix, data) for one, data in form.files(tools, path).items())
        found[f"tools-{path.suffix[1:]}"] = Reader(load_library, seeds[:1])
    return found


def _programs() -> Mapping[str, Reader]:
    found = {}
    for control in host().all(Control):
        golden = sorted((ROOT / "tests" / "golden" / "operations").glob(f"*/{control.name}*.nc"))
        seeds = tuple((".nc", path.read_bytes()) for path in golden)
        if seeds:
            found[f"program-{control.name}"] = Reader(
                lambda path, control=control: control.read(path.read_text("utf-8", "replace")),  # type: ignore[misc]
                seeds,
            )
    return found


@cache
def readers() -> Mapping[str, Reader]:
    """All of them, by name."""
    designs = [one for one in _files("*.toml", "motion/*.toml", "chains/*.toml") if b"family" in one[1]]
    plain = [one for one in designs if b"[requirement" not in one[1] and b"[study" not in one[1]]
    return {
        "design": Reader(_design, tuple(plain)),
        "requirement": Reader(lambda path: load_requirement(path, host()), _files("*-requirement.toml")),
        "study": Reader(lambda path: load_study(path, host()), _files("*-study.toml")),
        "motion-table": Reader(_design, ((".toml", _CAM_TABLE), *_files("noncircular-table.toml"))),
        "dxf": Reader(_drawing, _files("*.dxf")),
        **_libraries(),
        **_programs(),
    }


def cases(reader: str) -> st.SearchStrategy[tuple[str, bytes]]:
    """Ends of names and contents of cases."""
    seeds = st.sampled_from(readers()[reader].seeds)
    return st.builds(
        lambda one, other, seed: (one[0], mutated(one[1], seed, other[1])),
        seeds,
        seeds,
        st.integers(0, 2**48),
    )


def corpus(reader: str) -> list[Path]:
    """The finds of a reader."""
    folder = CORPUS / reader
    return sorted(folder.iterdir()) if folder.is_dir() else []


if os.name == "nt":  # pragma: no cover - limits of POSIX
    raise ImportError("fuzzing needs limits of POSIX")
