#!/usr/bin/python3
"""The display of the machine without one: starts the program, waits for its end, and says how it went.

Run by ``linuxcnc`` itself with the system's Python, in the folder of the run. Writes ``path.txt`` (one line per
servo cycle) and ``display.log``, whose last line is ``END done`` or ``END`` and the reason.
"""

import subprocess
import time
from pathlib import Path

import linuxcnc

POLL = 0.02
"""Between two looks at the machine, s."""
IDLE = 4
"""So many looks in a row have to find it at rest."""


def main(limit: float) -> None:
    """Run ``program.ngc``; give up after ``limit`` seconds."""
    command, machine, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()
    with Path("path.txt").open("w") as path, Path("display.log").open("w", buffering=1) as log:
        sampler = subprocess.Popen(["/usr/bin/halsampler", "-t"], stdout=path)
        try:
            reason = _run(command, machine, errors, time.monotonic() + limit)
            time.sleep(0.3)  # the last samples are still under way
            asked = subprocess.run(
                ["/usr/bin/halcmd", "getp", "sampler.0.overruns"], capture_output=True, text=True, check=False
            )
            log.write(f"overruns {asked.stdout.strip()}\n")
        except Exception as error:
            reason = " ".join(f"{type(error).__name__}: {error}".split())
        finally:
            sampler.terminate()
            sampler.wait()
        log.write(f"END {reason}\n")


def _run(command, machine, errors, until) -> str:
    def do(order, *arguments) -> None:
        order(*arguments)
        command.wait_complete(10)

    do(command.state, linuxcnc.STATE_ESTOP_RESET)
    do(command.state, linuxcnc.STATE_ON)
    do(command.mode, linuxcnc.MODE_MANUAL)
    for joint in range(3):
        do(command.home, joint)
    machine.poll()
    homed_by = time.monotonic() + 10
    while not all(machine.homed[:3]) and time.monotonic() < homed_by:
        time.sleep(POLL)
        machine.poll()
    if not all(machine.homed[:3]):
        return "the machine did not home"
    do(command.mode, linuxcnc.MODE_AUTO)
    do(command.program_open, str(Path("program.ngc").resolve()))
    command.auto(linuxcnc.AUTO_RUN, 0)
    started, idle = False, 0
    while time.monotonic() < until:
        time.sleep(POLL)
        machine.poll()
        said = errors.poll()
        if said and said[0] in (linuxcnc.NML_ERROR, linuxcnc.OPERATOR_ERROR):
            return f"line {machine.motion_line}: {' '.join(said[1].split())}"
        if machine.task_state != linuxcnc.STATE_ON:
            return f"line {machine.motion_line}: the machine switched itself off"
        if machine.interp_state == linuxcnc.INTERP_PAUSED:
            command.auto(linuxcnc.AUTO_RESUME)  # a stop for the operator
        if machine.interp_state != linuxcnc.INTERP_IDLE:
            started, idle = True, 0
        elif started and machine.inpos and machine.queue == 0:
            idle += 1
            if idle >= IDLE:
                return "done"
    return f"not at its end in time, at line {machine.motion_line}" if started else "it never started"


if __name__ == "__main__":
    main(float(Path("limit").read_text()))
