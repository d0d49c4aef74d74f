"""What one system has and another has not: Linux, macOS and Windows differ here and nowhere else.

The rest of the program asks by what it needs: a lock, an alarm, the end of a parent. Where a system has none,
the answer says so, and whoever asks has another way.
"""

import contextlib
import os
import signal
import stat
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl
    import resource

if TYPE_CHECKING:
    import subprocess

SYSTEM: str = sys.platform
"""``linux``, ``darwin`` or ``win32``."""

FOLDERS_OPEN = sys.platform != "win32"
"""Whether the system opens folders, and moves what is open."""

READ_FLAGS = (
    os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
)
"""To open a file to be read, without waiting for who writes into a pipe, and byte for byte."""

LOOK_FLAGS = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
"""To open a file or folder itself, and not what a link leads to."""

MOVE_AGAIN = (0.1, 0.4, 1.0) if sys.platform == "win32" else ()
"""Seconds before another try to move: Windows moves nothing that is open, and scanners open what is new."""

_AT_FDCWD, _RENAME_EXCHANGE = -100, 2
_PDEATHSIG = 1
"""``PR_SET_PDEATHSIG`` of Linux's prctl: the signal that a process gets when its parent ends."""
_SYNCHRONIZE, _WITHOUT_END = 0x00100000, 0xFFFFFFFF
"""Of Windows: the right to wait for a process, and the time to wait."""
_LOOK = 0.5
"""Seconds between two looks at the parent, on systems that do not tell."""


def signals(*names: str) -> tuple[signal.Signals, ...]:
    """The signals of these names that the system has.

    >>> [one.name for one in signals("SIGINT", "SIGNONE")]
    ['SIGINT']
    """
    return tuple(getattr(signal, name) for name in names if hasattr(signal, name))


STOPS = signals("SIGINT", "SIGTERM", "SIGHUP")
"""Signals that stop a program: the keyboard, the system, the end of a terminal."""


def blocked_signals() -> frozenset[int]:
    """The signals that this thread holds back."""
    return (
        frozenset(signal.pthread_sigmask(signal.SIG_BLOCK, ()))
        if hasattr(signal, "pthread_sigmask")
        else frozenset()
    )


def block_signals(numbers: Iterable[int]) -> None:
    """Have this thread hold back these signals, and no others."""
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_SETMASK, numbers)


def alarm_left() -> float | None:
    """Seconds until the alarm that is set, 0 of none; None where the system has no alarms."""
    return signal.getitimer(signal.ITIMER_REAL)[0] if hasattr(signal, "setitimer") else None


@contextmanager
def alarm(seconds: float, again: float, up: Callable[..., Any]) -> Iterator[None]:
    """Have ``up`` called after some seconds and each ``again`` later, as long as the block lasts."""
    before = signal.signal(signal.SIGALRM, up)
    try:
        signal.setitimer(signal.ITIMER_REAL, seconds, again)
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def try_lock(handle: int) -> bool:
    """Whether the lock of an open file is now this handle's; raises OSError where there are no locks."""
    try:
        if sys.platform == "win32":
            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    return True


def exchange(one: Path, two: Path) -> bool:
    """Exchange two folders atomically where the system can (Linux's renameat2)."""
    if sys.platform != "linux":
        return False
    import ctypes  # it takes long to import, and most commands have no use for it

    try:
        call = ctypes.CDLL(None, use_errno=True).renameat2
    except (OSError, AttributeError):
        return False
    done: int = call(_AT_FDCWD, os.fsencode(one), _AT_FDCWD, os.fsencode(two), _RENAME_EXCHANGE)
    return done == 0


def usable_cores() -> int:
    """The cores that the system binds this process to."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def on_fork(call: Callable[[], object]) -> None:
    """Have a function called in this process whenever it forks."""
    if hasattr(os, "register_at_fork"):
        os.register_at_fork(after_in_parent=call)


def kill_group(process: "subprocess.Popen[bytes]") -> None:
    """End a process that leads a session, and what it has started."""
    with contextlib.suppress(OSError):
        if sys.platform == "win32":
            process.kill()
        else:
            os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def killed_with_parent() -> bool:
    """Have the system kill this process with its parent, more precisely the thread that started it.

    False where the system does not do that.
    """
    if sys.platform != "linux":
        return False
    import ctypes

    ctypes.CDLL(None).prctl(_PDEATHSIG, signal.SIGKILL)
    return True


def wait_for_end(parent: int) -> None:
    """Wait until the parent of this process, the process with that number, has ended."""
    if sys.platform == "win32":
        import ctypes

        kernel = ctypes.WinDLL("kernel32")
        kernel.OpenProcess.restype = ctypes.c_void_p
        if handle := kernel.OpenProcess(_SYNCHRONIZE, False, parent):
            kernel.WaitForSingleObject(ctypes.c_void_p(handle), _WITHOUT_END)
    else:
        while os.getppid() == parent:
            time.sleep(_LOOK)


def process_state() -> dict[str, Any]:
    """What belongs to the whole process, in words: timers, priority, user, cores, limits."""
    found: dict[str, Any] = {}
    if hasattr(signal, "getitimer"):
        timers = (signal.ITIMER_VIRTUAL, signal.ITIMER_PROF)
        found["a timer"] = [signal.getitimer(one)[0] > 0 for one in timers]
    if hasattr(os, "getpriority"):
        found["the priority"] = os.getpriority(os.PRIO_PROCESS, 0)
    for what, name in (("the user", "geteuid"), ("the group", "getegid"), ("the groups", "getgroups")):
        if hasattr(os, name):
            found[what] = getattr(os, name)()
    if hasattr(os, "sched_getaffinity"):
        found["the cores"] = os.sched_getaffinity(0)
    if sys.platform != "win32":
        for name in dir(resource):
            if name.startswith("RLIMIT_"):
                found[f"the limit {name}"] = resource.getrlimit(getattr(resource, name))
    return found


def is_private(folder: Path) -> bool:
    """Whether nobody but the user may write into a folder, as far as the system says; raises OSError."""
    if sys.platform == "win32":  # folders below the user's own are the user's
        return True
    state = folder.stat()
    return state.st_uid == os.getuid() and not state.st_mode & (stat.S_IWGRP | stat.S_IWOTH)


def has_windows() -> bool:
    """Whether programs can open windows here."""
    return SYSTEM in {"darwin", "win32"} or any(map(os.environ.get, ("DISPLAY", "WAYLAND_DISPLAY")))
