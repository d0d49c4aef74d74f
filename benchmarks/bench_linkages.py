"""Linkages of the catalogue: motion against Newton, requirements with a known answer, designs of a sweep.

    python benchmarks/bench_linkages.py motion --linkages 200
    python benchmarks/bench_linkages.py synthesis --each 10 --first 0 --kinds dwell function path
    python benchmarks/bench_linkages.py sweep --designs 4000

``motion`` compares the positions and two rates of all links with Newton's method on all joint equations at
once, and with central differences of it. ``synthesis`` draws linkages at random, keeps those that keep the
limits of a requirement, and asks for what they do: their dwell, their outputs at nine inputs, nine points of
their path. Times are the processor's.
"""

import argparse
import math
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import islice
from typing import Any

import numpy as np
from harness import require
from linkage_newton import Array, rates, standing, unknowns

from mechwright import KinematicsError, Parameters, Stage
from mechwright.contracts.evaluation import Batch
from mechwright.mechanics.linkage.kinematics.channels import transmission_angle
from mechwright.mechanics.planar.machine import Machine
from mechwright.mechanics.planar.positions import solve
from mechwright.mechanics.planar.rigid import Turning
from mechwright_linkage.catalogue.entries import ENTRIES
from mechwright_linkage.catalogue.entry import Entry
from mechwright_linkage.family import Linkages
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.requirements import (
    DwellRequirement,
    FunctionRequirement,
    LinkageSearch,
    PathRequirement,
)
from mechwright_linkage.synthesis.tasks import output_of
from mechwright_linkage.synthesis.unknowns import Unknowns, joint_distances

NEAR, INPUTS, LEAST = 0.3, 7, math.radians(15)
"""Spread of random dimensions, of that of the synthesis; inputs of each; least transmission angle, rad."""

H = 0.003
"""Step of the differences, rad."""

TURN = np.radians(np.arange(0.0, 361.0, 2.0))
DRAWS, LIMIT = 2_000, 30.0
"""Random linkages that are drawn together; seconds of the processor for a requirement."""


def inputs_of(machine: Machine) -> Array | None:
    """Inputs over the turn, or 0.3 rad to both sides of the drawn position; None near a dead point."""
    start = float(np.ravel(machine.drawn_at[0])[0])
    for half in (math.pi, 0.3):
        at = np.linspace(start - half, start + half, 181)
        found = solve(machine, [Turning.of(at, 1.0)])
        if found.closes.all() and np.min(transmission_angle(found), initial=1.0) > LEAST:
            return at[np.linspace(9, 171, INPUTS).astype(int)]
    return None


def random_machines(rng: np.random.Generator) -> Iterator[tuple[str, Entry, Machine, Array]]:
    """Random linkages of all kinds in turn."""
    while True:
        for name, kind in ENTRIES.items():
            own = Unknowns(kind())
            for _ in range(50):
                try:
                    entry = own.plain(NEAR * own.random(2, rng)[1])
                    machine = entry.linkage().machine
                    at = inputs_of(machine)
                except (ValueError, KinematicsError):
                    continue
                if at is not None:
                    yield name, entry, machine, at
                    break


def compared(machine: Machine, at: Array, size: float) -> tuple[float, float, float]:
    """Largest differences of positions and both rates, over the largest of each."""
    found = solve(machine, [Turning.of(at, 1.0)])

    def moving(order: int, place: int) -> Array:
        poses = {}
        for link in machine.links:
            body = found.bodies[link]
            z = getattr(body.origin, ("position", "velocity", "acceleration")[order])
            angle = getattr(body.turning, ("theta", "omega", "alpha")[order])
            z, angle = (np.broadcast_to(one, at.shape)[place] for one in (z, angle))
            poses[link] = complex(z), float(angle)
        return unknowns(machine, poses)

    scale = np.tile([size, size, 1.0], len(machine.links))
    own = [np.array([moving(order, place) for place in range(at.size)]) / scale for order in range(3)]
    rng = np.random.default_rng(0)
    place = partial(_placed, machine, size)
    other = []
    for number, value in enumerate(at):
        aside = own[0][number] * scale + 1e-3 * scale * rng.standard_normal(scale.size)
        q = place(value, aside)
        other.append((q, *rates(place, q, value, H)))
    offs = []
    for order in range(3):
        theirs = np.array([one[order] for one in other]) / scale
        offs.append(float(np.abs(theirs - own[order]).max() / max(np.abs(theirs).max(), 1.0)))
    return offs[0], offs[1], offs[2]


