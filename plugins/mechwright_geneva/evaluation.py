"""Many Geneva mechanisms at once: by formulas where they tell, left to themselves where they do not."""

from collections.abc import Collection
from typing import cast

import numpy as np

from mechwright import Stage
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.contracts.masses import is_mass
from mechwright.mechanics.laws import LAWS
from mechwright_geneva.many_checks import judge
from mechwright_geneva.many_columns import columns_of
from mechwright_geneva.many_masses import masses_of
from mechwright_geneva.many_sizes import CONTINUOUS, completed
from mechwright_geneva.params import GenevaParams


def answer(designs: Designs, columns: Collection[str], stage: Stage) -> Answer:
    """What forbids designs, and their figures; see :mod:`mechwright.contracts.by_arrays`."""
    said = Answer(len(designs))
    for column in columns:
        said.give(column, np.full(len(designs), np.nan))
    for places, common in _alike(designs):
        _answered(designs.some(places), common, columns, stage, said, places)
    return said


def _answered(
    designs: Designs,
    common: GenevaParams,
    columns: Collection[str],
    stage: Stage,
    said: Answer,
    places: "np.ndarray[tuple[int], np.dtype[np.intp]]",
) -> None:
    """Answer designs that differ in lengths, angles and loads."""
    m = completed(common, designs) if _formulas_tell(common) else None
    if m is None:
        said.doubt(np.ones(places.size, bool), places)
        return
    own = Answer(places.size)
    judged, left = judge(m, own, stage)
    moving = [name for name in columns if not is_mass(name)]
    if stage is not Stage.MOTION and len(moving) < len(columns) and left.size:
        for name, values in masses_of(judged, columns).items():
            said.give(name, values, places[left])
    free = own.left
    if moving and free.size:
        found = columns_of(m.rows(free), moving)
        own.doubt(np.full(free.size, found is None), free)
        for name, values in (found or {}).items():
            said.give(name, values, places[free])
    for number, code in enumerate(own.codes):
        if number:
            said.forbid(code, own.forbidden == number, places)
    said.doubt(own.undecided, places)


def _formulas_tell(common: GenevaParams) -> bool:
    """Whether all checks of such designs are formulas; others seek, fit or follow a driver that varies."""
    return (
        (common.law == "straight" or common.law in LAWS)
        and common.driver_law == "constant"
        and common.slots_made != "backed"
        and not common.counterbore_diameter
    )


def _alike(designs: Designs) -> "list[tuple[np.ndarray[tuple[int], np.dtype[np.intp]], GenevaParams]]":
    """Places of designs that differ in lengths, angles and loads only, and what they have in common."""
    names = [name for name in designs.varied if name not in CONTINUOUS]
    kind = np.zeros(len(designs), dtype=np.int64)
    for name in names:
        _, of = np.unique(designs.varied[name], return_inverse=True)
        kind = kind * (int(of.max()) + 1) + of
    found = []
    for one in np.unique(kind):
        places = np.flatnonzero(kind == one)
        update = {name: designs.varied[name][places[0]].item() for name in names}
        found.append((places, cast(GenevaParams, designs.common.model_copy(update=update))))
    return found
