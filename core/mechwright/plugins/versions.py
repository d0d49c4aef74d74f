"""Which versions of the contracts this program reads: its own, and for one minor version the one before."""

from importlib import import_module

from mechwright.contracts.plugin import HOOK_API, HOOK_API_SINCE, MOVING


def program() -> str:
    """Version of this program; the package itself, which has it, stands above all rooms."""
    return str(import_module("mechwright").__version__)


def minor(version: str) -> tuple[int, int]:
    """Major and minor number of a version.

    >>> minor("0.9.3"), minor("1.0.0rc1")
    ((0, 9), (1, 0))
    """
    first, second, *_ = version.split(".")
    return int(first), int(second)


def api_fault(api: object, version: str, current: int = HOOK_API, since: str = HOOK_API_SINCE) -> str:
    """Why a class of a version of the contracts is refused; nothing if it is used.

    Parameters
    ----------
    api
        What the class states.
    version
        Of this program.
    current, since
        The newest version of the contracts, and the minor version of this program that brought it.

    >>> api_fault(2, "0.9.0", 2, "0.8"), api_fault(1, "0.8.7", 2, "0.8")
    ('', '')
    >>> api_fault(1, "0.9.0", 2, "0.8")
    'was written for hook API 1; this is 2: docs/plugins/moving.md says how to move'
    >>> api_fault(3, "0.9.0", 2, "0.8")
    'was written for hook API 3; this is 2'
    """
    if type(api) is int and (api == current or (api == current - 1 and minor(version) == minor(since))):
        return ""
    said = f"was written for hook API {api}; this is {current}"
    return f"{said}: {MOVING} says how to move" if type(api) is int and api < current else said


def api_warning(api: object, version: str, current: int = HOOK_API, since: str = HOOK_API_SINCE) -> str:
    """What the author of a class that is used should know of its version; nothing if it is the newest.

    >>> api_warning(1, "0.8.7", 2, "0.8")
    'was written for hook API 1; this is 2, and 0.9 refuses 1: docs/plugins/moving.md says how to move'
    """
    if api == current or api_fault(api, version, current, since):
        return ""
    major, number = minor(since)
    return (
        f"was written for hook API {api}; this is {current}, and {major}.{number + 1} refuses {api}: "
        f"{MOVING} says how to move"
    )
