"""Keyword arguments of a script as a change of a design file."""

from collections.abc import Iterator, Mapping
from typing import Any

from mechwright.contracts.finding import Change
from mechwright.contracts.table import Table
from mechwright.plugins.host import Host


def change_of(host: Host, given: Mapping[str, object], own: str = "parameters") -> Change:
    """The change that keyword arguments ask for.

    A name is that of a key of the table ``own``, or of a registered table such as ``cam``, whose value says
    the keys that change; one with dots is taken as it is. None leaves a key out. Arrays and numbers of numpy
    become plain ones.
    """
    tables = host.of(Table)
    change: dict[str, Any] = {}
    for name, value in given.items():
        key = name if "." in name or name in tables else f"{own}.{name}"
        change |= _leaves(key, value)
    return change


def _leaves(key: str, value: object) -> Iterator[tuple[str, Any]]:
    if isinstance(value, Mapping):
        for inner, one in value.items():
            yield from _leaves(f"{key}.{inner}", one)
    else:
        yield key, _plain(value)


def _plain(value: object) -> object:
    """A value as a design file can hold it.

    >>> import numpy as np
    >>> _plain(np.float64(0.5)), _plain((np.int64(3), np.array([1.0, 2.0])))
    (0.5, [3, [1.0, 2.0]])
    """
    if isinstance(value, tuple | list):
        return [_plain(one) for one in value]
    listed = getattr(value, "tolist", None)
    return listed() if callable(listed) else value
