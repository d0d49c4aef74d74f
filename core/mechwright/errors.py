"""The error tree.

Every error that a user can cause derives from :class:`MechwrightError` and from the built-in type that a
caller would catch anyway. The command line prints such an error as one line and no traceback. A message
says what is wrong, where, the limit, and what to do.
"""


class MechwrightError(Exception):
    """Base of all expected errors."""


class DesignError(MechwrightError, ValueError):
    """A design file or a parameter is wrong."""


class OutputError(MechwrightError, OSError):
    """A file or folder cannot be read or written."""


class PluginError(MechwrightError, LookupError):
    """A family, post or exporter is not there, or a plugin is broken."""


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
