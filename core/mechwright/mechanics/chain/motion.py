"""The motion of a chain: channels, bodies and figures of all stages over one period."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mechwright.contracts.joint import Joint
from mechwright.contracts.load import Load
from mechwright.contracts.motion import TIME, Channel, Curve, Motion, Poses, Scalar, Trace
from mechwright.mechanics.chain.indexing import index_figures
from mechwright.mechanics.chain.links import Link, links_of
from mechwright.mechanics.chain.params import ChainParams, Families
from mechwright.mechanics.chain.placing import Placed
from mechwright.mechanics.chain.running import finely, run_of

LASTING = {"mm", "rad", "deg", "kg"}
"""Units of figures of a stage that hold whatever turns it; those of rates and forces are those of its own
drive."""


def motion_of(params: ChainParams, families: Families, places: tuple[Placed, ...], samples: int) -> Motion:
    """One period of the chain: its stages come back after whole turns of the input.

    Channels, bodies, joints and figures of a stage have its number before their names; ``time`` and the input
    are those of the first. Raises KinematicsError where the stages cannot be joined.
    """
    links = links_of(params, families)
    run = run_of(links, samples)
    channels = {TIME: Channel(run.time, "s", "time")}
    poses: dict[str, Poses] = {}
    joints: dict[str, Joint] = {}
    traces: dict[str, Trace] = {}
    curves: dict[str, Curve] = {}
    loads: dict[str, Load] = {}
    scalars: dict[str, Scalar] = {}
    begins, before = "", ""
    for place, drive in zip(places, run.inputs, strict=True):
        link, own = place.link, place.link.transmission
        motion = own.motion(drive, run.time)
        begins = begins or _named(link, motion.input_name)
        channels |= dict(_channels(link, motion))
        poses |= place.poses(motion.poses)
        joints |= place.joints(motion.joints, before)
        loads |= place.loads(motion.loads)
        for name, trace in motion.traces.items():
            traces[link.named(name)] = replace(trace, body=link.named(trace.body))
        for name, curve in motion.curves.items():
            curves[link.named(name)] = replace(curve, body=link.named(curve.body))
        scalars |= {
            _named(link, name): one
            for name, one in motion.scalars.items()
            if link.number == 1 or one.unit in LASTING
        }
        before = "" if own.output is None else link.named(own.output.body)
    scalars |= rate_figures(params, families) | index_figures(params, families)
    return Motion(begins, channels, poses, scalars, traces, joints, curves, loads)


def _named(link: Link, name: str) -> str:
    """A channel or figure of a stage."""
    return f"{link.number}.{name}"


def _channels(link: Link, motion: Motion) -> Iterator[tuple[str, Channel]]:
    for name, channel in motion.channels.items():
        if name != TIME:
            label = motion.labels[name]
            yield _named(link, name), replace(channel, label=f"stage {link.number}: {label}")


def rate_figures(params: ChainParams, families: Families) -> dict[str, Scalar]:
    """Greatest rates of the shaft that comes out of each stage, as finely sampled, and the period."""
    run = finely(params, families)
    found = {"period": Scalar(float(abs(run.time[-1])), "s")}
    for link, drive in zip(run.links, run.inputs, strict=True):
        if link.transmission.output is None:
            continue
        out = link.transmission.move(drive)
        for name, values, unit in (
            ("output_speed_max", out.omega, "rad/s"),
            ("output_acceleration_max", out.alpha, "rad/s^2"),
            ("output_jerk_max", out.jerk, "rad/s^3"),
        ):
            found[_named(link, name)] = Scalar(float(np.abs(values).max()), unit)
    return found
