"""What annotations of controls ask of runs and look-aheads beyond their kinds."""

from collections.abc import Sequence
from dataclasses import MISSING, fields
from typing import Annotated

import numpy as np

from mechwright.contracts.declared import Declared, refuse
from mechwright.contracts.guard import UnsoundError, is_foreign, later, now
from mechwright_cam.controls.lookahead import Lookahead, Motion
from mechwright_cam.controls.reading.run import Kind, Run
from mechwright_cam.shop.machine import Machine

_OF_STEPS = {"start": (3,), "end": (3,), "centre": (2,)}
"""Arrays of a run to what they have of each step, where that is not one number."""


class _Watched(Lookahead):
    """A look-ahead of somebody else, asked under the guard of the control that gave it."""

    def __init__(self, own: Lookahead) -> None:
        self._motion = later(own.motion, "motion()", _hold_motions)
        self._motions = later(own.motions, "motions()", _hold_motions)

    def motion(self, run: Run, machine: Machine) -> Motion:
        """What becomes of a run."""
        found: Motion = self._motion(run, machine)
        return found

    def motions(self, run: Run, machine: Machine, accelerations: Sequence[float]) -> list[Motion]:
        """What becomes of it with each of some accelerations, m/s²."""
        found: list[Motion] = self._motions(run, machine, accelerations)
        return found


def _hold_motions(
    found: Motion | list[Motion],
    run: Run,
    machine: Machine,  # noqa: ARG001
    accelerations: Sequence[float] | None = None,
) -> None:
    refuse(Declared(finite=False).fault(found, Motion if accelerations is None else list[Motion]))
    motions = found if isinstance(found, list) else [found]
    if accelerations is not None and len(motions) != len(accelerations):
        raise UnsoundError(f"gives {len(motions)} motions; {len(accelerations)} are asked for")
    for motion in motions:
        for name in ("seconds", "off"):
            values = getattr(motion, name)
            if values.shape != (len(run),) or not (values >= 0).all():
                raise UnsoundError(
                    f"{name} of what it gives is not a number from 0 on for each of {len(run)} steps"
                )


def _hold_run(run: Run, *_: object) -> None:
    """Raise UnsoundError where arrays of a run are not of its steps, or lead to what is not there."""
    if run.kind.ndim != 1:
        raise UnsoundError(f"kind of what it gives has the shape {run.kind.shape}; (n,) is wanted")
    steps = run.kind.size
    for one in fields(Run):
        if isinstance(values := getattr(run, one.name), np.ndarray):
            may_be_empty = one.default_factory is not MISSING
            shape, wanted = values.shape, (steps, *_OF_STEPS.get(one.name, ()))
            if shape != wanted and not (may_be_empty and shape == (0,)):
                raise UnsoundError(f"{one.name} of what it gives has the shape {shape}; {wanted} is wanted")
    for name, ends in (("kind", len(Kind)), ("state", len(run.states)), ("file", max(1, len(run.files)))):
        values = getattr(run, name)
        bad = (values < 0) | (values >= ends)
        if bad.any():
            at = int(np.argmax(bad))
            raise UnsoundError(
                f"{name} of what it gives is {values[at]} at step {at}; {ends} are there, from 0 on"
            )


RunOfText = Annotated[Run, Declared(finite=False, nan=True), _hold_run]
"""A run whose steps are all there; places that no text says are NaN."""
GuardedLookahead = Annotated[Lookahead, lambda own: _Watched(own) if is_foreign(now()) else own]
"""A look-ahead whose calls are those of the control that gave it."""
