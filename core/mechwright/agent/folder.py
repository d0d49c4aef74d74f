"""The folder below which an agent may read and write."""

import codecs
from pathlib import Path

from mechwright.designs.files import digest_of, read_text
from mechwright.errors import DesignError
from mechwright.output.folder import rewrite, write_new

TEXTS = (".toml", ".csv")
"""Endings of the files that an agent may write by itself: designs, requirements, shops, tables."""

LARGEST = 1_000_000
"""Characters of a text that an agent may write."""

SHOWN = 50_000
"""Characters of a text that are shown at once."""

LISTED = 500
"""Files that are listed at once."""


class Folder:
    """A folder, and the files below it.

    Parameters
    ----------
    root
        The folder; raises DesignError where it is none.
    """

    def __init__(self, root: Path) -> None:
        if not root.is_dir():
            raise DesignError(f"{root}: is no folder; name one that is there")
        self.root = root.resolve()

    def path(self, name: str) -> str:
        """A path as a word of a command in the folder, behind links as well.

        Raises DesignError for a path that is absolute, begins with a hyphen, or leads out of the folder.
        """
        given = Path(name)
        if not name or "\0" in name or given.is_absolute() or name.startswith(("-", "~")):
            raise DesignError(f"{name!r}: is no path below the folder; write one such as designs/pair.toml")
        try:
            found = (self.root / given).resolve()
        except (OSError, RuntimeError) as error:
            raise DesignError(f"{name!r}: cannot be followed: {error}") from error
        if not found.is_relative_to(self.root):
            raise DesignError(f"{name!r}: leads out of the folder that this server was given")
        return str(given)

    def files(self) -> list[str]:
        """Names of the files below it, in order; at most :data:`LISTED`."""
        found = (one for one in sorted(self.root.rglob("*")) if one.is_file())
        shown = [str(one.relative_to(self.root)) for one in found if not one.name.startswith(".")]
        return [*shown[:LISTED], *([f"... and {len(shown) - LISTED} more"] if len(shown) > LISTED else [])]

    def text(self, name: str, start: int = 0) -> str:
        """Part of the text of a file, from a character on; the last line says where it goes on."""
        whole, _ = read_text(self.root / self.path(name))
        if "\0" in whole:
            raise DesignError(f"{name}: is no text")
        shown = whole[start : start + SHOWN]
        left = len(whole) - start - len(shown)
        return f"{shown}\n... {left} more characters: start = {start + len(shown)}" if left > 0 else shown

    def write(self, name: str, text: str, *, replace: bool) -> str:
        """Write a text, and say so.

        Raises DesignError for a file of another kind or a text that is too long, OutputError for a file that
        is there already and shall not be replaced.
        """
        path = self.root / self.path(name)
        if path.suffix not in TEXTS:
            raise DesignError(f"{name}: only {' and '.join(TEXTS)} are written so; commands write the rest")
        if len(text) > LARGEST:
            raise DesignError(f"{name}: has {len(text):,} characters; the limit is {LARGEST:,}")
        if replace and path.exists():
            old, digest = read_text(path, mark=True)
            if old.removeprefix(codecs.BOM_UTF8.decode()) != text:
                rewrite(path, text, known=digest)
            return f"{name}: replaced"
        write_new(path, text)
        return f"{name}: written, SHA-256 {digest_of(text)}"
