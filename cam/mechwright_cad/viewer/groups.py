"""Which bodies a page shows together: those that move as one, and fasteners apart from them."""

import re
from collections.abc import Sequence

from mechwright.contracts.bodies import rigid
from mechwright.contracts.joint import GROUND
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part
from mechwright.standards import keys, shims
from mechwright_cad.bodies import Body

FASTENERS = "fasteners"
"""The group of screws, nuts, washers, pins, keys and rings."""

FRAME = "frame"
"""The group of what stands."""

_STANDARDS = re.compile(
    "|".join(
        [
            re.escape(keys.STANDARD),
            re.escape(shims.STANDARD),
            r"ISO (?:4762|10642|402[6-9]|4032|7089|7090|2338|8734|8752|13337|234[01]|401[47]|7045|7380)\b",
            r"DIN (?:471|472|6799|976|6325|7991|125|933|91[2-6])\b",
            r"ASME B18\.",
        ]
    )
)
"""Of fasteners, as the standard of a part begins."""

_NAMES = re.compile(r"^(?:screw|nut|washer|pin|stud|circlip|shim|key|dowel|set-screw|ring)-")
"""Of fasteners without a standard, as the name of a bought part begins."""


def is_fastener(part: Part) -> bool:
    """Whether a part holds others: a bought screw, nut, washer, pin, stud, key, or ring."""
    if part.bought is None:
        return False
    return bool(_STANDARDS.match(part.bought.standard) or _NAMES.match(part.name))


def groups_of(bodies: Sequence[Body], motion: Motion) -> list[str]:
    """The group of each body, named by the first plate or made solid of those that move as one."""
    head = rigid(motion)
    name: dict[str, str] = {}
    links = [one for one in bodies if one.part.kind in {"plate", "solid"}]
    for body in (*links, *bodies):
        name.setdefault(head[body.instance.body], body.instance.body)
    name[GROUND] = FRAME
    return [FASTENERS if is_fastener(one.part) else name[head[one.instance.body]] for one in bodies]
