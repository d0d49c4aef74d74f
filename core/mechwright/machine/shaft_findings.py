"""Whether what stands on the driven shaft bears the drive's torque: the shaft, its key, a coupling."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright.contracts.finding import Finding
from mechwright.contracts.joint import GROUND, Joint
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part
from mechwright.errors import DesignError
from mechwright.geometry.keyway import key_of_width
from mechwright.machine.drive import Drive
from mechwright.machine.made import motion_for
from mechwright.machine.motors import Choice
from mechwright.machine.outputs import fixed_to
from mechwright.machine.settings import MachineSettings
from mechwright.mechanics.strength.allowed import REVERSING_KEY, allowed
from mechwright.mechanics.strength.fastening import LONGEST_KEY, key_pressure
from mechwright.mechanics.strength.shaft import least_diameter, von_mises
from mechwright.pipeline.build import Build
from mechwright.standards.couplings import coupling_for
from mechwright.standards.keys import bearing_length

SAFETY = 2.0
"""Of the endurance limit over the stress of torsion, for key seats, shoulders and unknown bending."""

ON_AXIS = 1e-6
"""How far from the driven axis the origin of a body may be, mm."""


def shaft_findings(
    build: Build, drive: Drive, settings: MachineSettings, choice: Choice | None
) -> Iterator[Finding]:
    """The driven shaft where it is a turned part, its key where it is a standard one, and the coupling."""
    motion = build.made(motion_for)
    joint = next((one for one in motion.joints.values() if one.drives and one.kind == "revolute"), None)
    if joint is None:
        return
    torque = settings.margin * abs(drive.peak()[0])
    bodies = [body for body in fixed_to(joint.two, motion.joints) if _on_axis(motion, joint, body)]
    here = [part for part in build.parts if any(one.body in bodies for one in part.instances)]
    shafts = [part for part in here if part.turned is not None]
    for shaft in shafts:
        yield _shaft(shaft, torque)
    reverses = len(drive.runs) > 1 or any(run.torque.min() < 0 for run in drive.runs)
    for key in here:
        if shafts and key.bought is not None and key.bought.standard.startswith("DIN 6885"):
            yield _key(key, here, shafts[0], torque, reverses=reverses)
    if shafts and choice is not None and settings.gear == 1:
        yield _coupling(shafts[0], choice, torque)


def _on_axis(motion: Motion, joint: Joint, body: str) -> bool:
    """Whether a body's own z is the driven axis, all along."""
    point, axis = np.array(joint.point), np.array(joint.axis)
    if joint.one != GROUND:
        frame = motion.poses[joint.one]
        point, axis = frame.rotation[0] @ point + frame.position[0], frame.rotation[0] @ axis
    own = motion.poses[body]
    aside = np.cross(own.position - point, axis)
    return bool(np.abs(aside).max() < ON_AXIS and abs(own.rotation[0, :, 2] @ axis) > 1 - ON_AXIS)


def _shaft(part: Part, torque: float) -> Finding:
    """Torsion of the thinnest step, at a key seat of the circle that is left."""
    turned = part.turned
    assert turned is not None  # noqa: S101 - the caller looked
    sizes = [step.least for step in turned.steps]
    sizes += [seat.floor + turned.greatest / 2 for seat in turned.seats]
    least, limit = min(sizes), allowed(part.material).endurance / SAFETY
    stress = von_mises(least, 0.0, torque)
    words = (
        f"{part.name} bears {torque:.3g} N·m in torsion where {least:.4g} mm are left: {stress:.3g} MPa (von "
        f"Mises); {part.material} bears {limit:g} with a safety of {SAFETY:g}"
    )
    if stress <= limit:
        return Finding.note("machine.shaft", words, stress, "MPa")
    wanted = math.ceil(10 * least_diameter(0.0, torque, limit)) / 10
    return Finding.warning(
        "machine.shaft",
        "machine",
        words,
        stress,
        limit,
        "MPa",
        f"make it {wanted:g} mm thick there, or run slower",
    )


def _key(key: Part, here: list[Part], shaft: Part, torque: float, *, reverses: bool) -> Finding:
    """Pressure on the hub's side of a key, in the weakest plate on the shaft."""
    assert key.bought is not None  # noqa: S101 - the caller looked
    assert shaft.turned is not None  # noqa: S101
    form, _, sizes = key.bought.designation.rpartition(" - ")[2].partition(" ")
    width, _, length = (float(word) for word in sizes.split(" x "))
    bears = bearing_length(length, width, "A" if form == "A" else "B")
    bears = min(bears, LONGEST_KEY * shaft.turned.greatest)
    size = key_of_width(width)
    assert size is not None  # noqa: S101 - it is a standard key
    hubs = [part.material for part in here if part.kind == "plate"] or [shaft.material]
    hub = min(hubs, key=lambda name: allowed(name).key)
    limit = allowed(hub).key * (REVERSING_KEY if reverses else 1.0)
    pressure = key_pressure(torque, shaft.turned.greatest, size.height - size.shaft_depth, bears)
    words = (
        f"the key {width:g} x {size.height:g} x {length:g} presses with {pressure:.3g} MPa on the {hub} of "
        f"its hub at {torque:.3g} N·m; {limit:g} are allowed"
        + (" where the torque changes its sense" if reverses else "")
    )
    if pressure <= limit:
        return Finding.note("machine.key-pressure", words, pressure, "MPa")
    wanted = math.ceil(length - bears + bears * pressure / limit)
    return Finding.warning(
        "machine.key-pressure",
        "machine",
        words,
        pressure,
        limit,
        "MPa",
        f"use a key and a hub of {wanted:g} mm, or a larger bore",
    )


def _coupling(shaft: Part, choice: Choice, torque: float) -> Finding:
    """The coupling between motor and shaft, by its thicker end."""
    assert shaft.turned is not None  # noqa: S101 - the caller looked
    end = round(max(shaft.turned.steps[0].diameter, shaft.turned.steps[-1].diameter), 1)
    try:
        found = coupling_for(choice.motor.face.shaft, end, torque)
    except DesignError as error:
        return Finding.note("machine.coupling", f"{shaft.name} to {choice.motor.name}: {error}")
    said = f"{found.bought.designation} carries {found.of.torque:g} N·m, {torque:.3g} N·m are asked"
    return Finding.note("machine.coupling", said, found.of.torque, "N*m")
