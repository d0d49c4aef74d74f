"""The error tree.

Every error that a user can cause derives from :class:`MechwrightError` and from the built-in type that a
caller would catch anyway. The command line prints such an error as one line and no traceback. A message
says what is wrong, where, the limit, and what to do. However long the values are that it names, it has a
bounded length itself.
"""

LONGEST = 2_000
"""Characters of a line of a message: more is some value, of which beginning and end tell what it was."""

_BEGINNING, _END = 600, 400
"""Characters that are kept of a longer one: few enough that a place told before it makes it no longer one."""

MOST_LINES = 50
"""Lines of a message: whoever has mended fifty mistakes asks again."""


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
