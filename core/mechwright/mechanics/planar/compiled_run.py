"""Runs the compiled operations of a chain of dyads over the samples of a period, design after design."""

import math

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.mechanics.compiled import compiled
from mechwright.mechanics.planar.compiled_dyads import (
    CHUNK,
    CRANK,
    CROSSING,
    DRIVE,
    FIRST,
    FIXED_POINT,
    FIXED_TURNING,
    FOURTH,
    GEAR,
    KIND,
    NUMBER,
    OUT,
    PIN_AND_SLIDE,
    PINS,
    POINT,
    ROCKS,
    ROTATED,
    SECOND,
    SLID,
    SLIDE_BETWEEN,
    SMALLER,
    THIRD,
    WAY,
    close_crossing,
    close_pin_and_slide,
    close_pins,
    close_slide_between,
    measure_angle,
    measure_way,
    move_drive,
    place_on_line,
    place_point,
    rotate,
    take_smaller,
    turn,
)


@compiled
def _move(
    ops: NDArray[np.int64],
    numbers: Array,
    drive: Array,
    circles: Array,
    start: int,
    size: int,
    rates: int,
    rows: Array,
    last: Array,
) -> None:
    """All operations over samples from ``start`` on, of which the rows of the input are filled."""
    turned = 1
    for op in range(len(ops)):  # a slice of an array for each would take as long as what is done with it
        kind, out, a, b = ops[op, KIND], ops[op, OUT], ops[op, FIRST], ops[op, SECOND]
        c, d, n = ops[op, THIRD], ops[op, FOURTH], ops[op, NUMBER]
        if kind == FIXED_POINT:
            if start == 0:
                rows[out], rows[out + 1] = numbers[n], numbers[n + 1]
                rows[out + 2 : out + 8] = 0.0
        elif kind == FIXED_TURNING:
            if start == 0:
                rows[out], rows[out + 1] = math.cos(numbers[n]), math.sin(numbers[n])
                rows[out + 2 : out + 5] = 0.0
        elif kind in (CRANK, GEAR):
            turn(drive, circles[turned], numbers[n], numbers[n + 1], out, start, size, rows)
            turned += 1
        elif kind == ROTATED:
            rotate(a, numbers[n], out, size, rows)
        elif kind == POINT:
            place_point(a, b, numbers[n], numbers[n + 1], out, rates, size, rows)
        elif kind == PINS:
            close_pins(a, b, numbers[n:], c, d, out, rates, size, rows)
        elif kind == PIN_AND_SLIDE:
            close_pin_and_slide(a, b, c, numbers[n:], d, out, out + 4, rates, size, rows)
        elif kind == SLIDE_BETWEEN:
            close_slide_between(a, b, numbers[n:], c, out, rates, size, rows)
        elif kind == CROSSING:
            close_crossing(a, b, c, d, numbers[n:], out, rates, size, rows)
        elif kind == SLID:
            place_on_line(a, b, c, numbers[n], out, rates, size, rows)
        elif kind == WAY:
            measure_way(a, b, c, out, rates, size, rows)
        elif kind == SMALLER:
            take_smaller(a, b, out, size, rows)
        else:
            measure_angle(a, numbers[n:], out, start, size, rows, last)


