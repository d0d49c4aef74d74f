"""What a control's methods may give: texts that can be written, and runs whose steps are all there."""

from collections.abc import Mapping, Sequence

import numpy as np

from mechwright.contracts.declared import LOOSE, refuse
from mechwright.contracts.file_names import name_fault
from mechwright.contracts.guard import UnsoundError, later
from mechwright_cam.controls.lookahead import Lookahead, Motion
from mechwright_cam.controls.reading.run import Kind, Run
from mechwright_cam.shop.machine import Machine

_OF_STEPS = {"start": (3,), "end": (3,), "centre": (2,)}
"""Arrays of a run to what they have of each step, where that is not one number."""
_ARRAYS = ("line", "start", "end", "centre", "sweep", "feed", "seconds", "arc_error", "state")
_MAYBE = ("piece", "machine_xy", "file")
"""Those that are empty where a control does not fill them."""


def hold_files(files: Mapping[str, str]) -> None:
    """Raise UnsoundError where names are no plain ones, or texts cannot be written."""
    for name, text in files.items():
        if fault := name_fault(name):
            raise UnsoundError(f"{name!r} {fault}")
        try:
            text.encode()
        except UnicodeEncodeError as error:
            raise UnsoundError(f"gives a text that cannot be written: {error.reason}") from error


class HeldLookahead(Lookahead):
    """A look-ahead of somebody else, asked under the guard of the control that gave it."""

    def __init__(self, own: Lookahead) -> None:
        self._own = own
        self._motion, self._motions = later(self._one, "motion()"), later(self._several, "motions()")

    def motion(self, run: Run, machine: Machine) -> Motion:
        """What becomes of a run."""
        found: Motion = self._motion(run, machine)
        return found

    def motions(self, run: Run, machine: Machine, accelerations: Sequence[float]) -> list[Motion]:
        """What becomes of it with each of some accelerations, m/s²."""
        found: list[Motion] = self._motions(run, machine, accelerations)
        return found

    def _one(self, run: Run, machine: Machine) -> Motion:
        found = self._own.motion(run, machine)
        _hold_motion(found, run)
        return found

    def _several(self, run: Run, machine: Machine, accelerations: Sequence[float]) -> list[Motion]:
        found = self._own.motions(run, machine, accelerations)
        refuse(LOOSE.fault(found, list[Motion]))
        if len(found) != len(accelerations):
            raise UnsoundError(f"gives {len(found)} motions; {len(accelerations)} are asked for")
        for one in found:
            _hold_motion(one, run)
        return found


def _hold_motion(motion: Motion, run: Run) -> None:
    refuse(LOOSE.fault(motion, Motion))
    for name in ("seconds", "off"):
        values = getattr(motion, name)
        if values.shape != (len(run),) or not (values >= 0).all():
            raise UnsoundError(
                f"{name} of what it gives is not a number from 0 on for each of {len(run)} steps"
            )


def hold_run(run: Run) -> None:
    """Raise UnsoundError where arrays of a run are not of its steps, or lead to what is not there."""
    if run.kind.ndim != 1:
        raise UnsoundError(f"kind of what it gives has the shape {run.kind.shape}; (n,) is wanted")
    steps = run.kind.size
    for name in (*_ARRAYS, *_MAYBE):
        shape, wanted = getattr(run, name).shape, (steps, *_OF_STEPS.get(name, ()))
        if shape != wanted and not (name in _MAYBE and shape == (0,)):
            raise UnsoundError(f"{name} of what it gives has the shape {shape}; {wanted} is wanted")
    for name, ends in (("kind", len(Kind)), ("state", len(run.states)), ("file", max(1, len(run.files)))):
        values = getattr(run, name)
        bad = (values < 0) | (values >= ends)
        if bad.any():
            at = int(np.argmax(bad))
            raise UnsoundError(
                f"{name} of what it gives is {values[at]} at step {at}; {ends} are there, from 0 on"
            )
