"""The frame of a design: what its family says of its shafts, and what its drive asks of them."""

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

from mechwright.contracts.family import Family
from mechwright.contracts.finding import Finding, Stage
from mechwright.contracts.mounting import Flange, GroundPlate, Mounting, MountingError
from mechwright.contracts.parameters import Parameters, kept
from mechwright.contracts.part import Part
from mechwright.contracts.surroundings import Surroundings
from mechwright.errors import DesignError
from mechwright.machine.drive import SAMPLES, drive_of
from mechwright.machine.frame.decided import Wanted
from mechwright.machine.frame.designing import frame_around, refusal
from mechwright.machine.frame.flanged import on_flange
from mechwright.machine.frame.grounded import base_under
from mechwright.machine.frame.sweep import LOOKS, Space, space_of
from mechwright.machine.motors import motor_of
from mechwright.machine.settings import MachineSettings
from mechwright.tolerances import exceeds


@kept
def framed(settings: MachineSettings, family: Family[Any], params: Parameters) -> Surroundings:
    """The frame that the settings ask for, or findings that say why there is none.

    Its drive is that of the mechanism alone; what shafts and coupling add to it is in the drive of the whole.
    """
    try:
        mounting = family.mounting(params)
    except DesignError as error:
        return _refused("frame.mounting", error)
    if mounting is None:
        said = (
            f"the family {family.name} does not say where its shafts stand, so nothing can carry them; "
            'leave frame out, or set frame = "none"'
        )
        return Surroundings(findings=(refusal("frame.mounting", "machine.frame", said),))
    if settings.couples and settings.gear != 1:
        return Surroundings(findings=(_geared(settings, mounting),))
    parts = family.parts(params)
    try:
        drive = drive_of(family.solve(params, SAMPLES), parts, settings)
    except DesignError as error:
        return _refused("frame.drive", error)
    if isinstance(mounting, Mounting) and mounting.fastest is not None:
        faults = _too_fast(drive.speed * 60 / math.tau, mounting.fastest)
        if faults:
            return Surroundings(findings=faults)
    choice = motor_of(drive, settings)
    wanted = Wanted(
        None if choice is None else choice.motor,
        settings.margin * abs(drive.peak()[0]),
        settings.margin * drive.rms,
        drive.speed * 60 / math.tau,
    )
    found = _around(settings, family, params, mounting, parts, wanted)
    return replace(found, reverses=drive.reverses)


def _around(
    settings: MachineSettings,
    family: Family[Any],
    params: Parameters,
    mounting: Mounting | GroundPlate | Flange,
    parts: Sequence[Part],
    wanted: Wanted,
) -> Surroundings:
    """By what the family says of its shafts."""
    motion = family.solve(params, LOOKS)
    if isinstance(mounting, Flange):
        return on_flange(settings, mounting, motion, wanted)
    if isinstance(mounting, GroundPlate):
        try:
            space = _set_space(family, params)
        except DesignError as error:
            return Surroundings(findings=(refusal("frame.design", "machine.frame", str(error)),))
        return base_under(settings, mounting, space, motion, wanted)
    standing = [part for part in parts if part.name not in mounting.own_shafts]
    found = frame_around(settings, mounting, standing, motion, wanted)
    return replace(found, replaces=mounting.own_shafts if found.parts else ())


def _set_space(family: Family[Any], params: Parameters) -> Space:
    """What the mechanism takes as it is set and in those of its other settings that go."""
    pieces = [*space_of(family.parts(params), family.solve(params, LOOKS)).pieces]
    for other in family.settings(params).values():
        # The findings of a setting that does not go are its own.
        with suppress(DesignError):
            pieces += space_of(family.parts(other), family.solve(other, LOOKS)).pieces
    return Space(tuple(pieces))


def _geared(settings: MachineSettings, mounting: object) -> Finding:
    """The frame couples the motor to the input, so a gear between them has no place."""
    free = "plates" if isinstance(mounting, Mounting) else "none"
    return Finding.error(
        "frame.gear",
        "machine.gear",
        f'frame = "{settings.frame}" couples the motor straight to the input, and gear is {settings.gear:g}',
        settings.gear,
        1.0,
        remedy=f'leave gear out, or set frame = "{free}" and build gear and motor yourself',
        stage=Stage.PARTS,
        proposed=({"machine.gear": None}, {"machine.frame": free}),
    )


def _too_fast(speed: float, fastest: tuple[float, str]) -> tuple[Finding, ...]:
    """An input that is turned faster than the mechanism is made for."""
    most, key = fastest
    if not exceeds(speed, most):
        return ()
    return (
        Finding.error(
            "frame.speed",
            "machine.speed",
            f"the input turns at {speed:.6g} rev/min, and the spring holds the follower up to {most:.6g}",
            speed,
            most,
            "rev/min",
            remedy=f"set machine.speed = {most:.6g}, or {key} = {speed:.6g}",
            stage=Stage.PARTS,
            proposed=({"machine.speed": most}, {key: speed}),
        ),
    )


def _refused(code: str, error: DesignError) -> Surroundings:
    """By an error that begins with a key."""
    key, _, rest = str(error).partition(": ")
    found = refusal(code, key, rest)
    if isinstance(error, MountingError):
        found = replace(found, proposed=(*error.proposed, {"machine.frame": "none"}))
    return Surroundings(findings=(found,))
