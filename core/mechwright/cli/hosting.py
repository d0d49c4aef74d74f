"""The host as the command line opens it."""

from mechwright.cli.telling import echo
from mechwright.plugins.host import Host, host


def open_host(*, warn: bool = True) -> Host:
    """The host of this process; what is broken in it is named on standard error."""
    found = host()
    if warn:
        warn_broken(found)
    return found


def warn_broken(found: Host) -> None:
    """Name the plugins that could not be used, and those that soon cannot be, on standard error."""
    for one in (*found.broken, *found.outdated):
        echo(f"mechwright: warning: {one}", err=True)
