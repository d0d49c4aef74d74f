"""Running a stretch of motion lines at once: what a machine does line by line, worked out for all of them."""

import math
from bisect import bisect_left

import numpy as np

from mechwright.arrays import Array
from mechwright_cam.controls.reading.arcs import centres_of
from mechwright_cam.controls.reading.modes import Modal
from mechwright_cam.controls.reading.plain import Bools, F, G, I, J, R, Rows, S, X, Y, Z
from mechwright_cam.controls.reading.run import WIDTH, Ints, Kind, Remark

FEWEST_LINES = 8
"""A stretch of fewer lines is not worth it: so many run as quickly one by one."""

ABSOLUTE = {900: True, 910: False}
"""G90 and G91: whether X, Y and Z are places."""


def run_motion_lines(machine: Modal, lines: Rows, at: int) -> int:
    """Run the motion lines that begin at index ``at``, if they are many.

    Returns
    -------
    after
        Index of the first line that is still to be run. A line that would be an error is left to whoever
        explains errors.
    """
    motion = machine.motion
    known = motion in {0, 10, 20, 30}
    if not (known or lines.has_word[G, at]) or not machine.moves_plainly:
        return at
    end, modes = _as_stated(machine, lines, at, lines.until(at, known and motion in {20, 30}))
    if end - at < FEWEST_LINES:
        return at
    absolute = _absolute(machine, modes, at, end)
    index = at + np.flatnonzero(lines.has_word[G : F + 1, at:end].any(axis=0))  # without empty lines
    if index.size == 0:
        _along(machine, lines, at, end, index)
        machine.absolute = bool(absolute[-1])
        return end
    words = lines.words[:, index]
    words[X : F + 1] *= machine.scale
    _hold(words[G], (motion or 0) / 10)
    _hold(words[F], machine.feed)
    here = machine.x, machine.y, machine.z
    lost = _places(words, here, absolute[index - at])
    g, feed, place = words[G], words[F], words[X : Z + 1].T
    start = np.concatenate(([here], place[:-1]))
    arc = g >= 2
    table = np.zeros((index.size, WIDTH))
    table[:, 0] = np.where(arc, Kind.ARC, np.where(g == 1, Kind.FEED, Kind.RAPID))
    table[:, 1] = lines.number[index]
    table[:, 2:5], table[:, 5:8] = start, place
    table[:, 8:10] = math.nan
    table[:, 12] = np.where(g > 0, feed, 0.0)
    wrong = lost | ((g > 0) & ~(feed > 0))
    if arc.any():
        wrong[arc] |= _arcs(machine, table, words, arc)
        if machine.dialect.words.known["G2"].ends_in_plane:
            wrong |= arc & ~lines.has_word[X : Y + 1, index].any(axis=0)
    faults = np.flatnonzero(wrong)
    count = int(faults[0]) if faults.size else index.size
    after = int(index[count]) if faults.size else end
    state = _along(machine, lines, at, after, index)
    if count:
        table = table[:count]
        table[:, 14] = state[index[:count] - at]
        machine.append(table)
        machine.motion, machine.feed = 10 * int(g[count - 1]), float(feed[count - 1])
    if after > at:
        machine.absolute = bool(absolute[after - at - 1])
    return after


def _as_stated(machine: Modal, lines: Rows, at: int, end: int) -> tuple[int, list[tuple[int, bool]]]:
    """The first line from ``at`` on whose words of state change anything but G90 and G91, at most ``end``.

    So does an S that makes the spindle turn. With it come the lines with G90 or G91, and whether that is G90.
    """
    asked: dict[int, bool] = {}
    modes: list[tuple[int, bool]] = []
    place = bisect_left(lines.stated, (at, 0))
    while place < len(lines.stated) and lines.stated[place][0] < end:
        line, kind = lines.stated[place]
        if kind not in asked:
            asked[kind] = machine.is_stated(lines.states[kind])
        if not asked[kind]:
            end = line
            break
        for code in ABSOLUTE.keys() & lines.states[kind].g:
            modes.append((line, ABSOLUTE[code]))
        place += 1
    if machine.state.spindle and not machine.state.spindle_rotation:
        end = at + next(iter(np.flatnonzero(lines.has_word[S, at:end]).tolist()), end - at)
    return end, modes


