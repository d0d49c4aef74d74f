"""Checks a program for a mill against its certificate, without any code of those who wrote the two.

Read ``words`` (what each control may be told), ``reading`` (moves and states), ``geometry``, ``checks`` (what
moves do to the part), ``certificate`` and ``drawing`` (what is held against the moves). Lengths are mm.
"""


class RefutedError(Exception):
    """The program, or its certificate, is wrong."""


class UnknownError(Exception):
    """Nothing can be said: a word, a pair of words, a state or a shape that is not known here."""
