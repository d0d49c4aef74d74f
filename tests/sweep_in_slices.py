"""The program with slices of a quarter of a second, for sweeps that are stopped in the middle of a batch.

Run as a file it is the command line. ``MECHWRIGHT_DISK`` says how many files fit on the disk: then it is full.
"""

import errno
import os
from pathlib import Path

from mechwright.studies import schedule

QUARTER, COUNT = 0.25, 40
TEXT = """
family = "slider-crank"
name = "forces"
[study]
count = 40
stage = "motion"
front = 0
columns = ["force_shaft_max"]
{more}
[study.ranges]
crank = {{ least = 20, greatest = 40 }}
rod = {{ least = 60, greatest = 160 }}
[study.objectives]
stroke = "greatest"
least_transmission_angle = "greatest"
"""
"""One batch, whose forces are asked of one design after the other."""


def short() -> None:
    """Have slices take a quarter of a second."""
    schedule.SECONDS = schedule.LONGEST = schedule.FIRST = QUARTER


def full_after(count: int) -> None:
    """Have the disk be full when so many files are written."""
    fsync, written = os.fsync, list[int]()

    def full(number: int) -> None:
        if Path(f"/proc/self/fd/{number}").readlink().suffix == ".part":
            written.append(number)
            if len(written) > count:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        fsync(number)

    os.fsync = full


if __name__ == "__main__":
    from mechwright.cli import main

    short()
    if "MECHWRIGHT_DISK" in os.environ:
        full_after(int(os.environ["MECHWRIGHT_DISK"]))
    main()
