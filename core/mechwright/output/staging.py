"""Folders beside a target in which its next state is made; what killed processes left there goes.

A staging folder has a life lock as long as its process fills it; what has the name of one and no lock is
nobody's any more. Files and folders are moved to their places closed, under the lock of the folder that they
stand in. Where a disk has no locks nothing is removed.
"""

import contextlib
import os
import re
import secrets
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from mechwright.output.locking import LIFE, folder_lock, life_lock, lives
from mechwright.systems import MOVE_AGAIN

MARK = ".mechwright-"
"""Between the name of a target and the random end of the name of what is made for it: nobody else's."""
OLD = "-old"
"""Behind the name of a staging folder: what stood in the target's place, for as long as two renames take."""


@dataclass(frozen=True)
class Staging:
    """A staging folder, and its life lock."""

    path: Path
    life: ExitStack

    @contextmanager
    def complete(self, target: Path) -> Iterator[None]:
        """The folder is as it should be: within the block it is moved, closed and under the folder lock."""
        with folder_lock(target.parent):
            self.life.close()
            yield


@contextmanager
def staging_folder(target: Path) -> Iterator[Staging]:
    """A new hidden folder beside a target, gone at the end together with what was left there by the dead.

    Its rights are those that the user's mask gives to new folders. Raises OSError where it cannot be made.
    """
    remove_leftovers(target)
    while True:
        folder, ours = temporary_name(target), False
        with ExitStack() as life:
            try:
                with folder_lock(target.parent):  # nobody takes it for one of the dead before it has its lock
                    try:
                        folder.mkdir()  # unlike mkdtemp with the rights that the mask leaves
                    except FileExistsError:
                        continue
                    ours = True
                    ours = life.enter_context(life_lock(folder))
                if ours:
                    yield Staging(folder, life)
                    return
            finally:
                life.close()
                if ours:
                    _removed_whole(folder)


def write_through(
    target: Path, content: bytes, *, rights: int | None = None, before: Callable[[], None] | None = None
) -> None:
    """Put a file in its place in one step; raises OSError, and what stood there stands.

    Parameters
    ----------
    target
        Its place.
    content
        What it holds.
    rights
        Of the new file; by default those that the user's mask leaves.
    before
        Called under the folder lock, when nothing is left to do but the step itself; it raises where what
        stands there is not to be replaced. Of several at once that would replace one state, one can.
    """
    with folder_lock(target.parent) as ours:
        if ours:
            _remove_dead(target)
        temporary = temporary_name(target)
        try:
            with temporary.open("xb") as file:
                if rights is not None:
                    temporary.chmod(rights)
                file.write(content)
                to_disk(file)
            if before is not None:
                before()
            move(temporary, target)
        finally:
            with contextlib.suppress(OSError):
                temporary.unlink(missing_ok=True)


def move(source: Path, target: Path) -> None:
    """Give a file or folder, which nothing has open, another name; a file that has that name is replaced."""
    for wait in MOVE_AGAIN:
        try:
            source.replace(target)
        except PermissionError:
            time.sleep(wait)
        else:
            return
    source.replace(target)


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
    with contextlib.suppress(OSError), folder_lock(target.parent, 0.0) as ours:
        if ours:
            _remove_dead(target)


def _remove_dead(target: Path) -> None:
    """The same under the folder lock, without which what stands beside a target may be of the living."""
    # What stands beside a target is many files at times, and none of them is opened but by its name.
    ours = re.compile(rf"\.{re.escape(target.name)}{re.escape(MARK)}[0-9a-f]{{8}}({OLD}|{LIFE})?")
    with contextlib.suppress(OSError):
        for entry in [one for one in target.parent.iterdir() if ours.fullmatch(one.name)]:
            with contextlib.suppress(OSError):
                if not lives(entry):
                    _remove_one(entry, target)


def _remove_one(entry: Path, target: Path) -> None:
    if entry.name.endswith(OLD) and not target.exists():
        move(entry, target)
    elif entry.is_dir():
        removed(entry)
    else:
        entry.unlink()


def _removed_whole(folder: Path) -> None:
    """Remove a folder, also if the keyboard stops that once, or memory is short.

    What stands in the place of the target is decided by then: a folder that cannot be removed is left for the
    next run, and is no reason to say that nothing was written.
    """
    try:
        removed(folder)
    except KeyboardInterrupt:
        removed(folder)
        raise
    except Exception:
        with contextlib.suppress(Exception):
            removed(folder)


def removed(folder: Path) -> None:
    """Remove a folder; one whose rights forbid that gets other ones."""
    with contextlib.suppress(OSError):
        folder.chmod(0o700)
    shutil.rmtree(folder, ignore_errors=True)
    if folder.exists():  # a want of memory is passed over as well
        shutil.rmtree(folder, ignore_errors=True)
