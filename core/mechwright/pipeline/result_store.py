"""The store of results on disk that belongs to what is installed here."""

import hashlib
import os
import sys
from collections.abc import Callable
from functools import cache, wraps
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import ParamSpec, TypeVar, cast

from platformdirs import user_cache_path

from mechwright.kernels import kernels
from mechwright.plugins.host import BUILT_IN, Host, host
from mechwright.systems import SYSTEM
from mechwright.worker_pool.store import ResultStore

P = ParamSpec("P")
R = TypeVar("R")

STORE = "MECHWRIGHT_STORE"
"""Environment variable: ``off``, or a folder for results in place of that in the user's cache."""

LIBRARIES = (
    *("cadquery", "cadquery-ocp", "ezdxf", "jinja2", "manifold3d", "numba", "numpy", "pydantic", "scipy"),
    *("shapely", "tomlkit"),
)
"""Whose versions change results."""


@cache
def result_store() -> ResultStore | None:
    """Where results are kept between runs; None where it is switched off, or others have registered plugins.

    What the code of others does is not known well enough to tell whether a result of it still holds.
    """
    said = os.environ.get(STORE, "")
    found = host()
    if said == "off" or _others(found):
        return None
    folder = Path(said).expanduser() if said else user_cache_path("mechwright", appauthor=False) / "results"
    return ResultStore(folder, _stamp())


def _others(found: Host) -> bool:
    entries = (entry for items in found.registered.values() for entry in items.values())
    return any(entry.distribution != BUILT_IN for entry in entries)


def _stamp() -> bytes:
    """What results depend on besides what they are made from: code, libraries, Python, processor."""
    stamp = hashlib.sha256(f"{sys.version} {SYSTEM} {kernels()}".encode())
    for library in LIBRARIES:
        try:
            stamp.update(f"{library} {version(library)}\n".encode())
        except PackageNotFoundError:
            stamp.update(f"{library} unknown\n".encode())
    for place in sorted(_files()):
        state = place.stat()
        stamp.update(f"{place} {state.st_size} {state.st_mtime_ns}\n".encode())
    return stamp.digest()


def _files() -> set[Path]:
    """All files of the program: of each folder on the path that has packages of it."""
    entries = (entry for items in host().registered.values() for entry in items.values())
    tops = {type(entry.item).__module__.partition(".")[0] for entry in entries} | {"mechwright"}
    homes = {Path(str(sys.modules[top].__file__)).parents[1] for top in tops}
    packages = [package for home in homes for package in home.glob("mechwright*") if package.is_dir()]
    return {
        place
        for package in packages
        for place in package.rglob("*")
        if place.is_file() and "__pycache__" not in place.parts
    }


def recalled(what: Callable[..., object], given: tuple[object, ...], make: Callable[[], R]) -> R:
    """What ``make`` makes of all that is given, kept in :func:`result_store` as a result of ``what``."""
    store = result_store()
    if store is None:
        return make()
    place = store.kept(what, given)
    for result in place.read():
        return cast("R", result)
    made = make()
    place.write(made)
    return made


def stored(function: Callable[P, R]) -> Callable[P, R]:
    """A function of a module without side effects, whose results are kept in :func:`result_store`."""

    @wraps(function)
    def found(*given: P.args, **named: P.kwargs) -> R:
        return recalled(function, (given, named), lambda: function(*given, **named))

    return found
