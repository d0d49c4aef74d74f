"""The three streams of a process, which may be closed or lead to a full disk."""

import os
import sys

_STREAMS = (("stdin", "r"), ("stdout", "w"), ("stderr", "w"))


def present() -> None:
    """Have all three lead somewhere: the next file that is opened would get the number of a closed one.

    What is printed, by a library or another process, would stand in that file.
    """
    for number, (name, mode) in enumerate(_STREAMS):
        try:
            os.fstat(number)
        except OSError:
            os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)  # it gets the least number that is free
        if getattr(sys, name) is None:
            setattr(sys, name, os.fdopen(number, mode, encoding="utf-8", closefd=False))


def say(line: str) -> None:
    """Say a line on standard error; where nobody can hear it the exit code tells all the same."""
    try:
        print(line, file=sys.stderr)  # noqa: T201 - the program's own words
        sys.stderr.flush()
    except OSError:
        silent(sys.stderr.fileno())


def plain(words: str) -> str:
    r"""Words with each character that is not printable, which could steer a terminal, escaped.

    >>> print(plain("a\x1b[31m.toml"))
    a\x1b[31m.toml
    """
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in words)


def silent(number: int) -> None:
    """Let a stream lead nowhere: the interpreter tries once more at its end, and would complain again."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), number)
