"""Which tools a shop would have to buy, where those in its crib do not make a part."""

from collections.abc import Sequence
from itertools import count

from mechwright.contracts.finding import Finding, errors
from mechwright.contracts.part import Part
from mechwright.errors import DesignError, ToolError
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.planning.setups import lay_out_setups
from mechwright_cam.planning.uses import uses
from mechwright_cam.shop.library import Library, built_in
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import CuttingTable, Tool, ToolKind
from mechwright_cam.shop.workshop_file import Shop


def to_buy(
    part: Part, cam: CamSettings, library: Library, assignments: Assignments, shop: Shop
) -> Finding | None:
    """What a crib lacks for a part: data of tools that are in it, else tools; None if nothing helps."""
    if known := _without_data(part, cam, library, assignments):
        names = ", ".join(tool.name for tool in known)
        message = f"{part.name} can be cut with what is there once {names} has data for {part.material}"
        remedy = f"give cutting_speed and chip_load of each in [cam.cutting.NAME], or in {shop.path.name}"
        return Finding.warning("shop.data", "shop", message, remedy=remedy)
    wanted = lacking(part, cam, library, assignments)
    if not wanted:
        return None
    told = ", ".join(_described(tool) for tool in wanted)
    message = f"{part.name} can be cut with what {shop.path.name} has and {told} besides"
    return Finding.warning("shop.buy", "shop", message, remedy=f"buy {_it(wanted)}")


def _without_data(part: Part, cam: CamSettings, library: Library, assignments: Assignments) -> list[Tool]:
    """The tools of a crib with which a part can be cut once they have data for its material.

    What a built-in tool of the kind and of about the size does stands for their data while this is tried.
    """
    supposed = []
    for tool in library:
        alike = [one for one in built_in() if one.kind is tool.kind and part.material in one.cutting]
        if part.material not in tool.cutting and alike:
            data = min(alike, key=lambda one: abs(one.diameter - tool.diameter)).cutting[part.material]
            cutting = CuttingTable({**tool.cutting, part.material: data})
            supposed.append(tool.model_copy(update={"cutting": cutting}))
    return _used(part, cam, library, supposed, assignments) or [] if supposed else []


def lacking(part: Part, cam: CamSettings, library: Library, assignments: Assignments) -> list[Tool]:
    """The built-in tools that are to be added to those of a crib so that a part can be cut.

    Each has been tried: with all of them the part is laid out without an error, and without one of them it is
    not. Empty where the design names its tools, or no tool helps.
    """
    wanted = [] if cam.tools else _used(part, cam, library, _others(library), assignments) or []
    for tool in list(wanted):
        fewer = [one for one in wanted if one is not tool]
        if fewer and _used(part, cam, library, fewer, assignments) is not None:
            wanted = fewer
    return wanted


def _it(tools: Sequence[Tool]) -> str:
    return "it" if len(tools) == 1 else "them"


def _others(library: Library) -> list[Tool]:
    """The built-in tools under numbers and names that the shop does not have."""
    numbers = {tool.number for tool in library} | {tool.d_number for tool in library}
    names = {tool.name for tool in library}
    free = (number for number in count(1) if number not in numbers)
    found = []
    for tool in built_in():
        name = tool.name if tool.name not in names else f"new-{tool.name}"
        found.append(tool.model_copy(update={"number": next(free), "name": name}))
    return found


def _used(
    part: Part, cam: CamSettings, library: Library, more: Sequence[Tool], assignments: Assignments
) -> list[Tool] | None:
    """Those of some more tools that the part takes; None if it cannot be cut with them either."""
    tried = Assignments(assignments.more, assignments.control)
    try:
        laid, found = lay_out_setups(part, cam, library.extended(tuple(more)), tried)
        if errors(found) or not laid:
            return None
        taken = {use.tool.name for job in laid for use in uses(job, tried.of(job))}
    except (DesignError, ToolError):
        return None
    return [tool for tool in more if tool.name in taken]


def _described(tool: Tool) -> str:
    """A tool as one orders it."""
    kind = str(tool.kind).replace("-", " ")
    point = f", {tool.point_angle:g}°" if tool.kind in {ToolKind.DRILL, ToolKind.SPOT_DRILL} else ""
    return f"a {kind} ⌀{tool.diameter:g} mm{point} with {tool.flute_length:g} mm of flutes"
