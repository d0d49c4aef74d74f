"""What a file of a sweep says of itself: its study and designs, and that it is as it was written.

Glossary
--------
stamp
    Study, program, and numbers of designs: a file in another one's place is known by it.
seal
    SHA-256 of all bytes of the file, itself left blank: a file of which any byte is another is known by it.
"""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Self

from mechwright.studies.fingerprint import fingerprint_of
from mechwright.studies.study import Study

STAMP, SEAL = b"mechwright.stamp", b"mechwright.seal"
"""Keys of a file's metadata."""
_MARK, _DIGITS = b"sha256:", 64
BLANK = (_MARK + b"0" * _DIGITS).decode()
"""Value of the second one until the file is sealed."""


@dataclass(frozen=True)
class Stamp:
    """Which designs of which study a file covers.

    Parameters
    ----------
    study, program
        Digest of the study, and what tells the program apart.
    first, designs
        Number of the first design, and how many there are.
    slice
        Number of a slice of them; None of a whole table.
    """

    study: str
    program: str
    first: int
    designs: int
    slice: int | None = None

    @classmethod
    def of(cls, study: Study, first: int, designs: int, number: int | None = None) -> Self:
        """That of some designs of a study, as this program makes their file."""
        return cls(study.digest, fingerprint_of(study.family), first, designs, number)

    @property
    def metadata(self) -> dict[bytes, str]:
        """What goes into the file before it is :func:`sealed`."""
        return {STAMP: json.dumps(asdict(self), sort_keys=True), SEAL: BLANK}

    def require_in(self, metadata: Mapping[bytes, bytes]) -> None:
        """Raise ValueError where the metadata of a file say that it is another one."""
        if STAMP not in metadata:
            raise ValueError("it does not say of which designs it is")
        found = type(self)(**json.loads(metadata[STAMP]))
        if found.study != self.study:
            raise ValueError("it is of another study")
        if found.program != self.program:
            raise ValueError(f"it is by another program, which had {found.program!r:.300}")
        if found != self:
            raise ValueError(f"it holds {found._what()}; here belong {self._what()}")

    def _what(self) -> str:
        part = "" if self.slice is None else f"slice {self.slice} of "
        return f"{part}the designs {self.first} to {self.first + self.designs - 1}"


def sealed(content: bytes) -> bytes:
    """A file whose metadata have the blank seal, with its seal."""
    place = _place(content)
    return content[:place] + _digest(content, place) + content[place + _DIGITS :]


def require_sealed(content: bytes) -> None:
    """Raise ValueError where a file is not as it was written."""
    place = _place(content)
    if content[place : place + _DIGITS] != _digest(content, place):
        raise ValueError("it is not as it was written")


def _place(content: bytes) -> int:
    """Where the digits of the seal begin: metadata are the last that has texts in it."""
    if (found := content.rfind(_MARK)) < 0:
        raise ValueError("it has no seal")
    return found + len(_MARK)


def _digest(content: bytes, place: int) -> bytes:
    found = hashlib.sha256(content[:place])
    found.update(content[place + _DIGITS :])
    return found.hexdigest().encode()
