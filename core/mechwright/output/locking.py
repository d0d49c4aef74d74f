"""Locks between processes, given back by the system whatever ends their process.

Glossary
--------
folder lock
    Whoever has it is the only one who gives names in a folder, for the moment of a rename. It opens nothing
    that is moved: Windows moves nothing that is open.
life lock
    Of a staging folder: a process that lives fills it. Windows opens no folders: there a file beside it has
    the lock, and goes with it.
"""

import contextlib
import errno
import hashlib
import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from mechwright.systems import FOLDERS_OPEN as FOLDERS_OPEN
from mechwright.systems import LOOK_FLAGS, try_lock

PATIENCE = 20.0
"""Seconds until a folder lock has to be free: whoever has it brings one file to the disk."""
_LOOK = 0.005
"""Seconds between two tries."""


@contextmanager
def folder_lock(folder: Path, patience: float = PATIENCE) -> Iterator[bool]:
    """Have the folder lock as long as the block lasts.

    Gives False where the system has no locks, as some network disks, or the folder cannot be opened; then
    nobody has it. Raises OSError where another thread or process has it for longer than ``patience``, in s.
    """
    try:
        handle = _opened(folder)
    except OSError:
        yield False
        return
    try:
        yield _locked(handle, folder, patience)
    finally:
        os.close(handle)  # gives the lock back


def _opened(folder: Path) -> int:
    if not FOLDERS_OPEN:  # the lock is that of a file in the user's temporary folder
        name = hashlib.sha256(os.path.normcase(os.path.realpath(folder)).encode()).hexdigest()
        place = Path(tempfile.gettempdir(), f"mechwright-{name[:32]}.lock")
        return os.open(place, os.O_RDWR | os.O_CREAT)
    return os.open(folder, os.O_RDONLY)


def _locked(handle: int, folder: Path, patience: float) -> bool:
    end = time.monotonic() + patience
    while True:
        try:
            if try_lock(handle):
                return True
        except OSError:
            return False
        if time.monotonic() >= end:
            said = f"another process has been writing in {folder} for {patience:g} s; try again later"
            raise OSError(errno.EAGAIN, said)
        time.sleep(_LOOK)


LIFE = "-life"
"""Behind the name of a staging folder: the file that has its life lock where folders are not opened."""


@contextmanager
def life_lock(path: Path) -> Iterator[bool]:
    """Show that a file or folder is somebody's as long as the block, or the process, lasts.

    False where somebody else has the lock, or has removed the path meanwhile for being nobody's.
    """
    holder = path if FOLDERS_OPEN else path.with_name(path.name + LIFE)
    try:
        handle = os.open(holder, os.O_RDONLY if FOLDERS_OPEN else os.O_RDWR | os.O_CREAT)
    except FileNotFoundError:
        yield False
        return
    except OSError:  # it cannot be opened, by nobody else either
        yield True
        return
    try:
        try:
            ours = try_lock(handle) and path.exists() and os.path.samestat(holder.stat(), os.fstat(handle))
        except OSError:  # some network disks have no locks: then nobody removes anything either
            ours = True
        yield ours
    finally:
        os.close(handle)
        if not FOLDERS_OPEN:
            with contextlib.suppress(OSError):  # whoever looks at it just now removes it
                holder.unlink()


def lives(path: Path) -> bool:
    """Whether a process that lives has the life lock; raises OSError where that cannot be seen."""
    if FOLDERS_OPEN:
        handle = os.open(path, LOOK_FLAGS)
    else:
        try:
            handle = os.open(path.with_name(path.name.removesuffix(LIFE) + LIFE), os.O_RDWR)
        except FileNotFoundError:
            return False
    try:
        return not try_lock(handle)
    finally:
        os.close(handle)
