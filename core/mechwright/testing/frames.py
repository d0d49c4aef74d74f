"""What the family contract asks of a mounting, and of the frames that are built on it."""

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from mechwright.contracts.family import Family
from mechwright.contracts.finding import Stage, errors
from mechwright.contracts.motion import Motion
from mechwright.contracts.mounting import Flange, GroundPlate, Mounting
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.part import Part
from mechwright.errors import DesignError, PluginError
from mechwright.machine import MachineSettings
from mechwright.machine.framed import framed
from mechwright.testing import commands
from mechwright.tolerances import TOLERANCES

_SAMPLES = 25
"""Of the motion that a mounting is compared with."""

_REFUSAL = re.compile(r"(parameters|machine)\.[\w.]+: .+; .+")

_FRAMES = ("plate", "plates", "base")


class FrameTests:
    """The part of :class:`mechwright.testing.FamilyContract` that is about frames."""

    family: ClassVar[type[Family[Any]]]
    """The class under test."""
    examples: ClassVar[Sequence[Mapping[str, Any]]] = ({},)
    """Tables of designs that build without an error finding."""
    max_frames: ClassVar[int] = 4
    """Random designs that get a frame or a refusal."""

    def test_mounting(self, design: Mapping[str, Any]) -> None:
        """Spindles, where the family says them, are axes about which their bodies turn, with hubs on them."""
        params = self.family.Params.model_validate(dict(design))
        mounting, refusal = None, ""
        try:
            mounting = self.family().mounting(params)
        except DesignError as error:
            refusal = str(error)
        assert not refusal or _REFUSAL.fullmatch(refusal), f"{refusal!r} names no key, or no cure"
        if mounting is None:
            pytest.skip("the family does not say where its shafts stand")
        parts, motion = self.family().parts(params), self.family().solve(params, _SAMPLES)
        if isinstance(mounting, GroundPlate):
            found = [*ground_faults(mounting, parts, motion)]
        elif isinstance(mounting, Flange):
            found = [*flange_faults(mounting, motion)]
        else:
            found = [*mounting_faults(mounting, parts, motion)]
        assert not found, "; ".join(found)

    def test_bodies_of_a_machine_touch(self, tmp_path: Path) -> None:
        """In a frame each body touches what carries it, or its part declares a play."""
        for table in self.examples:
            design = {**self._file(table, tmp_path), "machine": {"frame": "base", "motor": "auto"}}
            try:
                found = commands.gaps(design, tmp_path)
            except PluginError as error:
                pytest.skip(str(error))
            if found is not None:
                assert not found, "; ".join(found)
                return
        pytest.skip("no example has a frame")

    def _file(self, design: Mapping[str, Any], folder: Path) -> Mapping[str, Any]:
        """The design file of an example; the contract says how."""
        raise NotImplementedError

    def strategy(self) -> st.SearchStrategy[Mapping[str, Any]]:
        """Random tables; the contract says which."""
        raise NotImplementedError

    def test_random_designs_have_a_frame_or_a_refusal(self) -> None:
        """A frame has all its bodies in their places, or there is an error that says why there is none."""

        # Inside the method: hypothesis wants one test function for each class that inherits this one.
        @settings(max_examples=self.max_frames, deadline=None, suppress_health_check=list(HealthCheck))
        @given(self.strategy(), st.sampled_from(_FRAMES))
        def frame_or_refusal(table: Mapping[str, Any], kind: str) -> None:
            try:
                params = self.family.Params.model_validate(dict(table))
            except ValidationError:
                return
            if errors(self.family().check(params), Stage.PARTS):
                return
            found = [*frame_faults(self.family(), params, kind)]
            assert not found, "; ".join(found)

        frame_or_refusal()


