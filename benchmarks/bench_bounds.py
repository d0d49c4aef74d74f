"""Time and memory of the proof for long and hostile programs: ``python benchmarks/bench_bounds.py [NAME]``

Each program is a proven one with lines put in front of its last retract, proven in a process of its own.
Times are those of the processor, that of processes which the proof starts among them. They stand beside the
clock, and are told as multiples of an anchor in the same process: the words of 100,000 lines found with one
regular expression.
"""

import re
import resource
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))
import bound_controls
import bound_cuts
import bound_hostile
import bound_nested
import bound_rapids
import bound_words
from bound_places import MANY
from by_control import BY_NAME, prove
from golden_operations import made
from klartext_blocks import anew

from mechwright.errors import ProgramError

CASES = (
    bound_cuts.CASES
    | bound_rapids.CASES
    | bound_words.CASES
    | bound_hostile.CASES
    | bound_nested.CASES
    | bound_controls.CASES
)
LONGEST = 120
"""A program may take so long of the processor before it is given up, s."""


def one(name: str) -> None:
    """Prove one program and tell what it took."""
    resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST + 1))
    control = bound_controls.control_of(name)
    job = made("profile-outside", control)[0]
    lines = job.text.splitlines()
    last = next(k for k, line in enumerate(lines) if re.fullmatch(r"(\d+ )?M9", line))
    up = "L Z+5 R0 FMAX" if control == "heidenhain-tnc" else "G0 Z5."
    text = anew("\n".join([*lines[:last], up, *CASES[name](), up, *lines[last:], ""]))
    words = re.compile("([A-Z])([-+.0-9]+)")
    if "holder" in name:
        short = {"flute_length": 0.5, "stick_out": 0.5, "holder_diameter": 12.0}
        tools = tuple(tool.model_copy(update=short) for tool in job.job.tools)
        job = replace(job, job=replace(job.job, tools=tools))
    start = processor()
    for line in ["G1 X12.345 Y-6.789 F1000"] * MANY:
        words.findall(line)
    anchor, start, clock = processor() - start, processor(), time.perf_counter()
    try:
        proof = prove(text, job.job, BY_NAME[control])
        said = "proven" if proof.ok else f"refused by {proof.failures[0].name}"
    except ProgramError as error:
        said = str(error)
    took, clock = processor() - start, time.perf_counter() - clock
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(
        f"{name:44} {took:5.2f} s {took / anchor:5.1f} anchors, clock {clock:5.1f} s, {most:5.0f} MB  {said}",
        flush=True,
    )


def processor() -> float:
    """Time of the processor so far, s, all threads and the processes that have ended included."""
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + ended.ru_utime + ended.ru_stime


def main(*names: str) -> None:
    for name in names or CASES:
        ended = subprocess.run([sys.executable, __file__, "--one", name], check=False).returncode
        if ended == -signal.SIGXCPU:
            print(f"{name:44} more than {LONGEST} s", flush=True)
        elif ended:
            sys.exit(ended)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--one"]:
        one(sys.argv[2])
    else:
        main(*sys.argv[1:])
