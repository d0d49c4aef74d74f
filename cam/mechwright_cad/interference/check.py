"""The check itself: every pair of bodies, over the whole motion."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from hashlib import blake2b
from itertools import combinations, product

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.by_form import kept_by_form
from mechwright.contracts.finding import Finding, Stage, errors
from mechwright.contracts.holes import joined
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Instance, Part
from mechwright.designs.design import Design
from mechwright.pipeline.result_store import stored
from mechwright_cad.bodies import Body, bodies_of
from mechwright_cad.interference import plates
from mechwright_cad.interference.apart import apart
from mechwright_cad.interference.path import Path, flat, plane_path, relative, space_path
from mechwright_cad.interference.report import Collision, Gap, Instant, Report, settings_findings
from mechwright_cad.interference.slabs import TOUCH, Slab, slabs_of

FEWEST_SAMPLES = 181
"""Samples that the check starts with, every 2 degrees of a turn; more where the motion bends faster."""

MOST_SAMPLES = 2881
"""More samples than this, every eighth of a degree, are not asked for: a motion with a kink never gets
smooth, and a kink's error is below a hundredth of a millimetre there."""

FAITHFUL = 2e-4
"""Error of the motion between samples that needs no more samples, mm: hardly a part of a contact."""

_USUAL = 100.0
"""Reach of parts that are no plates, mm."""

_LOOKS_IN_PLAN = 33
"""Instants at which the depth of a collision of plates is measured before it is refined."""

_LOOKS_IN_SPACE = 9
"""The same for solids, of which a look takes some ten times as long."""

_ROUNDS = 4
"""Refinements of the deepest instant, each on four times closer ones."""

_CLOSER = np.array((-1.0, -0.75, -0.5, -0.25, 0.25, 0.5, 0.75, 1.0))


@stored
def interference(parts: Sequence[Part], motion: Motion, *, solids: bool = True) -> Report:
    """Look for bodies that stand in each other at any instant of a motion.

    The motion is sampled so finely that a cubic through the samples is the motion (:func:`smooth_motion`).
    Parts of one body are compared as well, at rest. Plates that stay parallel are compared exactly in the
    plane; all other bodies as triangles in space if ``solids`` are asked for, which takes the CAD kernel
    where a part is a solid. What is stretched by the motion, such as a spring, is drawn at one instant and is
    passed over. Raises GeometryError as :func:`bodies_of` does, or where a part cannot be made.
    """
    bodies = [one for one in bodies_of(parts, motion) if not _is_stretched(one.part)]
    collisions: list[Collision] = []
    gaps: list[Gap] = []
    skipped: set[str] = set()
    count = 0
    for one, two in combinations(bodies, 2):
        found = _meeting(one, two, *relative(one.poses, two.poses), solids)
        if found is None:
            skipped |= {body.name for body in (one, two) if not body.is_plate} or {one.name, two.name}
            continue
        count += 1
        collisions += [_collision(one, two, motion, *hit) for hit in found.hits]
        gaps += [Gap(one.name, two.name, _instant(motion, time), gap) for time, gap in found.gaps]
    worst: dict[tuple[str, str], Collision] = {}
    for hit_ in sorted(collisions, key=lambda item: -item.depth):
        worst.setdefault((hit_.first, hit_.second), hit_)
    return Report(
        count,
        tuple(worst.values()),
        min(gaps, key=lambda gap: gap.distance, default=None),
        tuple(sorted(skipped)),
    )


@dataclass(frozen=True)
class _Met:
    """Hits as time, depth and place (3,) in the first body's frame, and gaps as time and width."""

    hits: tuple[tuple[float, float, Array], ...] = ()
    gaps: tuple[tuple[float, float], ...] = ()


_MOST_KNOWN = 20_000
"""Pairs whose meetings are kept: a machine of 60 bodies has 1,770, in up to five settings."""

_known: dict[tuple[object, ...], _Met | None] = {}


def _meeting(one: Body, two: Body, rotation: Array, position: Array, solids: bool) -> _Met | None:
    """How two bodies meet; None if that takes their solids, and these are not asked for.

    It is kept: most pairs of a machine are the same in all its settings, and after a change of one part.
    """
    motion = blake2b(rotation.tobytes() + position.tobytes(), digest_size=16).digest()
    key = (one.part.form, one.instance.z, two.part.form, two.instance.z, motion, solids)
    if key not in _known:
        if len(_known) >= _MOST_KNOWN:
            _known.clear()
        _known[key] = _met(one, two, rotation, position, solids)
    return _known[key]


def _met(one: Body, two: Body, rotation: Array, position: Array, solids: bool) -> _Met | None:
    layers = [_slabs(body.part, body.instance.z, solids) for body in (one, two)]
    up = flat(rotation, position) if all(layers) else None
    if up is None and not solids:
        return None
    if up is None:
        if apart(one, two, rotation, position):
            return _Met()
        hit = _in_space(one, two, space_path(rotation, position))
        return _Met() if hit is None else _Met((hit,))
    path = plane_path(rotation, position)
    height = float(position[0, 2])
    hits: list[tuple[float, float, Array]] = []
    gaps: list[tuple[float, float]] = []
    for a, b in product(*layers):
        other = b if up else b.face_down()
        common = min(a.top, other.top + height) - max(a.bottom, other.bottom + height)
        if common <= TOUCH:
            continue
        found = plates.meetings(a, other, path)
        if found.hits.size:
            depth_at = partial(plates.depth, a, other, path)
            time, depth, (x, y) = deepest(depth_at, found.hits, path, _LOOKS_IN_PLAN)
            z = max(a.bottom, other.bottom + height) + common / 2
            hits.append((time, min(depth, common), np.array((x, y, z))))
        elif found.closest is not None and not path.still:
            gap = plates.gap(a, other, path, found.closest)
            if gap > TOUCH:
                gaps.append((found.closest, gap))
    return _Met(tuple(hits), tuple(gaps))


