"""The rules of a spherical linkage, in the order in which they are asked."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from mechwright import Finding, Procedure, Stage, all_of, in_turn
from mechwright.contracts.design_rule import RuleLike
from mechwright.contracts.rule_list import OneByOne, Rules
from mechwright_spherical.defaults.preferred_sizes import CURED, NAMES, USUAL, left_out
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.frame import AIR
from mechwright_spherical.rules.assembly import ASSEMBLY, FIGURES, PATH, PINS
from mechwright_spherical.rules.links import LINKS
from mechwright_spherical.rules.mount import MOUNT
from mechwright_spherical.rules.setting import SETTING, SLOTS
from mechwright_spherical.rules.stand import DRIVE, NO_STRIPS, STAND, STRIPS
from mechwright_spherical.table import SphericalTable


def _needs_frame(t: SphericalTable) -> Any:
    """Whether the ground may be on both sides: it has a motor, or no room outside with the default sizes."""
    own = t.given
    if own.stand.motor_flange is not None or own.hardware.frame == "two":
        return True
    return (own.hardware.frame == "auto") & ~(t.air(own) >= AIR)


def _sizes(m: SphericalTable) -> Iterator[Finding]:
    """A note of the sizes that were left out and are other than usual."""
    own, out = m.params.hardware, left_out(m.params.hardware)
    other = [name for name in NAMES if name in out and getattr(own, name) != getattr(USUAL, name)]
    if other:
        said = ", ".join(f"hardware.{name} = {getattr(own, name):g}" for name in other)
        said = f"defaults chosen so that links and pins have room: {said}"
        yield Finding.note("spherical.sizes", said)


ROOM: tuple[RuleLike[SphericalTable], ...] = (*LINKS, SLOTS, DRIVE, *STAND, MOUNT, STRIPS, NO_STRIPS)
"""Whether links, pins, drive, stand and strips have room."""

ALL_ROOM = all_of(*ROOM)
LASTING = all_of(*(one for one in ROOM if one.codes[0] not in CURED))
CURABLE = all_of(*(one for one in ROOM if one.codes[0] in CURED))
"""What other sizes of pins, bosses and links do not cure, and what they may."""

JOINED = in_turn(PINS, ASSEMBLY)
"""Whether the linkage is one, and stays assembled over its travel."""

RULES: Rules[SphericalTable] = in_turn(
    OneByOne(lambda t: not t.is_free),
    PINS,
    SETTING,
    ASSEMBLY,
    PATH,
    all_of(
        OneByOne(_needs_frame, Stage.PARTS),
        *ROOM,
        Procedure[SphericalTable](("spherical.sizes",), _sizes, warns=True),
    ),
    FIGURES,
)


def findings_of(params: SphericalParams) -> Sequence[Finding]:
    """Everything that is to be said about a design."""
    m = SphericalTable.of(params)
    with np.errstate(all="ignore"):
        return m.once("findings", lambda: RULES.findings(m))
