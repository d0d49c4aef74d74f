"""What to type into D, and how to bring a part to size with it."""

from collections.abc import Sequence

from mechwright_cam.controls.offsets import DOffset, OffsetTables
from mechwright_cam.shop.lengths import MILLIMETRES, Lengths

OVERSIZE = 0.5
"""Share of the wear allowed by which D is made larger for a careful first cut: the part stays too large."""


def value(offset: DOffset, to: Lengths = MILLIMETRES) -> str:
    """What a D offset holds at first.

    >>> from mechwright_cam.shop.tool import Tool
    >>> tool = Tool(name="mill-6", number=3, kind="end-mill", diameter=6, flute_length=12)
    >>> value(DOffset(3, tool, "radius", 3.0, 0.1)), value(DOffset(3, tool, "diameter", 0.0, 0.2))
    ('3.000, the radius', '0.000, the wear on the diameter')
    """
    what = "wear on the " if offset.planned == 0 else ""
    worn = f", {to.signed(offset.wear, 3)} in wear" if offset.wear else ""
    return f"{to.fixed(offset.planned, 3)}, the {what}{offset.quantity}{worn}"


def lines(offsets: Sequence[DOffset], tables: OffsetTables, to: Lengths = MILLIMETRES) -> tuple[str, ...]:
    """How D is set, and how a part is brought to size."""
    about = []
    if tables.d == "setting":
        where = f" ({tables.d_setting})" if tables.d_setting else ""
        about.append(f"The control has to take D as a {offsets[0].quantity}{where}.")
    if tables.wear:
        about.append(
            "Geometry and wear are added up: enter the planned value as geometry, with wear 0, and correct "
            "sizes in wear."
        )
    said = [" ".join(about)] if about else []
    for offset in offsets:
        low, high = offset.planned - offset.limit, offset.planned + offset.limit
        measured = f"{to.with_unit(offset.tool.diameter)} in diameter as planned"
        if offset.planned == 0:
            less = to.plain(0.02 if offset.quantity == "diameter" else 0.01)
            thinner = f"a cutter {to.with_unit(0.02)} smaller in diameter has −{less}"
            how = f"0 if T{offset.tool.number} is {measured}; {thinner}"
        else:
            how = f"the {offset.quantity} of T{offset.tool.number} as measured ({measured})"
        said.append(
            f"D{offset.number}: enter {how}. From {_plain(low, to)} to {_plain(high, to)} is proven; "
            "beyond that the "
            "control may stop in a corner."
        )
    first = offsets[0]
    more = OVERSIZE * first.limit
    share = "half of that" if first.quantity == "radius" else "just that"
    said += [
        f"For a first cut that leaves some to come off, make D larger by {to.plain(more)}.",
        "Measure. If an outside is too large by some amount, or an opening or bore too small, make D smaller "
        f"by {share}, and run the finishing once more.",
        "A D that is too small cuts the part too small, which nothing brings back.",
    ]
    return tuple(said)


def _plain(value: float, to: Lengths) -> str:
    return to.fixed(value, 3).replace("-", "−")
