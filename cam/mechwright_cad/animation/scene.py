"""What the page shows, as plain data: bodies and their poses, what is drawn of them, paths, channels."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from mechwright.contracts.joint import GROUND
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part
from mechwright_cad.animation.figures import MICRON, poses_of, rounded, significant
from mechwright_cad.bodies import bodies_of, label_of
from mechwright_cad.interference.path import flat
from mechwright_cad.viewer.forms import is_light
from mechwright_cad.viewer.groups import groups_of

PAGE_SAMPLES = 361
"""Samples of the motion that the page holds: every degree of a turn, and straight on between two of them."""

CLOSED = 1e-6
"""What an end may differ from the beginning, mm, parts of 1 and turns, of a motion that goes round."""


def scene(
    parts: Sequence[Part], motion: Motion, *, solids: bool, space: bool = False, plan: bool = True
) -> dict[str, Any]:
    """The content of the page, of parts with their instances and of a motion with any number of samples.

    With ``solids`` all parts are drawn, which takes the CAD kernel; else the page names what is missing.
    With ``space`` a mechanism in the plane that has other parts than plates is shown in space as well;
    without a ``plan`` any mechanism is shown in space alone.
    Without parts the skeleton is shown, as far as the motion says how its bodies are joined.
    Raises GeometryError as :func:`bodies_of` does, or where a part cannot be made.
    """
    bodies = bodies_of(parts, motion)
    plane = all(flat(one.rotation, one.position) is not None for one in motion.poses.values())
    paths = {name: motion.path(name) for name in motion.traces}
    machine = plane and space and not (plan and all(body.is_plate for body in bodies))
    bare = not bodies and bool(motion.joints)
    # Where no bodies are known, joints and the points whose paths are drawn still move.
    used = {body.instance.body for body in bodies} or (
        set(motion.poses) if bare else {trace.body for trace in motion.traces.values()}
    )
    labels = motion.labels
    flat_paths = plane and not machine
    unmade = [] if solids else [label_of(body) for body in bodies if not is_light(body.part)]
    found: dict[str, Any] = {
        "input": motion.input_name,
        "over": motion.over,
        "round": _goes_round(motion),
        "channels": {
            name: {"unit": channel.unit, "label": labels[name], "values": significant(channel.values)}
            for name, channel in motion.channels.items()
        },
        "poses": {name: poses_of(poses, plane=plane) for name, poses in motion.poses.items() if name in used},
        "traces": {name: rounded(path[:, : 2 if flat_paths else 3], MICRON) for name, path in paths.items()},
        "missing": list(dict.fromkeys(unmade)),
    }
    if plane and plan:
        from mechwright_cad.animation.instants import arrows, instants, lines

        found["instants"], found["arrows"] = instants(motion), arrows(motion)
        found["lines"] = [] if bare else [one for one in lines(motion) if one["body"] in found["poses"]]
    if bare:
        found |= _skeleton(motion, plane=plane)
    elif plane and plan:
        from mechwright_cad.animation.plane import layers_of, see_through, window
        from mechwright_cad.animation.space import grouping

        groups = groups_of(bodies, motion) if machine else [""] * len(bodies)
        layers = [
            layer | grouping(group)
            for body, group in zip(bodies, groups, strict=True)
            for layer in layers_of(body, solids=solids)
        ]
        plates = {label_of(body) for body in bodies if body.is_plate}
        found["layers"] = see_through(sorted(layers, key=lambda layer: layer["top"]), found["poses"], plates)
        found["window"] = window(bodies, solids=solids, paths=list(paths.values()))
    if not bare and (machine or not plane):
        from mechwright_cad.animation.space import bodies_in_space

        found |= bodies_in_space(bodies, motion, solids=solids, paths=list(paths.values()))
        if plane:
            found["up"] = [0, 0, 1]
    return found


def _skeleton(motion: Motion, *, plane: bool) -> dict[str, Any]:
    """What is drawn of a mechanism without parts."""
    from mechwright_cad.animation.plane import window
    from mechwright_cad.animation.skeleton import plane_layers, reach_of, space_meshes
    from mechwright_cad.animation.space import ball, upwards

    still = {"columns": [[0]] * 3 if plane else [[0], [0], [0], [1], [0], [0], [0]]}
    pictured: dict[str, Any]
    if plane:
        pictured = {
            "layers": plane_layers(motion),
            "window": window((), solids=False, paths=reach_of(motion)),
        }
        drawn = pictured["layers"]
    else:
        sphere = ball(reach_of(motion))
        pictured = {"meshes": space_meshes(motion), "ball": sphere, "up": upwards((), sphere["centre"])}
        drawn = pictured["meshes"]
    bodies = {one["body"] for one in drawn}
    poses = {name: poses_of(motion.poses[name], plane=plane) for name in sorted(bodies - {GROUND})}
    return pictured | {"poses": {GROUND: still, **poses}, "bare": True}


def _goes_round(motion: Motion) -> bool:
    """Whether the motion begins anew at its end: after whole turns of the input, or where it began."""
    channel = motion.channels[motion.input_name]
    turns = abs(float(channel.values[-1] - channel.values[0])) / math.tau
    if channel.unit == "rad" and turns > 0.5 and abs(turns - round(turns)) < CLOSED:
        return True
    ends = [np.abs(x[-1] - x[0]).max() for p in motion.poses.values() for x in (p.position, p.rotation)]
    return bool(ends and max(ends) < CLOSED)
