"""Results of long work, kept on disk by the content of what they were made from."""

import contextlib
import hashlib
import io
import os
import stat
import tempfile
import time
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

from mechwright.errors import UserNote
from mechwright.systems import is_private
from mechwright.worker_pool.content import NoContentError, content_digest
from mechwright.worker_pool.pickling import KnownPickler, KnownUnpickler

T = TypeVar("T")

MOST = 2**30
"""Bytes that a store holds; where it holds more, what has not been used for longest goes."""

_LEFT = 0.8
"""Share of :data:`MOST` that is left then."""

_BETWEEN = 2**26
"""Bytes that a process writes until it looks at the size of the store again."""

_FORGOTTEN = 3600.0
"""Seconds after which a file that was never finished is left over from a process that was killed."""

_HEAD = b"mechwright result\n"
_DIGEST = hashlib.sha256().digest_size


class ResultStore:
    """A folder of results. Several processes may read and write it at any time; a killed one harms nothing.

    A result is found again by its function, by the content of what it was made from, and by the ``stamp``. A
    file that is damaged counts as none. Where the folder cannot be used, one warning says so.

    Parameters
    ----------
    folder
        Where the results are; it is made. It must belong to the user, since what is in it is unpickled.
    stamp
        What changes with everything else that results depend on: the program, its libraries, the processor.
    most
        Bytes that it holds.
    """

    def __init__(self, folder: Path, stamp: bytes, most: int = MOST) -> None:
        self.folder, self._stamp, self._most = folder, stamp, most
        self._written = _BETWEEN
        self._usable = self._prepared()

    def kept(
        self, work: Callable[..., object], item: T, known: Callable[[T], Sequence[object]] | None = None
    ) -> "Kept":
        """The place of the result of ``work`` for an item; ``known`` gives what the result refers to."""
        place = None
        if self._usable:
            with contextlib.suppress(NoContentError):
                place = self._place(content_digest(self._stamp, work, item))
        return Kept(self, place, known(item) if known else ())

    def _place(self, digest: bytes) -> Path:
        name = digest.hex()
        return self.folder / name[:2] / name[2:]

    def _prepared(self) -> bool:
        try:
            self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            private = is_private(self.folder)
        except OSError as error:
            self._stop(error.strerror or str(error))
            return False
        if not private:
            self._stop("others may write there; make it yours alone with chmod 700")
        return private

    def _stop(self, why: str) -> None:
        self._usable = False
        warnings.warn(f"results are not kept in {self.folder}: {why}", UserNote, stacklevel=3)

    def read(self, place: Path) -> bytes | None:
        """A result as it was written; None where there is none, or a damaged one."""
        try:
            found = place.read_bytes()
        except OSError:
            return None
        head, body = found[: len(_HEAD) + _DIGEST], found[len(_HEAD) + _DIGEST :]
        if head != _HEAD + hashlib.sha256(body).digest():
            with contextlib.suppress(OSError):
                place.unlink()
            return None
        with contextlib.suppress(OSError):
            os.utime(place)
        return body

    def write(self, place: Path, body: bytes) -> None:
        """Write a result; it is there as a whole or not at all."""
        if not self._usable or len(body) > self._most:
            return
        try:
            place.parent.mkdir(exist_ok=True)
            with tempfile.NamedTemporaryFile(suffix=".part", dir=self.folder, delete=False) as file:
                unfinished = Path(file.name)
                try:
                    file.write(_HEAD + hashlib.sha256(body).digest() + body)
                    file.close()
                    unfinished.replace(place)
                except BaseException:
                    unfinished.unlink(missing_ok=True)
                    raise
        except OSError as error:
            self._stop(error.strerror or str(error))
            return
        self._written += len(body)
        if self._written >= _BETWEEN:
            self._written = 0
            self._shrink()

    def _shrink(self) -> None:
        """Let go what has not been used for longest, and what killed processes have left."""
        results: list[tuple[float, int, Path]] = []
        now = time.time()
        for place in self.folder.glob("**/*"):
            with contextlib.suppress(OSError):
                state = place.stat()
                if not stat.S_ISREG(state.st_mode):
                    continue
                if place.suffix != ".part":
                    results.append((state.st_mtime, state.st_size, place))
                elif now - state.st_mtime > _FORGOTTEN:
                    place.unlink()
        size = sum(one[1] for one in results)
        if size <= self._most:
            return
        for _, length, place in sorted(results):
            with contextlib.suppress(OSError):
                place.unlink()
            size -= length
            if size <= _LEFT * self._most:
                return


class Kept:
    """The place of one result.

    ``known`` are objects that the result refers to: they are not kept, and stay those of this process.
    """

    def __init__(self, store: ResultStore, place: Path | None, known: Sequence[object]) -> None:
        self._store, self._place, self._known = store, place, known

    def read(self) -> list[Any]:
        """The result, as the only item; empty where it is not kept."""
        body = None if self._place is None else self._store.read(self._place)
        if body is None:
            return []
        try:
            return [KnownUnpickler(io.BytesIO(body), self._known).load()]
        except Exception:
            return []

    def write(self, result: object) -> None:
        """Keep the result, if it can be."""
        if self._place is None:
            return
        buffer = io.BytesIO()
        try:
            KnownPickler(buffer, self._known).dump(result)
        except Exception:
            return
        self._store.write(self._place, buffer.getvalue())