def mounting_faults(mounting: Mounting, parts: Sequence[Part], motion: Motion) -> Iterator[str]:
    """Spindles that are no axes of their bodies, or have nothing where their hub is said to sit."""
    for one in mounting.spindles:
        if one.body not in motion.poses:
            yield f"spindle {one.name}: the motion has no body {one.body!r}"
            continue
        poses = motion.poses[one.body]
        off = float(np.abs(poses.position[:, :2] - one.point).max())
        lean = float(np.abs(poses.rotation[:, 2, 2] - 1).max())
        if max(off, lean) > TOLERANCES.closure:
            yield f"spindle {one.name}: body {one.body!r} turns {off:g} mm off {one.point}, or leans"
        here = [
            (at.z, at.z + part.thickness)
            for part in parts
            for at in part.instances
            if at.body == one.body and part.outline is not None
        ]
        low, high = min((a for a, _ in here), default=math.inf), max((b for _, b in here), default=-math.inf)
        if one.hub.low < low - TOLERANCES.closure or one.hub.high > high + TOLERANCES.closure:
            yield f"spindle {one.name}: its hub from {one.hub.low:g} to {one.hub.high:g} mm is no part of it"


def ground_faults(ground: GroundPlate, parts: Sequence[Part], motion: Motion) -> Iterator[str]:
    """A plate that moves or lacks a hole, or a shaft that does not end or turn where it is said."""
    if ground.body not in motion.poses or ground.shaft not in motion.poses:
        yield f"the motion has no body {ground.body!r} or none {ground.shaft!r}"
        return
    plate, shaft = motion.poses[ground.body], motion.poses[ground.shaft]
    if max(np.ptp(plate.position, axis=0).max(), np.ptp(plate.rotation, axis=0).max()) > TOLERANCES.closure:
        yield f"body {ground.body!r} moves"
    axis = plate.transform(np.array([[*ground.axis, 0.0]]))[:, 0]
    off = float(np.abs(shaft.position - axis)[:, :2].max())
    if off > TOLERANCES.closure:
        yield f"body {ground.shaft!r} turns {off:g} mm off the axis"
    plates = [
        part.outline
        for part in parts
        for at in part.instances
        if at.body == ground.body
        and part.outline is not None
        and abs(at.z - ground.low) + abs(at.z + part.thickness - ground.high) < TOLERANCES.closure
    ]
    for x, y in ground.holes:
        if not any(
            math.dist(((a + c) / 2, (b + d) / 2), (x, y)) <= TOLERANCES.flatten
            and abs(c - a - ground.hole) <= 2 * TOLERANCES.flatten
            for one in plates
            for a, b, c, d in (loop.bounds for loop in one.inner)
        ):
            yield f"the ground plate has no hole of {ground.hole:g} mm in ({x:g}, {y:g})"
    ends = [at.z for part in parts for at in part.instances if at.body == ground.shaft and part.turned]
    if not any(abs(z - ground.end) < TOLERANCES.closure for z in ends):
        yield f"no shaft of body {ground.shaft!r} ends at {ground.end:g} mm"


def flange_faults(flange: Flange, motion: Motion) -> Iterator[str]:
    """Bodies that are not there, or move, or a shaft that does not turn about the flange's axis."""
    for name in (flange.body, flange.shaft, flange.foot.body):
        if name not in motion.poses:
            yield f"the motion has no body {name!r}"
            return
    for name in (flange.body, flange.foot.body):
        poses = motion.poses[name]
        if (
            max(np.ptp(poses.position, axis=0).max(), np.ptp(poses.rotation, axis=0).max())
            > TOLERANCES.closure
        ):
            yield f"body {name!r} moves"
    one, two = motion.poses[flange.body], motion.poses[flange.shaft]
    apart = np.abs(one.position - two.position).max(), np.abs((one.rotation - two.rotation)[..., 0]).max()
    if max(apart) > TOLERANCES.closure:
        yield f"body {flange.shaft!r} does not turn about the x axis of body {flange.body!r}"


def frame_faults(family: Family[Any], params: Parameters, kind: str) -> Iterator[str]:
    """What is wrong with the frame of a design, or with its refusal."""
    found = framed(MachineSettings(frame=kind, motor="auto"), family, params)
    refused = errors(found.findings)
    event("refused" if refused else "framed")
    if bool(refused) == bool(found.parts):
        yield f"{len(found.parts)} parts and {len(refused)} errors"
    for one in refused:
        if one.stage is not Stage.PARTS or not one.remedy or not one.parameter:
            yield f"{one} is of the stage {one.stage}, and says no key or no remedy"
    bodies = found.around(family.solve(params, _SAMPLES)).poses
    for part in found.parts:
        yield from (f"{part.name} stands on no body" for at in part.instances if at.body not in bodies)