def _placed(machine: Machine, size: float, at: float, start: Array) -> Array:
    return standing(machine, start, at, size)


def motion(count: int) -> bool:
    """Positions and rates of random linkages against Newton and differences."""
    worst: dict[str, tuple[int, Array]] = {}
    start = time.process_time()
    for name, entry, machine, at in islice(random_machines(np.random.default_rng(7)), count):
        offs = np.array(compared(machine, at, Unknowns(entry).size))
        number, most = worst.get(name, (0, np.zeros(3)))
        worst[name] = number + 1, np.maximum(most, offs)
    print(f"\n{count} random linkages, {time.process_time() - start:.0f} s: position, velocity, acceleration")
    for name, (number, most) in worst.items():
        print(f"  {name:<15} {number:3d}  " + "  ".join(f"{one:.1e}" for one in most))
    most = np.max([one for _, one in worst.values()], axis=0)
    print(f"  {'all':<15} {count:3d}  " + "  ".join(f"{one:.1e}" for one in most))
    limits = (1e-10, 1e-8, 1e-8)
    names = ("positions", "velocities", "accelerations")
    kept = [
        require(f"{name} over their limit of {limit:g}", one / limit, 1.0)
        for name, one, limit in zip(names, most, limits, strict=True)
    ]
    return all(kept)


def turning(name: str, limits: LinkageSearch, rng: np.random.Generator) -> tuple[Unknowns, Array, Any, Any]:
    """Random linkages (n, m) of a kind that turn and keep the limits, and their motion over the turn."""
    own = Unknowns(ENTRIES[name]())
    x = own.random(DRAWS, rng)
    with np.errstate(all="ignore"):
        linkage, found = own.moved(x, TURN)
        sines = np.min(np.sin(transmission_angle(found)), axis=-1)
        lengths = np.broadcast_to(joint_distances(linkage), (DRAWS, joint_distances(linkage).shape[-1]))
        good = found.closes.all(axis=-1) & (sines > math.sin(math.radians(limits.least_transmission_angle)))
    good &= (lengths.min(axis=1) > limits.shortest_link) & (lengths.max(axis=1) < limits.longest_link)
    good[0] = False  # the entry itself, which the search tries first
    x = x[good]
    return (own, x, *own.moved(x, TURN)) if len(x) else (own, x, None, None)


def dwells(rng: np.random.Generator) -> Iterator[tuple[str, DwellRequirement]]:
    """Strokes of random linkages that dwell over 60 degrees within 1 %."""
    names = ("stephenson-3", "watt-2")
    while True:
        for name in names:
            _, _, linkage, found = turning(name, DwellRequirement(), rng)
            if linkage is None:
                continue
            output, slides = output_of(linkage, found)
            stroke = np.ptp(output, axis=1)
            turn = output[:, -1] - output[:, 0]
            twice = np.hstack([output[:, :-1], output + turn[:, None]])
            least = np.min([np.ptp(twice[:, k : k + 31], axis=1) for k in range(180)], axis=0)
            for row in np.flatnonzero((least < 0.01 * stroke) & (abs(turn) < 1e-6))[:1]:
                size = float(stroke[row] if slides else np.degrees(stroke[row]))
                if size > 5:
                    yield name, DwellRequirement(stroke=round(size, 2))


def functions(rng: np.random.Generator) -> Iterator[tuple[str, FunctionRequirement]]:
    """Outputs of random linkages at nine inputs over 320 degrees."""
    while True:
        for name in ("stephenson-3", "watt-2"):
            _, _, linkage, found = turning(name, FunctionRequirement(), rng)
            if linkage is None:
                continue
            output, slides = output_of(linkage, found)
            row = output[0] if slides else np.degrees(output[0])
            outputs = tuple(float(one) for one in np.round(row[:161:20] - row[0], 3))
            yield name, FunctionRequirement(input_angles=tuple(range(0, 321, 40)), outputs=outputs)


def paths(rng: np.random.Generator) -> Iterator[tuple[str, PathRequirement]]:
    """Nine points of the paths of random linkages, without angles."""
    while True:
        for name in ("klann", "stephenson-3", "watt-1"):
            _, _, linkage, found = turning(name, PathRequirement(), rng)
            if linkage is None:
                continue
            link, point = next(iter(linkage.traces.values()))
            place = np.broadcast_to(linkage.points[link][point], (len(found.closes), 1))
            path = np.broadcast_to(found.bodies[link].point(place).position, found.closes.shape)[0, :161:20]
            yield name, PathRequirement(points=tuple((round(z.real, 3), round(z.imag, 3)) for z in path))


