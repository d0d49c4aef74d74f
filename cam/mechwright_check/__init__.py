"""Checks a program for a mill against its certificate, without any code of those who wrote the two.

Glossary
--------
certificate
    NAME.certificate.json: part, stock, tools, machine and the moves that are claimed for a program.
outcome
    0 confirmed, 1 refuted, 2 not checkable: what stands outside of the words and shapes that are known here.
chord
    A straight piece of path; arcs are cut into chords at most SAG off.
level
    A layer of the part, between two heights, with one cross-section.
"""


class Refuted(Exception):
    """The program, or its certificate, is wrong."""


class Unknown(Exception):
    """Nothing can be said: a word, a pair of words, a state or a shape that is not known here."""


def at(line: int, file: str = "") -> str:
    """How a place in a program is named."""
    return f"{file}: line {line}: " if file else f"line {line}: "
