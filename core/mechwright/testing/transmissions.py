"""What a family must do whose mechanisms are stages of a chain."""

import math
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
import pytest

from mechwright.contracts.family import Family
from mechwright.contracts.finding import Stage, errors
from mechwright.contracts.motion import TIME
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.transmission import Transmission
from mechwright.contracts.turning import Turning
from mechwright.errors import DesignError, KinematicsError

_STEP = 1e-5
"""rad of the input, for slopes: their error is its square."""

_SLOPE = 1e-5
"""Share of a rate's greatest size by which a slope may differ from it."""

_CLOSED = 1e-9
"""rad, and share of a channel: what two ways to one figure may differ by."""


class TransmissionTests:
    """The contract of :meth:`Family.transmission`; families that are no stages pass it."""

    family: ClassVar[type[Family[Any]]]

    def params(self, table: Mapping[str, Any]) -> Parameters:
        """The parameters of a table."""
        raise NotImplementedError

    def _stage(self, design: Mapping[str, Any]) -> Transmission:
        params = self.params(design)
        try:
            found = self.family().transmission(params)
        except DesignError as error:
            if "; " not in str(error):
                pytest.fail(f"a refusal says what to do: {error}")
            pytest.skip(f"this design is no stage: {error}")
        if found is None:
            pytest.skip("mechanisms of this family are no stages")
        assert not errors(self.family().check(params), Stage.MOTION)
        return found

    def test_stage_output_has_its_own_rates(self, design: Mapping[str, Any]) -> None:
        """Velocity, acceleration and jerk of the output are the slopes of what stands before them."""
        stage = self._stage(design)
        if stage.output is None:
            with pytest.raises(KinematicsError):
                stage.move(Turning.of(np.zeros(1), 1.0))
            return
        first, last = stage.travel or (0.1, 0.1 + math.tau * float(stage.period))
        angle = np.linspace(first + 2 * _STEP, last - 2 * _STEP, 41)
        here = stage.move(Turning.of(angle, 1.0))
        before, after = (stage.move(Turning.of(angle + way, 1.0)) for way in (-_STEP, _STEP))
        smooth = np.ones(angle.size, dtype=bool)
        for low, high in ((before.omega, after.omega), (before.alpha, after.alpha)):
            smooth &= np.abs(high - low) <= 1e3 * _STEP * max(1.0, float(np.abs(high).max()))
        for name, rate in (("theta", "omega"), ("omega", "alpha"), ("alpha", "jerk")):
            slope = (getattr(after, name) - getattr(before, name)) / (2 * _STEP)
            if name == "theta":
                slope -= np.round(slope * _STEP / math.pi) * math.pi / _STEP
            most = max(1.0, float(np.abs(getattr(here, rate)).max()))
            wrong = np.abs(slope - getattr(here, rate))[smooth] > _SLOPE * most
            assert not wrong.any(), f"{rate} is not the slope of {name}"

    def test_stage_comes_back_after_its_period(self, design: Mapping[str, Any]) -> None:
        """Over a period the output goes on by the advance, with the same rates; a swing keeps its travel."""
        stage = self._stage(design)
        if stage.output is None:
            return
        angle = np.linspace(0.0, math.tau * float(stage.period), 1441)
        drive = Turning.of(angle, 1.0)
        if stage.travel is not None:
            drive = stage.at(angle)[1]
            assert stage.travel[0] - _CLOSED <= drive.theta.min()
            assert drive.theta.max() <= stage.travel[1] + _CLOSED
        out = stage.move(drive)
        way = math.tau * float(stage.advance)
        assert out.theta[-1] - out.theta[0] == pytest.approx(way, abs=_CLOSED)
        assert out.omega[-1] == pytest.approx(out.omega[0], abs=_CLOSED * max(1.0, np.abs(out.omega).max()))

    def test_stage_moves_by_itself_as_the_family_says(self, design: Mapping[str, Any]) -> None:
        """Turned as its own drive does, all channels and poses are those of ``solve``."""
        stage = self._stage(design)
        motion = self.family().solve(self.params(design), 37)
        angle = motion[motion.input_name]
        if stage.travel is not None:
            angle = stage.start + stage.speed * motion[TIME]
        try:
            time, drive = stage.at(angle)
        except DesignError:
            pytest.skip("its own drive repeats no turn")
        found = stage.motion(drive, time)
        for name, channel in motion.channels.items():
            most = max(1.0, float(np.nanmax(np.abs(channel.values))))
            np.testing.assert_allclose(found[name], channel.values, atol=_CLOSED * most, err_msg=name)
        for name, poses in motion.poses.items():
            np.testing.assert_allclose(found.poses[name].frames, poses.frames, atol=1e-9, err_msg=name)
        assert {stage.input.body} | ({stage.output.body} if stage.output else set()) <= found.poses.keys()

    def test_stage_ports_stand_where_their_bodies_do(self, design: Mapping[str, Any]) -> None:
        """A port's body turns about its origin, in the port's sense, by the port's angle."""
        stage = self._stage(design)
        time, drive = np.linspace(0.0, 1.0, 9), Turning.of(np.linspace(0.2, 0.9, 9), 0.7)
        motion = stage.motion(drive, time)
        ports = [(stage.input, drive.theta)]
        if stage.output is not None:
            ports.append((stage.output, stage.move(drive).theta))
        for port, angle in ports:
            poses = motion.poses[port.body]
            np.testing.assert_allclose(poses.position[:, :2], np.tile(port.point, (9, 1)), atol=1e-9)
            turned = np.unwrap(np.arctan2(poses.rotation[:, 1, 0], poses.rotation[:, 0, 0]))
            way = port.sense * (angle - angle[0])
            np.testing.assert_allclose(turned - turned[0], way, atol=1e-9, err_msg=port.body)
        assert TIME in motion.channels
        np.testing.assert_array_equal(motion[TIME], time)