def _absolute(machine: Modal, modes: list[tuple[int, bool]], at: int, end: int) -> Bools:
    """Whether each line from ``at`` to ``end`` says places (G90), and no distances."""
    some = [(line, absolute) for line, absolute in modes if line < end]
    lines, flags = zip((at, machine.absolute), *some, strict=True)
    return np.repeat(flags, np.diff([*lines, end]))


def _along(machine: Modal, lines: Rows, at: int, after: int, moving: Ints) -> Ints:
    """Record the comments of the lines up to ``after``, and give the state of each line; it holds then.

    ``moving`` are the lines that make a step.
    """
    first, last = (bisect_left(lines.comments, (line,)) for line in (at, after))
    for line, comment in lines.comments[first:last]:
        step = machine.steps + int(np.searchsorted(moving, line))
        machine.remarks.append(Remark(int(lines.number[line]), comment, step))
    rpm = lines.words[S, at:after].copy()
    if np.isnan(rpm).all():
        if moving.size:
            machine.keep_state()
        return np.full(after - at, machine.index)
    _hold(rpm, machine.state.rpm)
    return machine.at_speeds(rpm)


def _hold(row: Array, before: float) -> None:
    """Where there is no word the one before holds."""
    last = np.maximum.accumulate(np.where(np.isnan(row), -1, np.arange(row.size)))
    row[:] = np.where(last >= 0, row[last], before)


def _places(words: Array, here: tuple[float, float, float], absolute: Bools) -> Bools:
    """Turn X, Y and Z into where each line goes; tells which are distances (G91) from an unknown place."""
    lost = np.zeros(words.shape[1], dtype=np.bool_)
    every, none = bool(absolute.all()), not absolute.any()
    for row, before in zip(words[X : Z + 1], here, strict=True):
        if every:
            _hold(row, before)
            continue
        row[np.isnan(row) & ~absolute] = 0.0
        if none:  # with the same rounding as line by line
            lost |= (row != 0) & (not math.isfinite(before))
            row[:] = np.cumsum(np.append(before, row))[1:]
            continue
        way = np.where(absolute, 0.0, row)
        after = np.append(0.0, np.cumsum(way))
        row[~absolute] = math.nan
        last = np.maximum.accumulate(np.where(np.isnan(row), -1, np.arange(row.size)))
        lost |= (way != 0) & (last < 0) & (not math.isfinite(before))
        row[:] = np.where(last >= 0, row[last], before) + (after[1:] - after[last + 1])
    return lost


def _arcs(machine: Modal, table: Array, words: Array, arc: Bools) -> Bools:
    """Fill in centre, sweep and error of the arcs in ``table``; tells which the control would refuse."""
    start, end = table[arc, 2:4], table[arc, 5:7]
    given = words[I : J + 1, arc].T
    missing = np.isnan(given)
    ccw = words[G, arc] == 3
    centre = given if machine.absolute_centres else start + np.where(missing, 0.0, given)
    radius = words[R, arc]
    by_radius = np.flatnonzero(~np.isnan(radius))
    if by_radius.size:
        missing[by_radius] = False
        centre[by_radius] = centres_of(
            start[by_radius],
            end[by_radius],
            radius[by_radius],
            ccw[by_radius],
            machine.dialect.arcs.chord_slack,
        )
    with np.errstate(over="ignore", invalid="ignore"):  # an overflow is refused, like all that is not finite
        out, back = start - centre, end - centre
        first, last = np.hypot(*out.T), np.hypot(*back.T)
        error = np.abs(first - last)
        turn = np.arctan2(back[:, 1], back[:, 0]) - np.arctan2(out[:, 1], out[:, 0])
    whole = (start == end).all(axis=1)
    turn = np.where(ccw & (whole | (turn <= 0)), np.where(whole, 0.0, turn) + math.tau, turn)
    turn = np.where(~ccw & (whole | (turn >= 0)), np.where(whole, 0.0, turn) - math.tau, turn)
    table[arc, 8:10], table[arc, 10], table[arc, 11] = centre, turn, error
    known = np.isfinite(table[arc, 2:8]).all(axis=1) & np.isfinite(error)
    if machine.absolute_centres:
        known &= ~missing.any(axis=1)
    for line in table[arc, 1][~np.isnan(given).all(axis=1)][:1].tolist():
        machine.by_centre(int(line))
    known &= np.abs(turn) >= machine.dialect.arcs.least_turn
    refused: Bools = ~known | machine.dialect.arcs.refuses(first, last, machine.scale != 1.0)
    return refused
