"""Folders beside a target in which its next state is made; what killed processes left there goes.

A staging folder is locked as long as its process lives, whatever ends it: the system gives the lock back.
What has the name of one and no lock is nobody's any more. Where the system has no locks nothing is removed.
"""

import contextlib
import os
import re
import secrets
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

if sys.platform != "win32":
    import fcntl

MARK = ".mechwright-"
"""Between the name of a target and the random end of the name of what is made for it: nobody else's."""
OLD = "-old"
"""Behind the name of a staging folder: what stood in the target's place, for as long as two renames take."""


@contextmanager
def staging_folder(target: Path) -> Iterator[Path]:
    """A new hidden folder beside a target, gone at the end together with what was left there by the dead.

    Its rights are those that the user's mask gives to new folders. Raises OSError where it cannot be made.
    """
    remove_leftovers(target)
    while True:
        folder, ours = temporary_name(target), True
        try:
            folder.mkdir()  # unlike mkdtemp with the rights that the mask leaves
        except FileExistsError:
            continue
        try:
            with locked(folder) as ours:
                if ours:
                    yield folder
                    return
        finally:
            if ours:
                _removed_whole(folder)


def write_through(target: Path, content: bytes) -> None:
    """Put a file in its place in one step; raises OSError, and what stood there stands."""
    remove_leftovers(target)
    temporary = temporary_name(target)
    try:
        with temporary.open("xb") as file, locked(temporary):
            file.write(content)
            to_disk(file)
            temporary.replace(target)
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)


def to_disk(file: IO[bytes]) -> None:
    """Have what was written to a file on the disk: a name that is given before may be that of nothing."""
    file.flush()
    os.fsync(file.fileno())


def folder_to_disk(folder: Path) -> None:
    """The same of the names in a folder, where the system can."""
    with contextlib.suppress(
        OSError, MemoryError
    ):  # what has got its name has it, also without room for this
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def temporary_name(target: Path) -> Path:
    """A name beside a target for its next state; nothing has it yet."""
    return target.with_name(f".{target.name}{MARK}{secrets.token_hex(4)}")


def remove_leftovers(target: Path) -> None:
    """Remove what dead processes have left beside a target; a state that was taken out is put back."""
    if sys.platform == "win32":
        return
    # What stands beside a target is many files at times, and none of them is opened but by its name.
    ours = re.compile(rf"\.{re.escape(target.name)}{re.escape(MARK)}[0-9a-f]{{8}}({OLD})?")
    with contextlib.suppress(OSError):
        for entry in [one for one in target.parent.iterdir() if ours.fullmatch(one.name)]:
            with contextlib.suppress(OSError):
                _remove_dead(entry, target)


def _remove_dead(entry: Path, target: Path) -> None:
    handle = os.open(entry, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)  # OSError: its process lives
        if entry.name.endswith(OLD) and not target.exists():
            entry.rename(target)
        elif entry.is_dir():
            _removed(entry)
        else:
            entry.unlink()
    finally:
        os.close(handle)


@contextmanager
def locked(path: Path) -> Iterator[bool]:
    """Hold the lock of a file or folder as long as the block, or the process, lasts.

    False where somebody else has it, or has removed the path meanwhile for being nobody's.
    """
    if sys.platform == "win32":
        yield True
        return
    try:
        handle = os.open(path, os.O_RDONLY)
    except FileNotFoundError:
        yield False
        return
    try:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            ours = path.exists() and os.path.samestat(path.stat(), os.fstat(handle))
        except BlockingIOError:
            ours = False
        except OSError:  # some network disks have no locks: then nobody removes anything either
            ours = True
        yield ours
    finally:
        os.close(handle)


def _removed_whole(folder: Path) -> None:
    """Remove a folder, also if the keyboard stops that once, or memory is short.

    What stands in the place of the target is decided by then: a folder that cannot be removed is left for the
    next run, and is no reason to say that nothing was written.
    """
    try:
        _removed(folder)
    except KeyboardInterrupt:
        _removed(folder)
        raise
    except Exception:
        with contextlib.suppress(Exception):
            _removed(folder)


def _removed(folder: Path) -> None:
    """Remove a folder; one whose rights forbid that gets other ones."""
    with contextlib.suppress(OSError):
        folder.chmod(0o700)
    shutil.rmtree(folder, ignore_errors=True)
    if folder.exists():  # a want of memory is passed over as well
        shutil.rmtree(folder, ignore_errors=True)
