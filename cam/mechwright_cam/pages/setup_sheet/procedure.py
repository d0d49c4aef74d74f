"""The work of setting up, in numbered steps with the numbers of one job.

The work offset's Z is measured once with a Z setter; every tool's length offset then brings its own tip to
the surface, so one Z serves however many tools. With the machine's Z read where the spindle nose presses the
setter (N) and where a tool's tip does (Zn), a setter of height h gives

    work offset Z = N - h,        length offset Hn = Zn - N.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from mechwright.contracts.part import Bore
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.offsets import DOffset
from mechwright_cam.pages.setup_sheet.beds import bed_and_clamp_lines
from mechwright_cam.pages.setup_sheet.compensation import lines
from mechwright_cam.pages.setup_sheet.ends import about_ends
from mechwright_cam.pages.setup_sheet.holding import edge_line, holding_lines
from mechwright_cam.pages.setup_sheet.probing import about_measuring, about_probing
from mechwright_cam.pages.setup_sheet.several import (
    about_others,
    active_words,
    in_order,
    quantity,
    quantity_text,
)
from mechwright_cam.pages.setup_sheet.tapping import about_taps
from mechwright_cam.pages.setup_sheet.zero import plane, second_plane
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import Lengths
from mechwright_plane.nest import Nest

TO_SIZE = "Set D, and bring the part to size"
BEFORE = "Look at the machine and its control"
CHECK_HEIGHT = 50.0
"""Height over the stock at which a tool's length is checked by eye before the first cut, mm."""


@dataclass(frozen=True)
class Step:
    """A heading and what to do."""

    title: str
    lines: tuple[str, ...]


def steps(
    job: Job,
    control: Control,
    tools: Sequence[int],
    *,
    file_names: Sequence[str],
    deepest: float,
    reach: tuple[float, float, float, float] | None = None,
    offsets: Sequence[DOffset] = (),
    by_file: bool = False,
    probing: str = "",
    measuring: Sequence[str] = (),
    by_hand: Sequence[str] = (),
) -> list[Step]:
    """The steps in order.

    Parameters
    ----------
    tools
        T numbers in the order of use.
    file_names
        The program's file, or several in order.
    deepest
        Lowest z that any tool reaches, mm.
    reach
        Least x, least y, greatest x, greatest y that any cutter reaches below the rapids, mm.
    offsets
        The D offsets of cutter compensation.
    by_file
        Whether tools that are changed by hand have a file each.
    probing
        The file of the program that probes the zero, if there is one.
    measuring
        The files of those that measure tools.
    by_hand
        What is done at the machine before the start.
    """
    offset, to = control.offset_words(job.settings.work_offset), Lengths(control.units)
    over = job.side == "underside"
    no_table = not control.offsets.lengths
    touched = no_table and not _in_program(job, control, tools)
    used = [tool for tool in job.tools if tool.number in tools]
    needs = (*control.needs(job.settings), *by_hand)
    if control.leftover:
        needs += (f"The program does not take back {control.leftover}.",)
    needs += about_ends(job, tools, reach, to)
    return [
        *([Step(BEFORE, needs)] if needs else []),
        _with_reach(_turn(job, to) if over else _stock(job, deepest, to), None if job.jaws else reach, to),
        Step(f"Set {offset} X and Y", (second_plane if over else plane)(job, offset, to)),
        *([Step("Or probe it", about_probing(job, offset, probing, to))] if probing else []),
        *([] if touched else [_height(job.settings.work_offset, control)]),
        *(
            [Step("The other plates", about_others(job, control, reach, to, touched=touched))]
            if job.settings.more_offsets
            else []
        ),
        *(
            [_touch_off(job, control, tools, by_file=by_file)]
            if no_table
            else [_lengths(offset, tools, control, with_d=bool(offsets)), _check(offset, tools, control)]
        ),
        *([Step("Or measure", about_measuring(job, control, measuring, to))] if measuring else []),
        *(
            [Step("Set D, and bring the part to size", lines(offsets, control.offsets, to))]
            if offsets
            else []
        ),
        *([Step("Tapping", taps)] if (taps := about_taps(used, control)) else []),
        _run(job, control, file_names, to, touched=touched),
    ]


def _stock(job: Job, deepest: float, to: Lengths) -> Step:
    x0, y0, x1, y1 = job.stock
    if job.jaws:
        return _vice(job, deepest, to)
    lines = [
        f"Plate of {job.part.material}, {to.fixed(x1 - x0, 1)} × {to.fixed(y1 - y0, 1)} × "
        f"{to.with_unit(job.thickness)} (X × Y × Z), "
        f"edges parallel to X and Y. Indicate the rear edge to {to.with_unit(0.02)}.",
    ]
    if deepest < -job.thickness:
        lines.append(
            f"Put a spoil board under it: cutters go down to Z {to.signed(deepest)}, "
            f"{to.fixed(-deepest - job.thickness)} {to.unit} below the plate."
        )
    if job.settings.hold.method == "none":
        lines += bed_and_clamp_lines(job, to)
    lines += holding_lines(job, to)
    if job.tabs:
        lines.append(
            "Keep all that holds it outside the picture's coloured band, and below "
            f"Z {to.signed(job.settings.clearance, 1)} where rapids cross."
        )
    elif job.clamp is not None:
        lines.append("Clamp the plate for the openings first; the bore clamp comes when the program stops.")
    return Step("Clamp the stock", tuple(lines))


