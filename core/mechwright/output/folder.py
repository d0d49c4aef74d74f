"""Writing output folders: all of the new files or all of the old ones, never a mixture."""

import codecs
import hashlib
import json
import os
import shutil
import stat
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from mechwright.contracts.file_names import file_key, name_fault, path_fault
from mechwright.errors import OutputError
from mechwright.output import locking
from mechwright.output.staging import (
    OLD,
    folder_to_disk,
    move,
    removed,
    staging_folder,
    temporary_name,
    to_disk,
    write_through,
)
from mechwright.reading import kind_of, read_bytes
from mechwright.systems import exchange

MANIFEST = "manifest.json"
Content = str | bytes | Iterable[bytes]
"""Of a file: text, bytes, or bytes in pieces."""

C = TypeVar("C", bound=Content)

_OPEN_ELSEWHERE = (5, 32)
"""Windows' numbers of the errors by which it refuses to move what a program has open."""


class ChangedError(OutputError):
    """A file is another than the one that was read."""


@dataclass
class Output:
    """The files of one run, in memory until all are there; long ones are made as they are written."""

    files: dict[str, bytes | Iterable[bytes]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        # By what file systems compare.
        self._names = {file_key(name): name for name in self.files}

    def add(self, name: str, content: Content) -> None:
        """Add a file; ``name`` is a plain file name. What comes in pieces is asked for once.

        Raises OutputError for a name that is no file on some system, or the same file as another one.
        """
        if fault := name_fault(name):
            raise OutputError(f"{name!r} {fault}; rename what it is of")
        key = file_key(name)
        known = self._names.get(key, MANIFEST if key == MANIFEST else None)
        if known is not None:
            raise OutputError(f"the files {known!r} and {name!r} would be one; rename what one of them is of")
        self._names[key] = name
        self.files[name] = content.encode() if isinstance(content, str) else content


def distinct_files(files: Iterable[tuple[str, C]]) -> dict[str, C]:
    """Name to content; raises OutputError as :meth:`Output.add` does: no file takes another's place."""
    names, found = Output(), dict[str, C]()
    for name, content in files:
        names.add(name, b"")
        found[name] = content
    return found


def write_folder(target: Path, output: Output, command: str, facts: Mapping[str, Any]) -> None:
    """Put the files of a run into ``target`` in one step, with a manifest of its command and facts.

    The folder is new, empty, or one that an earlier run has written: its other files stay, but for those that
    the same command wrote before and no longer writes; its parent is made where it is not there. Raises
    OutputError where it holds files of somebody else, or cannot be written: nothing has changed then.
    """
    target, old = _examined(target)
    made = 0
    try:
        _make_parents(target)
        with staging_folder(target) as staged:
            staging = staged.path
            stale = {name for name, entry in old.items() if command in {entry.get("command"), "build"}}
            kept = {name: entry for name, entry in old.items() if name not in stale}
            there = target.exists()
            if there:
                _carry_over(target, staging, stale | {MANIFEST} | set(output.files))
            entries = {name: entry for name, entry in kept.items() if (staging / name).exists()}
            for name, content in output.files.items():
                entries[name] = {"command": command, "sha256": _written(staging / name, content)}
            manifest = {**facts, "outputs": dict(sorted(entries.items()))}
            said = json.dumps(manifest, indent=2, sort_keys=True) + "\n"
            _written(staging / MANIFEST, said.encode())
            folder_to_disk(staging)
            if there:
                shutil.copymode(target, staging)
            made = staging.stat().st_ino
            with staged.complete(target):
                _swap(staging, target)
            folder_to_disk(target.parent)
    except OSError as error:
        raise _refusal(target, error) from error
    except (MemoryError, TypeError):  # the second is what becomes of the first where a path is read
        if not made or not target.exists() or target.stat().st_ino != made:
            raise  # else it came after the step that counts: the files are there, and that is what is told


def _make_parents(target: Path) -> None:
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
    except RecursionError as error:
        raise OutputError(
            f"{target}: cannot be written: too many folders deep; nothing was changed"
        ) from error


def _written(path: Path, content: bytes | Iterable[bytes]) -> str:
    """Write a file, and give its digest."""
    digest = hashlib.sha256()
    with path.open("wb") as file:
        for piece in (content,) if isinstance(content, bytes) else content:
            file.write(piece)
            digest.update(piece)
        to_disk(file)
    return digest.hexdigest()


def check_folder(target: Path) -> None:
    """Raise OutputError if :func:`write_folder` would refuse ``target``, before any work.

    Where a system moves nothing that is open, the folder is moved and moved back: a table that a spreadsheet
    shows would otherwise be noticed after all the work.
    """
    target, _ = _examined(target)
    if locking.FOLDERS_OPEN or not target.exists():
        return
    try:
        with locking.folder_lock(target.parent):
            aside = temporary_name(target)
            aside = aside.with_name(
                aside.name + OLD
            )  # which the next run puts back, should this one die here
            move(target, aside)
            move(aside, target)
    except OSError as error:
        raise _refusal(target, error) from error


def _examined(target: Path) -> tuple[Path, dict[str, dict[str, str]]]:
    """The folder itself, behind any symbolic link, and what an earlier run wrote into it."""
    _require_name(target)
    try:
        here = _current()
        if here is None and not target.is_absolute():
            raise OutputError(f"{target}: cannot be written: the current folder is gone; nothing was changed")
        target = target.resolve()
        if os.path.ismount(target):
            raise OutputError(
                f"{target}: is a disk of its own, and cannot be replaced in one step; give a folder in it, "
                f"such as -o {target / 'out'}"
            )
        if here is not None and here.is_relative_to(target):
            raise OutputError(
                f"{target}: is the current folder or above it, and cannot be replaced in one step; "
                "give a folder below it, such as -o out"
            )
        return target, _earlier_run(target)
    except (OSError, RuntimeError) as error:  # RuntimeError: a loop of links
        raise _refusal(target, error) from error


def _require_name(path: Path) -> None:
    if fault := path_fault(path):
        raise OutputError(f"{path}: cannot be written: the name {fault}; give another name")


def _current() -> Path | None:
    """The current folder; None where somebody has removed it."""
    try:
        return Path.cwd()
    except FileNotFoundError:
        return None


def _refusal(target: Path, error: OSError | RuntimeError) -> OutputError:
    if isinstance(error, OutputError):
        return error
    return OutputError(f"{target}: cannot be written: {_reason(error)}; nothing was changed")


def _reason(error: OSError | RuntimeError) -> object:
    reason = getattr(error, "strerror", None) or error
    if getattr(error, "winerror", None) in _OPEN_ELSEWHERE:
        return f"{reason}: close the programs and terminals that have it open"
    return reason


def _earlier_run(target: Path) -> dict[str, dict[str, str]]:
    """What the manifest in the folder lists; empty for a new or empty folder."""
    if not target.exists() or (target.is_dir() and not any(target.iterdir())):
        return {}
    if not target.is_dir():
        raise OutputError(f"{target}: is no folder; give a new or an empty one with -o")
    try:
        outputs = json.loads(read_bytes(target / MANIFEST, anew=True))["outputs"]
        return {str(name): dict(entry) for name, entry in outputs.items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise OutputError(
            f"{target}: holds files that this program has not written; give a new or an empty folder with -o"
        ) from None


def _carry_over(target: Path, staging: Path, leave: set[str]) -> None:
    names = {file_key(name) for name in leave}
    for entry in sorted(target.iterdir()):
        if file_key(entry.name) in names and not entry.is_dir():
            continue
        if entry.is_dir() and not entry.is_symlink():
            shutil.copytree(entry, staging / entry.name, symlinks=True, copy_function=_link)
        else:
            _link(str(entry), str(staging / entry.name))


def _link(source: str, target: str) -> None:
    try:
        os.link(source, target, follow_symlinks=False)
    except (OSError, NotImplementedError):  # not every system links links
        mode = os.lstat(source).st_mode
        if not stat.S_ISLNK(mode) and (kind := kind_of(mode)):
            raise OutputError(
                f"{source}: is {kind}, which cannot be copied; take it out of the folder"
            ) from None
        shutil.copy2(source, target, follow_symlinks=False)


def _swap(staging: Path, target: Path) -> None:
    """Put ``staging`` in the place of ``target``; then ``staging`` holds what was there, if anything."""
    if not target.exists():
        move(staging, target)
        return
    if exchange(staging, target):
        return
    # No atomic exchange on this system: two renames, undone if the second fails.
    backup = staging.with_name(staging.name + OLD)
    move(target, backup)
    try:
        move(staging, target)
    except BaseException:
        move(backup, target)
        raise
    removed(backup)


def write_new(path: Path, text: str | bytes, *, replace: bool = False) -> None:
    """Write ``text`` to ``path`` in one step; refuses to replace a file unless told to."""

    def permitted() -> None:
        if path.exists():
            if not replace:
                raise OutputError(f"{path}: is there already; give another name, or --force to replace it")
            if kind := kind_of(path.stat().st_mode):
                raise OutputError(f"{path}: is {kind}, which is not replaced; give another name")

    _require_name(path)
    permitted()
    _write(path, text, permitted)


def rewrite(path: Path, text: str, like: Path | None = None, known: str | None = None) -> None:
    """Write a file in one step, behind a link, with the rights of ``like``, or those that it has itself.

    Raises OutputError where it cannot be written, or is no more what has the SHA-256 ``known``: of several
    that rewrite one state, threads or processes, one can. Without ``known`` the file is a new one. A byte
    order mark of the old file stays.
    """
    real = path.resolve()

    def permitted() -> None:
        if known is None and real.exists():
            raise OutputError(f"{path}: is there already; give another name")
        if known is not None and hashlib.sha256(read_bytes(real, anew=True)).hexdigest() != known:
            raise ChangedError(
                f"{path}: has changed on disk since it was read; look at it first, then try again"
            )

    permitted()
    if known is not None and read_bytes(real, anew=True).startswith(codecs.BOM_UTF8):
        text = "\ufeff" + text.removeprefix("\ufeff")
    _write(real, text, permitted, (like or path).stat().st_mode & 0o777)


def _write(path: Path, text: str | bytes, permitted: Callable[[], None], rights: int | None = None) -> None:
    try:
        data = text.encode() if isinstance(text, str) else text
        write_through(path, data, rights=rights, before=permitted)
    except OutputError:
        raise
    except OSError as error:
        raise OutputError(f"{path}: cannot be written: {_reason(error)}") from error
