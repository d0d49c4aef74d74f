"""A linkage that closes nowhere: the dyad, where it comes nearest, and the nearest lengths that close it."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from mechwright import Array, Finding, Stage
from mechwright.contracts.design_table import with_columns
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.planar.assembly_order import Dyad
from mechwright.mechanics.planar.closing import closing_quantities
from mechwright.mechanics.planar.machine import Revolute
from mechwright.mechanics.planar.outer_joints import outer_pin
from mechwright.mechanics.planar.rigid import BodyMotion
from mechwright.units import Unit
from mechwright_linkage.catalogue.entry import Entry
from mechwright_linkage.table import LinkageTable

SAMPLES = 361
"""Inputs over a turn at which links are tried."""

FACTORS = np.concatenate([1.02 ** np.arange(1, 60), 1.02 ** -np.arange(1.0, 60)])
"""Times a length that are tried."""

INSIDE = 0.02
"""Share of a length by which a remedy stays away from the length that just closes."""

HALVINGS = 12


@dataclass(frozen=True)
class OpenDyad:
    """A dyad that closes nowhere.

    Parameters
    ----------
    group
        The dyad.
    at
        The input at which it comes nearest to closing, rad or mm.
    missing
        mm by which its bars are too short, or below 0 by which they differ too much; NaN of a dyad with a
        slide.
    """

    group: Dyad
    at: float
    missing: float


def closure_finding(table: LinkageTable) -> Finding:
    """The error for links that cannot be put together at any position of the input."""
    found, unit = open_dyad(table), "mm" if table.driver_slides else "degrees"
    lengths: tuple[tuple[str, float], ...] = ()
    if found is None:
        said = "the links cannot be put together at any position of the input"
    else:
        one, two = found.group.links
        where = found.at if table.driver_slides else math.degrees(found.at) % 360
        said = (
            f"{one} and {two} cannot be put together at {found.group.inner.name}; they come nearest with the "
            f"driver at {where:.4g} {unit}"
        )
        if found.missing == found.missing:
            what = "too short together" if found.missing > 0 else "too far from each other in length"
            said += f", where they are {abs(found.missing):.4g} mm {what}"
        lengths = tuple(closing_lengths(table))
    changes = tuple({f"parameters.{table.key}.{name}": value} for name, value in lengths)
    remedy = " or ".join(f"{table.key}.{name} = {value:g}" for name, value in lengths[:2])
    return Finding.error(
        "linkage.closure",
        f"{table.key}.{lengths[0][0]}" if lengths else table.key,
        said,
        remedy=f"set {remedy}" if lengths else "make a link longer, or put its ends nearer to each other",
        stage=Stage.MOTION,
        proposed=changes,
    )


def open_dyad(table: AnyPlanarTable) -> OpenDyad | None:
    """The first dyad of one linkage that closes at no input; None where there is none."""
    at = table.drawn_at + np.linspace(0.0, math.tau, SAMPLES)
    bodies = table.solved_at(at, 1).bodies
    for group in table.order:
        if not isinstance(group, Dyad):
            continue
        with np.errstate(invalid="ignore"):
            quantities = closing_quantities(table.machine, group, bodies)
            values = np.min([one.value + 0 * at for one in quantities], axis=0)
        if not np.isfinite(values).any():
            return None  # what it stands on has no place
        place = int(np.nanargmax(values))
        if values[place] < 0:
            return OpenDyad(group, float(at[place]), _missing(group, bodies, place))
    return None


def _missing(group: Dyad, bodies: Mapping[str, BodyMotion], place: int) -> float:
    (first, last), (one, two), inner = group.outer, group.links, group.inner
    if not (isinstance(first, Revolute) and isinstance(last, Revolute) and isinstance(inner, Revolute)):
        return math.nan
    ends = [outer_pin(joint, link, bodies, 0) for joint, link in ((first, one), (last, two))]
    apart = abs(complex(np.broadcast_to(ends[1].position - ends[0].position, SAMPLES)[place]))
    a, b = (abs(inner.place(link) - joint.place(link)) for joint, link in ((first, one), (last, two)))
    return float(apart - a - b if apart > a + b else apart - abs(a - b))


def closing_lengths(table: LinkageTable) -> Iterator[tuple[str, float]]:
    """Dimensions of a linkage of the catalogue, each with its nearest value with which the links close.

    The smallest change is first.
    """
    if table.given.linkage == "drawn":
        return
    entry, found = table.given.entry, []
    for name in type(entry).model_fields:
        if _is_length(entry, name):
            value = float(getattr(entry, name))
            if (near := _nearest(table, name, value)) is not None:
                found.append((abs(math.log(near / value)), name, near))
    for _, name, near in sorted(found):
        yield name, near


def _is_length(entry: Entry, name: str) -> bool:
    metadata = type(entry).model_fields[name].metadata
    is_mm = any(isinstance(one, Unit) and one.symbol == "mm" for one in metadata)
    return is_mm and isinstance(getattr(entry, name), float) and getattr(entry, name) > 0


def _nearest(table: LinkageTable, name: str, value: float) -> float | None:
    """The nearest value of a length with which the links close at some input; rounded to three digits."""
    closes = FACTORS[_closes(table, name, value * FACTORS)]
    if not closes.size:
        return None
    good = float(closes[np.abs(np.log(closes)).argmin()])
    bad = good / 1.02 if good > 1 else good * 1.02
    for _ in range(HALVINGS):
        middle = (good + bad) / 2
        if _closes(table, name, np.array([value * middle]))[0]:
            good = middle
        else:
            bad = middle
    further = good * (1 + INSIDE if good > 1 else 1 - INSIDE)
    rounded = float(f"{value * further:.3g}")
    return rounded if _closes(table, name, np.array([rounded]))[0] else None


def _closes(table: LinkageTable, name: str, values: Array) -> Array:
    """Which values (n,) of a length close at some input."""
    given = with_columns(table.given, {f"{table.key}.{name}": values[:, None]})
    at = table.drawn_at + np.linspace(0.0, math.tau, SAMPLES)
    closes = LinkageTable(given, values.size).solved_at(np.atleast_2d(at), 0).closes
    return np.asarray(np.broadcast_to(closes, (values.size, SAMPLES)).any(axis=-1))