def _vice(job: Job, deepest: float, to: Lengths) -> Step:
    x0, y0, x1, y1 = job.stock
    edges = " and ".join(jaw.edge for jaw in job.jaws)
    along = job.jaws[0].face
    low, high, axis = along.bounds[0], along.bounds[2], "X"
    if low == high:
        low, high, axis = along.bounds[1], along.bounds[3], "Y"
    finished = ", ".join(job.settings.stock.finished)
    lines = [
        f"Bar of {job.part.material}, {to.fixed(x1 - x0, 1)} × {to.fixed(y1 - y0, 1)} × "
        f"{to.with_unit(job.thickness)} (X × Y × Z). "
        f"Edges that stay as they are: {finished}. Measure them: they are edges of the finished part.",
        f"Vice on the {edges} edges. The jaws may reach from {axis} {to.signed(low, 1)} to "
        f"{to.signed(high, 1)} "
        f"and no further: cutters pass beside them. Their tops are at Z {to.signed(job.jaws[0].top)}, "
        f"{to.with_unit(job.thickness + job.jaws[0].top)} above the underside.",
    ]
    if deepest < -job.thickness:
        lines.append(
            f"Keep parallels away from holes and ends: cutters go down to Z {to.signed(deepest)}, "
            f"{to.fixed(-deepest - job.thickness)} {to.unit} below the bar."
        )
    lines += holding_lines(job, to)
    return Step("Clamp the bar in a vice", tuple(lines))


def _with_reach(step: Step, reach: tuple[float, float, float, float] | None, to: Lengths) -> Step:
    if reach is None:
        return step
    x0, y0, x1, y1 = (to.signed(value, 1) for value in reach)
    line = f"Cutters run from X {x0} to {x1} and Y {y0} to {y1}: no clamp in there."
    return Step(step.title, (*step.lines, line))


def _in_program(job: Job, control: Control, tools: Sequence[int]) -> bool:
    """Whether the lengths of all tools stand in the program."""
    return bool(control.offsets.length_word) and set(tools) <= {
        tool.number for tool in job.tools if tool.length is not None
    }


def _touch_off(job: Job, control: Control, tools: Sequence[int], *, by_file: bool) -> Step:
    listed = ", ".join(f"T{tool}" for tool in tools)
    if _in_program(job, control, tools):
        word = control.offsets.length_word
        lines = [
            f"The lengths of {listed} are in the program ({word}), as measured against the spindle nose.",
            f"Check each by hand before the first cut: {word} with its length, then the tip over the stock.",
        ]
    else:
        offset = " and ".join(map(control.offset_words, job.settings.offsets))
        when = "Before each file" if by_file else "At each stop"
        lines = [
            f"The control keeps no lengths: {listed} are touched off one by one. {when} load the tool, bring "
            f"its tip on the stock with the setter (height h), and set {offset} Z so that "
            "Z reads h" + (", for each on its own plate." if job.settings.more_offsets else "."),
            "Where the stock's top is gone by then, touch off beside it and add the difference of height.",
        ]
        if not job.settings.machine.homed:
            set_z = control.setting_words(job.settings.work_offset).replace("G10 L2 ", "G10 L20 ")
            lines.append(
                "Without a setter, lower the tool by 0.1 mm at a time until a sheet of paper below it just "
                f"drags, and type {set_z} Z0.1, the thickness of the paper."
            )
        if not by_file:
            lines.append(
                "At a stop the control by itself can neither jog nor probe: the sender has to hold the stop "
                "(M0) instead of sending it. If yours does not, ask for one file per tool."
            )
    if by_file:
        lines.append("There is a file for each change of tool: run them in order.")
    return Step("Tools by hand", tuple(lines))


def _turn(job: Job, to: Lengths) -> Step:
    side = job.settings.second_side
    if side.flip == "x":
        edges = "front edge goes to the rear, left stays left"
        straight = "what was the rear edge, now in front,"
    else:
        edges = "left edge goes to the right, the rear one stays at the rear"
        straight = "the rear edge"
    lines = [
        f"Turn the plate over about the {side.flip.upper()} axis: its {edges}. The tabs are on top "
        "now; leave the frame on.",
        "Support the part from below: it hangs by the tabs only. Clamp the frame.",
        *holding_lines(job, to),
    ]
    if side.locate == "dowels":
        lines.append(
            f"Put it on two dowels of {to.size(side.dowel_diameter)} {to.unit}, which stand in the table "
            "where the first "
            "side's holes were: deepen these before the plate is taken off."
        )
    else:  # that edge lay along X on the first side, another one need not be parallel to it
        lines.append(f"Indicate {straight} to {to.with_unit(0.02)}.")
    return Step("Turn the plate over", tuple(lines))


