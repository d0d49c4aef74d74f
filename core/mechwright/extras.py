"""Libraries that are not installed with the rest: which extra brings each, and the line that installs it."""

import json
import sys
from importlib import import_module
from importlib.metadata import PackageNotFoundError, distribution
from importlib.util import find_spec
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from mechwright.errors import PluginError
from mechwright.shell import word

NAME = "mechwright"
EXTRAS = {
    "distributed": "scale",
    "mcp": "mcp",
    "pandas": "data",
    "plotly": "data",
    "pyarrow": "scale",
    "starlette": "live",
    "uvicorn": "live",
}
"""Library to the extra of this distribution that brings it."""


def optional(module: str) -> Any:
    """A module of a library that is optional.

    Raises
    ------
    PluginError
        It is not installed; the line installs the extra that brings it.
    """
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        library = module.partition(".")[0]
        if (error.name or "").partition(".")[0] != library:
            raise  # it is there, and broken
        raise _missing(library, "") from None


def require(*libraries: str, by: str = "") -> None:
    """Raise PluginError where a library is not installed, without loading one: asked before any work.

    Parameters
    ----------
    libraries
        Keys of :data:`EXTRAS`.
    by
        What needs them, such as a command or an option.
    """
    for library in libraries:
        if not _installed(library):
            raise _missing(library, by)


def _installed(library: str) -> bool:
    try:
        return find_spec(library) is not None
    except (ImportError, ValueError):  # whoever looks for modules may say no in several ways
        return False


def _missing(library: str, by: str) -> PluginError:
    extra = EXTRAS[library]
    said = f"{by}: {library}" if by else library
    return PluginError(f"{said} is not installed, which the extra {extra} brings: {install_line(extra)}")


def distribution_line(name: str, folder: str) -> str:
    """The line to type that installs a distribution of its own, which a checkout has in a folder."""
    _, source = _source()
    what = str(source / folder) if isinstance(source, Path) and (source / folder).is_dir() else name
    return f"{_installer()} {word(what)}"


def install_line(extra: str) -> str:
    """The line to type that installs an extra into this interpreter, from where the program itself came."""
    editable, source = _source()
    if source is None:
        what = f"{NAME}[{extra}]"
    elif isinstance(source, Path):
        what = f"{source}[{extra}]"
    else:
        what = f"{NAME}[{extra}] @ {source}"
    option = "-e " if editable else ""
    return f"{_installer()} {option}{word(what, always=True)}"


def _installer() -> str:
    """The beginning of such a line: an environment that uv has made has no pip."""
    python = word(sys.executable or "python")
    return f"{python} -m pip install" if _installed("pip") else f"uv pip install --python {python}"


def _source() -> tuple[bool, Path | str | None]:
    """Whether the installation follows its sources, and where it is from.

    That is a folder, the address of a file or of a repository, or None for an index of packages.
    """
    try:
        said = json.loads(distribution(NAME).read_text("direct_url.json") or "{}")
        address, folder = str(said.get("url", "")), said.get("dir_info")
    except PackageNotFoundError:
        return _sources()
    except (OSError, ValueError, AttributeError):
        return False, None
    if not address:
        return False, None
    if folder is None:
        versions = said.get("vcs_info")
        if versions:
            return False, f"{versions.get('vcs', 'git')}+{address}@{versions.get('commit_id', 'HEAD')}"
        local = urlsplit(address).scheme == "file"
        return False, address if not local or _path(address).is_file() else None
    path = _path(address)
    return (bool(folder.get("editable")), path) if path.is_dir() else (False, None)


def _sources() -> tuple[bool, Path | str | None]:
    """The same where nothing is installed, and the sources are run as they stand."""
    path = Path(__file__).resolve().parents[2]
    return (True, path) if (path / "pyproject.toml").is_file() else (False, None)


def _path(address: str) -> Path:
    from urllib.request import url2pathname  # it takes long to import, and few messages need it

    return Path(url2pathname(urlsplit(address).path))