def synthesis(each: int, first: int, kinds: Sequence[str]) -> bool:
    """How many requirements with a known answer are met, and in what time."""
    sources: Mapping[str, Any] = {"dwell": dwells, "function": functions, "path": paths}
    kept = []
    for kind in kinds:
        found, seconds, best = 0, [], []
        for name, wanted in islice(sources[kind](np.random.default_rng(11)), first, first + each):
            start = time.process_time()
            residual, count = _met(kind, wanted)
            seconds.append(time.process_time() - start)
            share = residual / wanted.tolerance
            met = share <= 1 and seconds[-1] <= LIMIT
            found += met
            best.append(share)
            said = f"{share:8.3g} of the tolerance, {count:2d} designs, {seconds[-1]:6.1f} s"
            print(f"  {kind:<9} {name:<13} {getattr(wanted, 'stroke', ''):<7} {said}")
        print(
            f"{kind}: {found}/{each} met within {LIMIT:g} s; median {np.median(seconds):.1f} s, longest "
            f"{max(seconds):.1f} s; of the tolerance: best {min(best):.2g}, median {np.median(best):.2g}, "
            f"worst {max(best):.2g}"
        )
        kept.append(require(f"{kind}: requirements that are missed", each - found, 0))
    return all(kept)


def _silent(done: float, what: str) -> None:
    """Report nothing."""


def _met(kind: str, wanted: Parameters) -> tuple[float, int]:
    """The residual of the best design, in the unit of the tolerance, and how many designs there are."""
    found = Linkages().synthesise(kind, wanted, _silent).candidates
    if not found:
        return math.inf, 0
    residual = found[0].shown["residual"]
    return (math.degrees(residual.value) if residual.unit == "rad" else residual.value), len(found)


SWEPT: Mapping[str, tuple[str, float, Sequence[str]]] = {
    "watt-2": ("output_swing", 0.1, ("crank", "coupler", "link5")),
    "stephenson-3": ("output_swing", 0.1, ("crank", "coupler", "link5")),
    "jansen": ("output_swing", 0.02, ("m", "a", "b")),
    "crank-shaper": ("output_stroke", 0.1, ("crank", "lever", "rod")),
}
"""Linkage to a figure, and to a share by which dimensions are varied."""


def sweep(designs: int, names: Sequence[str]) -> bool:
    """Designs a second and core of a sweep of the motion, and how many are decided by arrays."""
    kept = []
    print(f"\n{designs} designs: linkage, designs a second and core, allowed, decided by arrays")
    for name in names:
        figure, share, varied = SWEPT[name]
        family, asked = _Counted(), LinkageParams(linkage=name)
        rng, table = np.random.default_rng(3), name.replace("-", "_")
        columns = {
            f"{table}.{key}": getattr(asked.entry, key) * rng.uniform(1 - share, 1 + share, designs)
            for key in varied
        }
        measured = tuple(one for one in ("least_transmission_angle", figure) if one in family.measures(asked))
        batch = Batch(LinkageParams, {"linkage": name}, columns)
        start = time.process_time()
        found = family.evaluate(batch, measured, Stage.MOTION)
        seconds = time.process_time() - start
        allowed = np.mean(found.forbidden == 0)
        arrays = 1 - family.judged / designs
        print(f"  {name:<13} {designs / seconds:9.0f} {allowed:7.1%} {arrays:8.2%}  {', '.join(measured)}")
        kept.append(require(f"{name}: share that arrays do not decide, in %", 100 * (1 - arrays), 1.0))
    return all(kept)


class _Counted(Linkages):
    """The family, which counts the designs that are judged one by one."""

    judged = 0

    def table(self, params: LinkageParams, size: int | None = None) -> Any:
        self.judged += size is None
        return super().table(params, size)


def main() -> int:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", nargs="*", default=["motion", "synthesis", "sweep"])
    parser.add_argument("--linkages", type=int, default=200)
    parser.add_argument("--each", type=int, default=10)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--kinds", nargs="*", default=["dwell", "function", "path"])
    parser.add_argument("--swept", nargs="*", default=list(SWEPT))
    parser.add_argument("--designs", type=int, default=4_000)
    chosen = parser.parse_args()
    work = {
        "motion": lambda: motion(chosen.linkages),
        "synthesis": lambda: synthesis(chosen.each, chosen.first, chosen.kinds),
        "sweep": lambda: sweep(chosen.designs, chosen.swept),
    }
    kept = [work[one]() for one in chosen.what]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