def _height(place: str, control: Control) -> Step:
    offset = control.offset_words(place)
    return Step(
        f"Set {offset} Z once, with the Z setter",
        (
            f"No length offset active: {control.no_length}. Stand the setter (height h) on the clean top of "
            "the stock.",
            "Bring the bare spindle nose down on it until it shows zero. Read the machine's Z: this is N.",
            f"Enter {offset} Z = N − h on the offset page, or {control.height_words(place, 'N − h')}. "
            "Z0 is now the top of the stock. Do not touch it again, however many tools follow.",
            "If the nose cannot reach, use the longest tool in its place for N: its H is 0, the others have "
            "negative H. Use the same one for all programs of the job, since they share the lengths.",
        ),
    )


def _lengths(offset: str, tools: Sequence[int], control: Control, *, with_d: bool) -> Step:
    listed = ", ".join(f"T{tool}" for tool in tools)
    return Step(
        "Measure each tool's length offset",
        (
            f"For each of {listed}: load it, bring its tip down on the setter on the stock until it shows "
            "zero, and read the machine's Z: this is Zn (Z1 for T1, and so on).",
            f"Enter {control.length_place('n')} = Zn − N as the length (Z) of that tool in the tool table"
            + (". What goes into D comes below." if with_d else "."),
            "A tool that has its H from another program of the job keeps it.",
            f"The program calls {control.length_words('n')} after every tool change; that brings each tip to "
            f"the surface that {offset} Z names.",
        ),
    )


def _check(offset: str, tools: Sequence[int], control: Control) -> Step:
    first, to = tools[0] if tools else 1, Lengths(control.units)
    height = CHECK_HEIGHT if to.units == "mm" else round(CHECK_HEIGHT / to.scale) * to.scale
    words = dict.fromkeys((control.change_words(first), offset, control.length_words(first)))
    return Step(
        "Check before the first cut",
        (
            f"Beside the clamps, by hand: {', '.join(words)}, then {control.rapid_words(to.plain(height))}. "
            f"The tip must stand {to.with_unit(height)} above the stock: measure it. Repeat for every tool.",
            "If it does not: stop. Length offset or work offset is wrong.",
        ),
    )


def _run(job: Job, control: Control, file_names: Sequence[str], to: Lengths, *, touched: bool) -> Step:
    offset = control.offset_words(job.settings.work_offset)
    lines = [
        f"Load {in_order(file_names)}. Single block and low feed override until the first cut looks right. "
        f"{active_words(job, control)}",
    ]
    if job.settings.post.stage_tools:
        lines.append("Behind each tool change a T alone makes the next tool ready; the last one the first.")
    if quantity(job) > 1:
        again = (
            "touch off every tool again."
            if touched
            else f"set {offset} Z again if its top is not as high as the last one. The length offsets stay."
        )
        if job.side == "underside" and job.settings.second_side.locate != "dowels":
            # Stops touch other edges now, and how far those are from the part is the saw's affair.
            same = f"Pick up {offset} X and Y on every further plate"
        else:
            stops = "on the same dowels" if job.side == "underside" else "against the same stops"
            same = f"A further plate {stops} keeps {offset} X and Y"
        lines.append(f"Make {quantity_text(job)}. {same}; {again}")
    fits = [f"{f.name} ⌀{f.fit.text}" for f in job.features if isinstance(f, Bore) and f.fit]
    if fits:
        lines.append(f"Gauge before the part comes off: {', '.join(fits)}. Ream a hole that is too small.")
    deep = [f for f in job.features if isinstance(f, Bore) and f.depth_limits is not None]
    if deep:
        depths = ", ".join(f"{f.name} {f.depth_text} mm" for f in deep)
        lines.append(f"Measure these depths before the part comes off: {depths}.")
    if job.tabs:
        width, height = job.tabs[0].width, job.thickness + job.tabs[0].top
        sides, what = "", "parts" if isinstance(job.part, Nest) else "part"
        if job.tabs[0].ramped:
            foot = width + 2 * height / job.tabs[0].slope
            sides = f", on slopes that reach {to.fixed(foot, 1)} {to.unit} along the wall at the underside,"
        lines.append(
            f"{len(job.tabs)} tabs of {to.plain(width)} × {to.with_unit(height)}{sides} hold the {what} "
            "to the end. Saw them through, and file them flush."
        )
    lines.append(edge_line(job, to))
    if job.clamp is not None:
        lines.append(
            f"At the programmed stop fit the bore clamp, at most ⌀{to.plain(job.clamp.diameter)} and "
            f"{to.with_unit(job.clamp.top)} high, before going on. Only then is the outside cut."
        )
    return Step("Run", tuple(lines))
