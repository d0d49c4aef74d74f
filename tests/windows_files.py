"""What Windows refuses and Linux does not: moving, replacing and removing what a process itself has open.

Python opens files there so that nobody may move or remove them meanwhile, and a folder stays where it is while a
file below it is open, or somebody works in it. What is open is what Linux says of this process. No folder is
opened, paths have at most 260 characters, devices have names, and there is neither a fork nor an alarm.
"""

import ctypes
import errno
import hashlib
import os
import shutil
import signal
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

LONGEST = 260
"""Characters of a path, with the null at its end."""
DEVICES = frozenset(
    ("con", "prn", "aux", "nul", *(f"{name}{n}" for name in ("com", "lpt") for n in range(1, 10)))
)
CHARACTERS = frozenset('<>:"|?*')
OUR_OWN = ("/proc/", "/dev/", "/sys/")

NUMBER = 32
"""Windows' number of the error."""
PROCESS = "import sys; sys.path.append({!r}); import windows_files; windows_files.refuse(setattr)\n"


def in_children(folder: Path, environment: dict[str, str]) -> dict[str, str]:
    """The environment of processes in which the same is refused; ``folder`` is an empty one to work in."""
    (folder / "sitecustomize.py").write_text(PROCESS.format(str(Path(__file__).parent)), encoding="utf-8")
    found = os.pathsep.join(filter(None, (str(folder), environment.get("PYTHONPATH"))))
    return {**environment, "PYTHONPATH": found}


def lock_file(folder: Any) -> str:
    """The file by which a folder is locked where it is not opened."""
    os.stat(folder)  # noqa: PTH116
    place = hashlib.sha256(os.path.realpath(folder).encode()).hexdigest()
    return os.path.join(tempfile.gettempdir(), f"mechwright-{place[:32]}.lock")  # noqa: PTH118


def require_name(path: Any) -> None:
    """Raise an error where Windows has no such name."""
    text = os.path.abspath(os.fspath(path))  # noqa: PTH100
    if text.startswith(OUR_OWN):
        return
    if len(text) >= LONGEST:
        raise FileNotFoundError(errno.ENOENT, "the path is too long", text)
    for part in Path(text).parts[1:]:
        if part.partition(".")[0].rstrip().lower() in DEVICES or CHARACTERS & set(part) or part[-1] in ". ":
            raise OSError(errno.EINVAL, "the name is wrong", text)


def refuse(put: Callable[[Any, str, Any], object], away: Callable[[Any, str], object] = delattr) -> None:
    """Refuse it in this process; ``put`` sets an attribute, as ``setattr`` or a monkeypatch does."""
    rename, replace, tree = os.rename, os.replace, shutil.rmtree
    library = ctypes.CDLL
    passing = [0]

    def no_open(name: str) -> None:
        real = getattr(os, name)

        def checked(path: Any, *arguments: Any, **more: Any) -> Any:
            if not passing[0]:
                require_closed(path)
            return real(path, *arguments, **more)

        put(os, name, checked)

    def renamed(source: Any, target: Any, **more: Any) -> None:
        require_closed(source)
        if os.path.lexists(target):
            raise FileExistsError(errno.EEXIST, "the file is there already", os.fspath(target))
        rename(source, target, **more)

    def replaced(source: Any, target: Any, **more: Any) -> None:
        require_closed(source)
        require_closed(target)
        if Path(target).is_dir():
            raise PermissionError(errno.EACCES, "access is denied", os.fspath(target))
        replace(source, target, **more)

    def rmtree(path: Any, ignore_errors: bool = False, **more: Any) -> None:
        try:
            require_closed(path)
        except PermissionError:
            if ignore_errors:
                return
            raise
        passing[0] += 1  # to remove a folder Linux opens it
        try:
            tree(path, ignore_errors, **more)
        finally:
            passing[0] -= 1

    class Library(library):
        """The system's calls, without that which exchanges two folders in one step."""

        def __getattr__(self, name: str) -> Any:
            if name == "renameat2":
                raise AttributeError(name)
            return super().__getattr__(name)

    for name in ("unlink", "remove", "rmdir"):
        no_open(name)
    put(os, "rename", renamed)
    put(os, "replace", replaced)
    put(shutil, "rmtree", rmtree)
    put(ctypes, "CDLL", Library)
    _no_folders(put, passing)
    for module, name in ((os, "fork"), (os, "register_at_fork"), (signal, "setitimer"), (signal, "SIGALRM")):
        if hasattr(module, name):
            away(module, name)


def _no_folders(put: Callable[[Any, str, Any], object], passing: list[int]) -> None:
    """Refuse to open folders, and names that Windows has not."""
    open_, mkdir = os.open, os.mkdir

    def made(path: Any, *arguments: Any, **more: Any) -> None:
        require_name(path)
        mkdir(path, *arguments, **more)

    def opened_file(path: Any, flags: int, *arguments: Any, **more: Any) -> int:
        require_name(path)
        if not passing[0] and Path(path).is_dir():
            raise PermissionError(errno.EACCES, "permission denied", os.fspath(path))
        return open_(path, flags, *arguments, **more)

    put(os, "mkdir", made)
    put(os, "open", opened_file)
    from mechwright.contracts.file_names import path_fault
    from mechwright.output import locking

    put(locking, "FOLDERS_OPEN", False)
    put(locking, "_opened", lambda folder: os.open(lock_file(folder), os.O_RDWR | os.O_CREAT))
    put(path_fault, "__defaults__", ("win32",))


def require_closed(path: Any) -> None:
    """Raise PermissionError where this process has a file, or one below a folder, open, or works in it."""
    text = os.fspath(path)
    place = str(Path(os.path.realpath(Path(text).parent), Path(text).name))
    for one in opened():
        if one == place or one.startswith(place + os.sep):
            error = PermissionError(errno.EACCES, f"is used by a process ({one})", text)
            error.winerror = NUMBER
            raise error


def opened() -> set[str]:
    """The files and folders that this process has open or mapped, and the one that it works in."""
    found = {os.getcwd()}  # noqa: PTH109
    for number in os.listdir("/proc/self/fd"):  # noqa: PTH208
        try:
            found.add(os.readlink(f"/proc/self/fd/{number}"))  # noqa: PTH115
        except OSError:
            continue
    with open("/proc/self/maps", encoding="utf-8") as maps:  # noqa: PTH123
        found.update(line.split(maxsplit=5)[5].rstrip("\n") for line in maps if line.count("/"))
    return {one for one in found if one.startswith("/")}


available = sys.platform == "linux"
