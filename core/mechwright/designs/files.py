"""Reading files that people write: sizes, encodings, and what lies beside a design file."""

import hashlib
from pathlib import Path
from typing import Any

from mechwright.contracts.file_names import is_text
from mechwright.contracts.inputs import beside as beside
from mechwright.designs.bounded_toml import toml_of
from mechwright.errors import DesignError
from mechwright.reading import INPUT_LIMIT as INPUT_LIMIT
from mechwright.reading import read_bytes as read_bytes

SIZE_LIMIT = 1_000_000
"""Bytes: a design file is some lines; anything larger was given by mistake."""


def read_text(
    path: Path, limit: int = SIZE_LIMIT, *, older: str | None = None, mark: bool = False
) -> tuple[str, str]:
    """Text and SHA-256 of a file; raises OutputError or DesignError that names it.

    The text is UTF-8; where it is not and ``older`` names another encoding, that is taken for a text
    without null bytes. A byte order mark is taken off, unless ``mark`` asks for it.
    """
    if not is_text(str(path)):
        raise DesignError(
            f"{path}: its path is no text in UTF-8, which pages and programs show; rename file or folder"
        )
    data = read_bytes(path, limit)
    return text_of(data, path, older=older, mark=mark), digest_of(data)


def text_of(data: bytes, path: Path, *, older: str | None = None, mark: bool = False) -> str:
    """The text of what a file holds, as :func:`read_text` gives it."""
    try:
        return data.decode("utf-8" if mark else "utf-8-sig")
    except UnicodeDecodeError as error:
        if older is not None and b"\0" not in data:
            return data.decode(older)
        raise DesignError(f"{path}: is no UTF-8 text (byte {error.start}); is it the right file?") from error


def digest_of(content: str | bytes) -> str:
    """SHA-256 of the file that holds a text, or these bytes."""
    return hashlib.sha256(content.encode() if isinstance(content, str) else content).hexdigest()


def read_toml(path: Path) -> tuple[dict[str, Any], str]:
    """Content and SHA-256 of a TOML file; raises DesignError that names file, line and column."""
    text, digest = read_text(path)
    return toml_of(text, path), digest
