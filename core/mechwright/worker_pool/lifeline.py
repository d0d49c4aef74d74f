"""A process that ends with the one that started it, however that one ends: nobody would stop it any more."""

import os
import threading

from mechwright.systems import killed_with_parent, wait_for_end

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
    if not killed_with_parent():
        threading.Thread(target=_watch, args=(parent,), daemon=True).start()
    elif os.getppid() != parent:  # it has ended before
        os._exit(1)


def _watch(parent: int) -> None:
    wait_for_end(parent)
    os._exit(1)