@compiled
def extremes(
    ops: NDArray[np.int64],
    numbers: Array,
    drives: Array,
    circles: Array,
    wanted: NDArray[np.int64],
    rates: int,
    count: int,
) -> Array:
    """Least and greatest values (n, k, 2) of rows over a period; NaN where a row has one.

    Parameters
    ----------
    ops, numbers
        (j, 7) and (n, q), as the module says.
    drives
        (n, 5).
    circles
        (t, 2, m): cosine and sine of 0 to 2π over the samples, then, for inputs that do not rock, of the way
        of each CRANK and GEAR from its start on.
    wanted
        (k, 2): rows, and of how many samples one is taken.
    rates
        The highest rate that is needed, 0 to 3.
    count
        Of rows in the table.
    """
    found, samples = np.empty((len(drives), len(wanted), 2)), circles.shape[2]
    rows, last = np.zeros((count, CHUNK)), np.zeros(count)
    lanes = np.empty((3 * len(wanted), CHUNK))
    for one in range(len(drives)):
        for place in range(len(wanted)):
            lanes[3 * place], lanes[3 * place + 1], lanes[3 * place + 2] = math.inf, -math.inf, 0.0
        for start in range(0, samples, CHUNK):
            size = min(CHUNK, samples - start)
            move_drive(drives[one], circles[0], start, size, samples, rows)
            _move(ops, numbers[one], drives[one], circles, start, size, rates, rows, last)
            for place in range(len(wanted)):
                _compare(rows, wanted[place, 0], start, wanted[place, 1], size, 3 * place, lanes)
        for place in range(len(wanted)):
            least, greatest, whole = math.inf, -math.inf, 0.0
            for i in range(CHUNK):
                least, greatest = min(least, lanes[3 * place, i]), max(greatest, lanes[3 * place + 1, i])
                whole += lanes[3 * place + 2, i]
            if math.isnan(whole):
                least = greatest = math.nan
            found[one, place, 0], found[one, place, 1] = least, greatest
    return found


@compiled
def _compare(rows: Array, row: int, start: int, step: int, size: int, lane: int, lanes: Array) -> None:
    """Least and greatest values at each place of a chunk, and sums, which are NaN if a value is."""
    if step == 1:
        for i in range(size):
            value, least, greatest = rows[row, i], lanes[lane, i], lanes[lane + 1, i]
            lanes[lane, i] = value if value < least else least
            lanes[lane + 1, i] = value if value > greatest else greatest
            lanes[lane + 2, i] += value
        return
    for i in range(-start % step, size, step):
        value = rows[row, i]
        lanes[lane, i], lanes[lane + 1, i] = min(lanes[lane, i], value), max(lanes[lane + 1, i], value)
        lanes[lane + 2, i] += value


@compiled
def sampled(
    ops: NDArray[np.int64],
    numbers: Array,
    drives: Array,
    circles: Array,
    wanted: NDArray[np.int64],
    rates: int,
    count: int,
) -> Array:
    """Values (n, k, m) of the ``wanted`` rows (k,); other arguments are those of :func:`extremes`."""
    samples = circles.shape[2]
    found = np.empty((len(drives), len(wanted), samples))
    rows, last = np.zeros((count, CHUNK)), np.zeros(count)
    for one in range(len(drives)):
        for start in range(0, samples, CHUNK):
            size = min(CHUNK, samples - start)
            move_drive(drives[one], circles[0], start, size, samples, rows)
            _move(ops, numbers[one], drives[one], circles, start, size, rates, rows, last)
            for place in range(len(wanted)):
                found[one, place, start : start + size] = rows[wanted[place], :size]
    return found


@compiled
def valued(
    ops: NDArray[np.int64],
    numbers: Array,
    inputs: Array,
    wanted: NDArray[np.int64],
    rates: int,
    count: int,
) -> Array:
    """Values (n, k, m) of the ``wanted`` rows (k,) at inputs (n, m), with rates per unit of the input.

    Other arguments are those of :func:`extremes`.
    """
    samples = inputs.shape[1]
    found = np.empty((len(inputs), len(wanted), samples))
    rows, last = np.zeros((count, CHUNK)), np.zeros(count)
    free, none = np.zeros(5), np.zeros((len(ops) + 1, 2, 1))
    free[ROCKS] = 1.0  # so that angles are those of the inputs
    rows[DRIVE + 1] = 1.0
    for one in range(len(inputs)):
        for start in range(0, samples, CHUNK):
            size = min(CHUNK, samples - start)
            rows[DRIVE, :size] = inputs[one, start : start + size]
            _move(ops, numbers[one], free, none, start, size, rates, rows, last)
            for place in range(len(wanted)):
                found[one, place, start : start + size] = rows[wanted[place], :size]
    return found