def _is_stretched(part: Part) -> bool:
    return part.bought is not None and part.bought.stretched


@kept_by_form(512)
def _slabs(part: Part, low: float, solids: bool) -> tuple[Slab, ...]:
    """The layers of a plate, or of a solid if it has some and solids are asked for."""
    if part.outline is not None:
        return slabs_of(part, Instance("", low))
    if not solids:
        return ()
    from mechwright_cad.interference.prisms import prisms_of

    return prisms_of(part, low) or ()


def _in_space(one: Body, two: Body, path: Path) -> tuple[float, float, Array] | None:
    """Time, depth and place (3,) of the deepest overlap of two bodies in space, in the first one's frame."""
    from mechwright_cad.interference import meshes
    from mechwright_cad.interference.surface import surface_of

    first, second = surface_of(one.part, one.instance), surface_of(two.part, two.instance)
    hits = meshes.meetings(first, second, path)
    if not hits.size:
        return None
    return deepest(partial(meshes.depth, first, second, path), hits, path, _LOOKS_IN_SPACE)


def deepest(
    depth: Callable[[float], tuple[float, Array]], hits: Array, path: Path, looks: int
) -> tuple[float, float, Array]:
    """Time, in samples, depth, mm, and place of the deepest overlap around the times of some hits (n,)."""
    last = float(path.samples - 1)
    # A long collision has a hit in each interval; its ends count as well.
    some = hits[np.unique(np.linspace(0, len(hits) - 1, looks).round().astype(int))]
    seen = [(float(time), *depth(float(time))) for time in some]
    best = max(seen, key=lambda item: item[1])
    if path.still:
        return best
    reach = max(1.0, float(np.diff(some).max(initial=0.0)) if len(some) > 1 else 1.0)
    for _ in range(_ROUNDS):
        for time in np.clip(best[0] + reach * _CLOSER, 0.0, last):
            look = (float(time), *depth(float(time)))
            if look[1] > best[1]:
                best = look
        reach /= 4
    return best


def _collision(one: Body, two: Body, motion: Motion, time: float, depth: float, at: Array) -> Collision:
    turn, place = space_path(one.poses.rotation, one.poses.position).at(np.array([time]))
    x, y, z = (turn[0] @ at + place[0]).tolist()
    return Collision(one.name, two.name, _instant(motion, time), depth, (x, y, z))


def _instant(motion: Motion, time: float) -> Instant:
    channel = motion.channels[motion.input_name]
    value = float(np.interp(time, np.arange(motion.samples), channel.values))
    return Instant(motion.input_name, value, channel.unit)


def smooth_motion(solve: Callable[[int], Motion], parts: Sequence[Part]) -> Motion:
    """The motion that ``solve`` gives, with as many samples as a cubic between them needs."""
    samples = FEWEST_SAMPLES
    motion = solve(samples)
    reach = _reach(parts)
    while samples < MOST_SAMPLES and _error(motion, reach) > FAITHFUL:
        samples = 2 * samples - 1
        motion = solve(samples)
    return motion


def _error(motion: Motion, reach: float) -> float:
    paths = [space_path(poses.rotation, poses.position) for poses in motion.poses.values()]
    return max((path.error(reach) for path in paths), default=0.0)


def _reach(parts: Sequence[Part]) -> float:
    """Greatest distance, mm, of a plate's corner from its own axis; a solid's is not asked for."""
    far = [np.abs(part.outline.bounds).max() for part in parts if part.outline is not None]
    return float(np.hypot(1, 1) * max(far, default=_USUAL))


def interference_findings(design: Design, parts: Sequence[Part], *, solids: bool) -> list[Finding]:
    """What the check says of the parts of a design whose own check found no error, in all its settings.

    What is pressed or screwed into a hole of ``parts`` is meant to stand there: they are taken as they are.
    """
    if sum(len(part.instances) for part in parts) < 2:
        return []
    found = [*_report(design, parts, solids).findings()]
    found += settings_findings(_settings(design, solids))
    return found


def _report(design: Design, parts: Sequence[Part], solids: bool) -> Report:
    return interference(parts, smooth_motion(design.solve, parts), solids=solids)


def _settings(design: Design, solids: bool) -> dict[str, Report | list[Finding]]:
    """What the machine is set to besides, and the report of each setting, or why it cannot be built."""
    found: dict[str, Report | list[Finding]] = {}
    for name, setting in design.settings().items():
        wrong = errors(setting.check(), Stage.PARTS)
        found[name] = wrong or _report(setting, [joined(part) for part in setting.parts()], solids)
    return found
