"""The error tree.

Every error that a user can cause derives from :class:`MechwrightError` and from the built-in type that a
caller would catch anyway. The command line prints such an error as one line and no traceback. A message
says what is wrong, where, the limit, and what to do. However long the values are that it names, it has a
bounded length itself.
"""

from collections.abc import Iterable

LONGEST = 2_000
"""Characters of a line of a message: more is some value, of which beginning and end tell what it was."""

_BEGINNING, _END = 600, 400
"""Characters that are kept of a longer one: few enough that a place told before it makes it no longer one."""

MOST_LINES = 50
"""Lines of a message: whoever has mended fifty mistakes asks again."""


_LEAST_TOLD = 3
"""Letters from which a name says what may have been meant by it."""

_ALIKE = 0.6
"""Share of letters, in their order, that two names have in common where one is the other misspelt."""


class UserNote(UserWarning):
    """A warning in words for the user: commands say it once, as it stands."""


def shortened(message: str) -> str:
    r"""A message with at most :data:`MOST_LINES` lines, none of them longer than :data:`LONGEST`.

    >>> shortened("wrong"), len(shortened("9" * 100_000)) < LONGEST
    ('wrong', True)
    >>> shortened("one\n" * 52).splitlines()[-1]
    'and 3 lines more'
    """
    if len(message) <= LONGEST and message.count("\n") < MOST_LINES:
        return message
    lines = message.splitlines()
    told = lines if len(lines) <= MOST_LINES else lines[: MOST_LINES - 1]
    more = [f"and {len(lines) - len(told):,} lines more"] if len(told) < len(lines) else []
    return "\n".join([*map(_line, told), *more])


def _line(line: str) -> str:
    if len(line) <= LONGEST:
        return line
    left = len(line) - _BEGINNING - _END
    return f"{line[:_BEGINNING]} ... ({left:,} characters more) ... {line[-_END:]}"


class MechwrightError(Exception):
    """Base of all expected errors."""

    def __str__(self) -> str:
        return shortened(super().__str__())


class DesignError(MechwrightError, ValueError):
    """A design file or a parameter is wrong."""


class OutputError(MechwrightError, OSError):
    """A file or folder cannot be read or written."""


class PluginError(MechwrightError, LookupError):
    """A family, post or exporter is not there, or a plugin is broken."""


class PluginFaultError(PluginError):
    """A plugin gave what its contract does not allow, or failed; the message says who, where, and what."""


class GeometryError(MechwrightError, ValueError):
    """A curve, loop or solid cannot be built from these numbers."""


class KinematicsError(MechwrightError, ArithmeticError):
    """The mechanism cannot be assembled or is singular in this position."""


class ToolError(MechwrightError, LookupError):
    """No tool of the library fits the work."""


class ProgramError(MechwrightError, ValueError):
    """A program text cannot be read; the message names the line."""


class ProofError(MechwrightError, RuntimeError):
    """A program was simulated and would not cut the right part."""


def did_you_mean(name: str, known: Iterable[str], most: int = 3) -> str:
    """Which of some known names somebody may have meant by another; empty where none is like it.

    Several names that begin with what was written come first, then the one that is spelt most like it, then
    one that begins with it, then those that have it as one of their words. Capitals, blanks and hyphens
    count for nothing, unless a name is like it as it is written.

    >>> did_you_mean("nema17", ["NEMA 17 - 34", "NEMA 17 - 40", "NEMA 23 - 56"])
    "did you mean 'NEMA 17 - 34' or 'NEMA 17 - 40'?"
    >>> did_you_mean("cranck", ["crank", "rod"]), did_you_mean("diameter", ["pin_diameter", "rim"])
    ("did you mean 'crank'?", "did you mean 'pin_diameter'?")
    >>> did_you_mean("tooth", ["teeth", "tooth_offset"]), did_you_mean("stroke", ["crank", "rod"])
    ("did you mean 'teeth'?", '')
    """
    import difflib

    plain = {one: "".join(filter(str.isalnum, one.lower())) for one in known}
    own = "".join(filter(str.isalnum, name.lower()))
    begun = [one for one, words in plain.items() if len(own) >= _LEAST_TOLD and words.startswith(own)]
    written = difflib.get_close_matches(name, plain, 1, _ALIKE)
    close = difflib.get_close_matches(own, plain.values(), 1, _ALIKE)
    spelt = [one for one, words in plain.items() if words in close][:1]
    within = [one for one in plain if own in one.lower().split("_") and len(own) >= _LEAST_TOLD]
    several = begun if len(begun) > 1 else []
    kinds = (several, written, begun, spelt, within)
    found = next((some for some in kinds if 0 < len(some) <= most), [])
    if not found:
        return ""
    *others, last = map(repr, found)
    return f"did you mean {', '.join(others)} or {last}?" if others else f"did you mean {last}?"
