"""What there is to say of a chain: of each stage under the loads of those behind it, then of all together.

What a design asks of the outputs of its stages, as the chain moves them.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import combinations
from typing import Annotated, Any

import numpy as np
from pydantic import TypeAdapter, ValidationError

from mechwright.arrays import Array
from mechwright.contracts.design_table import DesignTable
from mechwright.contracts.family import Family
from mechwright.contracts.finding import Change, Finding, Stage, errors
from mechwright.contracts.mounting import MountingError
from mechwright.contracts.parameters import Parameters, kept
from mechwright.contracts.procedure import Procedure
from mechwright.contracts.rule_list import Rules, all_of
from mechwright.errors import MechwrightError, PluginFaultError
from mechwright.mechanics.chain.assembly import assembly_of
from mechwright.mechanics.chain.indexing import index_figures, moves_of
from mechwright.mechanics.chain.links import Link, joining, links_of, staged
from mechwright.mechanics.chain.motion import rate_figures
from mechwright.mechanics.chain.params import ChainParams, Families
from mechwright.mechanics.chain.placing import Placed, in_plan
from mechwright.mechanics.chain.running import Run, finely
from mechwright.mechanics.chain.shafts import shaft_findings
from mechwright.units import Unit

LIMITS = {
    "most_ca": (
        "Ca",
        "its moves from rest to rest have a Ca",
        "take a pair of gears before it whose law is for it",
    ),
    "most_acceleration": ("output_acceleration_max", "its output accelerates by", "run the chain slower"),
    "most_jerk": ("output_jerk_max", "its output has a jerk", "run the chain slower"),
}
"""Field of a stage to the figure that it limits, what is said of it, and what helps."""


def asked_findings(params: ChainParams, families: Families) -> Iterator[Finding]:
    """An error for each figure of a stage that is greater than asked, or that the stage does not have."""
    asked = [(number, table) for number, table in enumerate(params.stage, start=1)]
    if not any(getattr(table, field) for _, table in asked for field in LIMITS):
        return
    figures = rate_figures(params, families) | index_figures(params, families)
    for number, table in asked:
        for field, (name, said, cure) in LIMITS.items():
            limit = getattr(table, field)
            if limit is None:
                continue
            key, found = f"stage.{number}.{field}", figures.get(f"{number}.{name}")
            where = f"stage {number}, {table.family}:"
            if found is None:
                yield Finding.error(
                    "chain.asked",
                    key,
                    f"{where} it has no such figure",
                    remedy=f"leave {field} out, or ask it of another stage",
                    stage=Stage.PARTS,
                    proposed=({key: None},),
                )
            elif found.value > limit:
                yield Finding.error(
                    "chain.asked",
                    key,
                    f"{where} {said} of {found.value:.5g} {found.unit}".rstrip()
                    + f", and at most {limit:g} is asked",
                    found.value,
                    limit,
                    found.unit,
                    cure,
                    Stage.PARTS,
                )


NEAREST = 1.0
"""mm. Shafts whose axes stand nearer to each other are meant to be one, and are none."""

_STANDS = 1e-9
"""Share of its greatest speed below which an input as good as stands: power says nothing of its torque."""

Judge = Callable[[Family[Any], Parameters], Sequence[Finding]]


@kept
def rules_of(families: Families) -> Rules[DesignTable[ChainParams]]:
    """The rules of a chain of these families: quickly by what each finds fast, else by all that it finds.

    They list no codes: a chain has those of its stages, and no study asks for them.
    """
    fast = Procedure[DesignTable[ChainParams]](
        (), lambda m: _findings(m.params, families, lambda family, own: family.judge(own)), quickly=True
    )
    whole = Procedure[DesignTable[ChainParams]](
        (), lambda m: _findings(m.params, families, lambda family, own: family.check(own)), slow=True
    )
    return all_of(fast, whole)


def _findings(params: ChainParams, families: Families, judge: Judge) -> tuple[Finding, ...]:
    faults = joining(params, families)
    if faults:
        return faults
    links, found = links_of(params, families), []
    for link, own in zip(links, loaded(params, families), strict=True):
        beyond = list(_beyond(links, own, link))
        found += beyond or [staged(link.number, link.family, one) for one in judge(link.family, own)]
    found += centre_findings(in_plan(links))
    found += asked_findings(params, families)
    if not errors(found, Stage.PARTS):
        found += _joined(params, families)
    return (*found, *_notes(params, families))


def _beyond(links: Sequence[Link], own: Parameters, link: Link) -> Iterator[Finding]:
    """What the chain asks of a stage that no design of its family may say."""
    for name, field in type(own).model_fields.items():
        value = getattr(own, name)
        if value == getattr(link.params, name):
            continue
        kind: Any = Annotated[(field.annotation, *field.metadata)]
        try:
            TypeAdapter(kind).validate_python(value)
        except ValidationError as error:
            (limit,) = error.errors()[0]["ctx"].values()
            unit = next((one.symbol for one in field.metadata if isinstance(one, Unit)), "")
            key, remedy, changes = _at_another_speed(links[0], limit / value)
            if name == link.transmission.load_field:
                key, remedy, changes = f"stage.{link.number}", "let the stages behind it take less", ()
            yield Finding.error(
                "chain.beyond",
                key,
                f"stage {link.number}, {link.family.name}: in this chain its {name} comes to {value:.4g} "
                f"{unit}, and its family knows {limit:g} at {'most' if value > limit else 'least'}",
                value,
                limit,
                unit,
                remedy,
                Stage.PARTS,
                changes,
            )


def _at_another_speed(first: Link, share: float) -> tuple[str, str, tuple[Change, ...]]:
    """The key, remedy and change with which a chain turns by a share slower or faster."""
    key = f"stage.{first.number}.parameters.{first.transmission.own_drive[0]}"
    share *= 0.99 if share < 1 else 1.01
    speed = float(f"{share * getattr(first.params, first.transmission.own_drive[0]):.3g}")
    return key, f"make {key} {speed:g}", ({key: speed},)


def _joined(params: ChainParams, families: Families) -> Iterator[Finding]:
    try:
        whole = assembly_of(params, families)
    except PluginFaultError:  # of no design
        raise
    except MechwrightError as error:
        key, _, rest = str(error).partition(": ")
        said, _, cure = rest.partition("; ")
        changes = error.proposed if isinstance(error, MountingError) else ()
        yield Finding.error("chain.assembly", key, said, remedy=cure, stage=Stage.PARTS, proposed=changes)
        return
    yield from shaft_findings(whole.places, whole.planes)


def centre_findings(places: tuple[Placed, ...]) -> Iterator[Finding]:
    """Shafts of different stages that would stand in one place."""
    shafts = [(1, places[0].at(places[0].link.transmission.input.point))]
    shafts += [
        (place.link.number, place.at(place.link.transmission.output.point))
        for place in places
        if place.link.transmission.output is not None
    ]
    for (one, here), (_, there) in combinations(enumerate(shafts), 2):
        apart = math.dist(here[1], there[1])
        if apart < NEAREST:
            number = there[0]
            which = "the input" if one == 0 else f"the output of stage {here[0]}"
            yield Finding.error(
                "chain.centres",
                f"stage.{number}.turned",
                f"stage {number}: the shaft of its output stands {apart:.3g} mm from that of {which}",
                apart,
                NEAREST,
                "mm",
                f"turn the stage away: stage.{number}.turned = 90",
                Stage.PARTS,
                ({f"stage.{number}.turned": 90.0},),
            )


@kept
def torques_of(params: ChainParams, families: Families) -> tuple[Array, ...]:
    """Torque (n,), N·m, at the input of each stage, of its own loads and of all stages behind it.

    By balance of power: what the input of a stage gives is what its loads and the next stage take. Where an
    input stands, nothing is taken.
    """
    run = finely(params, families)
    taken = np.zeros_like(run.time)
    found: list[Array] = []
    for link, drive in reversed(list(zip(run.links, run.inputs, strict=True))):
        taken = taken + link.transmission.power(drive, link.transmission.motion(drive, run.time))
        found.append(_over_speed(taken, drive.omega))
    return tuple(reversed(found))


def _over_speed(power: Array, omega: Array) -> Array:
    moving = np.abs(omega) > _STANDS * np.abs(omega).max()
    return np.where(moving, power / np.where(moving, omega, 1.0), 0.0)


@kept
def loaded(params: ChainParams, families: Families) -> tuple[Parameters, ...]:
    """The tables of all stages as they run in the chain, for the checks of their families.

    A stage that is driven has what its input asks of it, and the torque against its output is that of
    its own table and the greatest of the next stage.
    """
    run, torques = finely(params, families), torques_of(params, families)
    found = []
    for place, (link, drive) in enumerate(zip(run.links, run.inputs, strict=True)):
        own, changed = link.transmission, dict[str, float]()
        if place > 0:
            changed |= own.driven_fields(drive)
        if own.load_field and place + 1 < len(run.links):
            behind = float(np.abs(torques[place + 1]).max())
            changed[own.load_field] = getattr(link.params, own.load_field) + behind
        found.append(link.params.model_copy(update=changed))
    return tuple(found)


def _notes(params: ChainParams, families: Families) -> Iterator[Finding]:
    run, torques = finely(params, families), torques_of(params, families)
    for link, torque in zip(run.links, torques, strict=True):
        most = float(np.abs(torque).max())
        if most > 0:
            yield Finding.note(
                "chain.torque",
                f"stage {link.number}, {link.family.name}: its input takes up to {most:.4g} N·m, with all "
                "that stands behind it",
                most,
                "N*m",
            )
    yield from _unhanded(run, torques)
    for place in range(1, len(run.links)):
        yield _key_note(run, place)
    seen: set[int] = set()
    for move in moves_of(params, families):
        if move.number not in seen:
            seen.add(move.number)
            yield Finding.note(
                "chain.index",
                f"stage {move.number}: a move from rest to rest takes {move.time:.4g} s, Ca = "
                f"{move.acceleration:.4f}, of 4 that any law has at least",
                move.acceleration,
            )


def _unhanded(run: Run, torques: tuple[Array, ...]) -> Iterator[Finding]:
    for place, link in enumerate(run.links[:-1]):
        behind = float(np.abs(torques[place + 1]).max())
        if behind > 0 and not link.transmission.load_field:
            yield Finding.warning(
                "chain.load",
                f"stage.{link.number}",
                f"stage {link.number}, {link.family.name}: its strength is judged without the "
                f"{behind:.4g} N·m that stage {link.number + 1} takes",
                behind,
                unit="N*m",
                remedy="check it as a design of its own, with that torque against its output",
                stage=Stage.PARTS,
            )


def _key_note(run: Run, place: int) -> Finding:
    """The angle by which two bodies stand on their shaft to each other, the same all along."""
    before, link = run.links[place - 1], run.links[place]
    port = before.transmission.output
    assert port is not None  # noqa: S101 - the stages are joined
    out = before.transmission.move(run.inputs[place - 1]).theta[0] * port.sense
    own = run.inputs[place].theta[0] * link.transmission.input.sense
    turned = math.radians(link.table.turned - before.table.turned)
    angle = math.degrees(own - out + turned) % 360
    return Finding.note(
        "chain.key",
        f"stage {link.number}, {link.family.name}: its {link.transmission.input.body} stands {angle:.4f} "
        f"degrees ahead of the {port.body} of stage {before.number} on their shaft, by the angles that their "
        "channels count",
        angle,
        "deg",
    )
