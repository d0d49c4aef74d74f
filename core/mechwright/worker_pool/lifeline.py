"""A process that ends with the one that started it, however that one ends: nobody would stop it any more."""

import ctypes
import os
import signal
import sys
import threading
import time

_PDEATHSIG = 1
"""``PR_SET_PDEATHSIG`` of Linux's prctl: the signal that a process gets when its parent ends."""
_SYNCHRONIZE, _WITHOUT_END = 0x00100000, 0xFFFFFFFF
"""Of Windows: the right to wait for a process, and the time to wait."""
_LOOK = 0.5
"""Seconds between two looks at the parent, on systems that do not tell."""

COMMAND = (
    "import sys; from mechwright.worker_pool.lifeline import end_with_parent; "
    "end_with_parent(int(sys.argv.pop(1))); from mechwright.__main__ import program; program()"
)
"""After ``python -P -c``: the command line of this program, whose first word is the number of the parent."""


def end_with_parent(parent: int) -> None:
    """Have the system kill this process when its parent, the process with that number, ends.

    Linux ends it with the *thread* that started it: that thread has to wait for it. Elsewhere a thread looks,
    which a library that is being loaded may hold up for seconds.
    """
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != parent:  # it has ended before
            os._exit(1)
    else:
        threading.Thread(target=_watch, args=(parent,), daemon=True).start()


def _watch(parent: int) -> None:
    if sys.platform == "win32":
        kernel = ctypes.WinDLL("kernel32")
        kernel.OpenProcess.restype = ctypes.c_void_p
        if handle := kernel.OpenProcess(_SYNCHRONIZE, False, parent):
            kernel.WaitForSingleObject(ctypes.c_void_p(handle), _WITHOUT_END)
    else:
        while os.getppid() == parent:
            time.sleep(_LOOK)
    os._exit(1)
