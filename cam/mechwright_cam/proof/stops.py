"""Stops of the program for the operator's hands, and what the program's comments say is done there."""

import re

import numpy as np

from mechwright_cam.controls.reading import Kind, Run
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.scene import Scene

CLAMPS = re.compile(r"\b(clamp|screw|bolt|hold)", re.IGNORECASE)
"""What a comment says where a clamp is set."""
TAKES = re.compile(r"\b(take|remove|lift|pick|pull)", re.IGNORECASE)
"""What a comment says where a loose piece is taken away."""


def hand_stops(run: Run) -> Ints:
    """The steps that stop the program, but for tools that are changed by hand: those follow on a T word."""
    stops: Ints = np.flatnonzero((run.kind == Kind.STOP) & (np.roll(run.kind, 1) != Kind.TOOL))
    return stops


def stops_that_say(run: Run, words: re.Pattern[str]) -> list[int]:
    """Those of them whose comment, in their line or since the step before, has some words."""
    stops = hand_stops(run).tolist()
    asked = set(stops)
    said = {remark.step for remark in run.remarks if remark.step in asked and words.search(remark.text)}
    return [step for step in stops if step in said]


def clamp_set(scene: Scene) -> int:
    """The stop at which the clamp of the job is set; -1 without one, so that it can only be there before.

    It is the one whose comment says so. If none does, it is the first at which there is a way through the
    plate for it.
    """
    run, job = scene.run, scene.job
    assert job.clamp is not None  # noqa: S101 - asked only where there is one
    said = stops_that_say(run, CLAMPS)
    if said:
        return said[0]
    stops = hand_stops(run)
    open_since = way_through(scene)
    after = stops[stops > open_since]
    return int(after[0]) if after.size else int(stops[0]) if stops.size else -1


def way_through(scene: Scene) -> int:
    """The step that opens the plate where the clamp goes through it."""
    assert scene.job.clamp is not None  # noqa: S101 - asked only where there is one
    row, column, inside = scene.footprint.cells(np.array([scene.job.clamp.centre]))
    return int(scene.footprint.cut[row[0], column[0]]) if inside[0] else -1
