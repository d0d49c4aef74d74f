"""Words of a line that somebody types, as a shell takes them."""

import os
import shlex
from pathlib import Path

from mechwright.systems import SYSTEM


def word(text: str, *, always: bool = False) -> str:
    """A word in quotes where it needs them; ``always`` one with brackets.

    Some shells take brackets for a pattern.

    >>> word("pair.toml"), word("my pair.toml")
    ('pair.toml', "'my pair.toml'")
    """
    if SYSTEM == "win32" or (always and not set('"$`\\!') & set(text)):
        return f'"{text}"' if always or " " in text else text
    return shlex.quote(text)


def file_word(path: Path | str) -> str:
    """A path as a word that no command takes for an option.

    >>> file_word("-x.toml"), file_word(Path("out/x.toml"))
    ('./-x.toml', 'out/x.toml')
    """
    text = str(path)
    return word(f".{os.sep}{text}" if text.startswith("-") else text)
