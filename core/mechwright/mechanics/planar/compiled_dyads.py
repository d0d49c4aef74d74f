"""Compiled motion of chains of dyads, for many designs one after the other: some 4 ns a dyad and sample.

A chain is a list of operations on a table of rows over some samples. A point has eight rows: X, Y and their
three rates. A turning has five: cosine, sine and three rates. A way along a line has four. What an operation
needs of a design stands in the design's row of numbers. Formulas are those of
:mod:`mechwright.mechanics.planar.dyads` and :mod:`mechwright.mechanics.planar.dyad`.

:mod:`mechwright.mechanics.planar.compiled_chain` makes the list of a machine.
"""

import math

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.compiled import compiled

(
    FIXED_POINT, FIXED_TURNING, CRANK, GEAR, ROTATED, POINT, PINS, PIN_AND_SLIDE, SLIDE_BETWEEN, CROSSING,
    SLID, WAY, ANGLE, SMALLER,
) = range(14)  # fmt: skip
"""Kinds of operations. What each takes and gives stands at its function."""

KIND, OUT, FIRST, SECOND, THIRD, FOURTH, NUMBER = range(7)
"""Places in an operation (7,): its kind, rows, and where its numbers begin."""

CHUNK = 128
"""Samples at once: their rows stay in the cache of a core."""

DRIVE = 0
"""Row of the input, rad or mm; its three rates follow."""

START, TRAVEL, ROCKS, RATIO, SPEED = range(5)
"""Places in a drive (5,): see :class:`mechwright.mechanics.planar.course.Course`."""


@compiled
def move_drive(drive: Array, phase: Array, start: int, size: int, samples: int, rows: Array) -> None:
    """The input and its rates; ``phase`` has cosine and sine of 0 to 2π over the samples."""
    half, speed, ratio = drive[TRAVEL] / 2, drive[SPEED], drive[RATIO]
    if drive[ROCKS] > 0:
        for i in range(size):
            cos, sin = phase[0, start + i], phase[1, start + i]
            rows[DRIVE, i] = drive[START] + half * (1 - cos)
            rows[DRIVE + 1, i], rows[DRIVE + 2, i] = half * speed * sin, half * speed * speed * cos
            rows[DRIVE + 3, i] = -half * speed**3 * sin
        return
    omega, step = math.copysign(speed, half), drive[TRAVEL] / (samples - 1)
    if start == 0:  # of constant speed
        rows[DRIVE + 1], rows[DRIVE + 2], rows[DRIVE + 3] = omega, 0.0, 0.0
    for i in range(size):
        rows[DRIVE, i] = drive[START] + (start + i) * step
    if ratio != 0:
        for i in range(size):
            grown = omega * math.exp(ratio * ((start + i) * step))
            rows[DRIVE + 1, i], rows[DRIVE + 2, i] = grown, ratio * grown * grown
            rows[DRIVE + 3, i] = 2 * ratio * ratio * grown**3


@compiled
def turn(
    drive: Array, circle: Array, ratio: float, angle: float, out: int, start: int, size: int, rows: Array
) -> None:
    """CRANK, GEAR: the turning (``out``) at ``ratio`` times the input plus ``angle``.

    ``circle`` has cosine and sine of the way of an input that turns, times the ratio.
    """
    if drive[ROCKS] > 0:
        for i in range(size):
            theta = ratio * rows[DRIVE, i] + angle
            rows[out, i], rows[out + 1, i] = math.cos(theta), math.sin(theta)
    else:
        begin, sense = ratio * drive[START] + angle, math.copysign(1.0, drive[TRAVEL])
        c, s = math.cos(begin), math.sin(begin)
        for i in range(size):
            cos, sin = circle[0, start + i], sense * circle[1, start + i]
            rows[out, i], rows[out + 1, i] = c * cos - s * sin, s * cos + c * sin
    if start == 0 or drive[ROCKS] > 0 or drive[RATIO] != 0:  # else rates are those of the first samples
        for order in range(1, 4):
            for i in range(CHUNK):
                rows[out + 1 + order, i] = ratio * rows[DRIVE + order, i]


@compiled
def rotate(given: int, angle: float, out: int, size: int, rows: Array) -> None:
    """ROTATED: a turning counted from another angle."""
    c, s = math.cos(angle), math.sin(angle)
    for i in range(size):
        cos, sin = rows[given, i], rows[given + 1, i]
        rows[out, i], rows[out + 1, i] = c * cos - s * sin, s * cos + c * sin
    for order in range(2, 5):
        for i in range(size):
            rows[out + order, i] = rows[given + order, i]


@compiled
def place_point(
    origin: int, turning: int, x: float, y: float, out: int, rates: int, size: int, rows: Array
) -> None:
    """POINT: the place x + i y of a body whose origin and turning are given."""
    for i in range(size):
        cos, sin = rows[turning, i], rows[turning + 1, i]
        qx, qy = x * cos - y * sin, x * sin + y * cos
        rows[out, i], rows[out + 1, i] = rows[origin, i] + qx, rows[origin + 1, i] + qy
    if rates > 0:
        for i in range(size):
            cos, sin, w = rows[turning, i], rows[turning + 1, i], rows[turning + 2, i]
            qx, qy = x * cos - y * sin, x * sin + y * cos
            rows[out + 2, i], rows[out + 3, i] = rows[origin + 2, i] - w * qy, rows[origin + 3, i] + w * qx
    if rates > 1:
        for i in range(size):
            cos, sin, w = rows[turning, i], rows[turning + 1, i], rows[turning + 2, i]
            qx, qy = x * cos - y * sin, x * sin + y * cos
            g, square = rows[turning + 3, i], w * w
            rows[out + 4, i] = rows[origin + 4, i] - g * qy - square * qx
            rows[out + 5, i] = rows[origin + 5, i] + g * qx - square * qy
    if rates > 2:
        for i in range(size):
            cos, sin, w = rows[turning, i], rows[turning + 1, i], rows[turning + 2, i]
            qx, qy = x * cos - y * sin, x * sin + y * cos
            g, square = rows[turning + 3, i], w * w
            n, more = rows[turning + 4, i] - w * square, 3 * w * g
            rows[out + 6, i] = rows[origin + 6, i] - n * qy - more * qx
            rows[out + 7, i] = rows[origin + 7, i] + n * qx - more * qy


@compiled
def close_pins(
    p: int, q: int, numbers: Array, s: int, t: int, out: int, rates: int, size: int, rows: Array
) -> None:
    """PINS: turnings ``s`` and ``t`` of two bars from the points ``p`` and ``q`` to a common pin (RRR).

    Numbers: lengths c and l, the branch, and the angles by which the links turn behind their bars. ``out`` is
    the sine of the transmission angle, and its cosine, both with their signs.
    """
    c, l, branch = numbers[0], numbers[1], numbers[2]
    most, least, off = (c + l) ** 2, (c - l) ** 2, (c - l) * (c + l)
    by_c, by_l = 0.5 / c, 0.5 / l
    for i in range(size):
        dx, dy = rows[q, i] - rows[p, i], rows[q + 1, i] - rows[p + 1, i]
        square = dx * dx + dy * dy
        w = branch * math.sqrt((most - square) * (square - least))
        rows[out, i] = 2 * by_c * by_l * w
        rows[out + 1, i] = by_c * by_l * (most + least - 2 * square)
        by = by_c / square
        k, w1 = (square + off) * by, w * by
        rows[s, i], rows[s + 1, i] = dx * k - dy * w1, dx * w1 + dy * k
        by = by_l / square
        m, w2 = (off - square) * by, w * by
        rows[t, i], rows[t + 1, i] = dx * m - dy * w2, dx * w2 + dy * m
    if rates > 0:
        _pin_rates(p, q, c, l, s, t, out, rates, size, rows)
    for turning, angle in ((s, numbers[3]), (t, numbers[4])):
        if angle != 0:
            rotate(turning, angle, turning, size, rows)


@compiled
def _pin_rates(
    p: int, q: int, c: float, l: float, s: int, t: int, out: int, rates: int, size: int, rows: Array
) -> None:
    """Rates of two bars in the directions ``s`` and ``t``, with the sine ``out``: see :func:`close_pins`."""
    by_c, by_l = 1 / c, 1 / l
    for i in range(size):
        sx, sy, tx, ty = rows[s, i], rows[s + 1, i], rows[t, i], rows[t + 1, i]
        n = 1 / rows[out, i]
        rx, ry = rows[q + 2, i] - rows[p + 2, i], rows[q + 3, i] - rows[p + 3, i]
        rows[s + 2, i] = n * by_c * (rx * tx + ry * ty)
        rows[t + 2, i] = n * by_l * (rx * sx + ry * sy)
    if rates > 1:
        for i in range(size):
            sx, sy, tx, ty = rows[s, i], rows[s + 1, i], rows[t, i], rows[t + 1, i]
            n, w1, v1 = 1 / rows[out, i], rows[s + 2, i], rows[t + 2, i]
            f, g = c * w1 * w1, l * v1 * v1
            rx = rows[q + 4, i] - rows[p + 4, i] + f * sx - g * tx
            ry = rows[q + 5, i] - rows[p + 5, i] + f * sy - g * ty
            rows[s + 3, i] = n * by_c * (rx * tx + ry * ty)
            rows[t + 3, i] = n * by_l * (rx * sx + ry * sy)
    if rates > 2:
        for i in range(size):
            sx, sy, tx, ty = rows[s, i], rows[s + 1, i], rows[t, i], rows[t + 1, i]
            n, w1, v1, w2, v2 = (
                1 / rows[out, i],
                rows[s + 2, i],
                rows[t + 2, i],
                rows[s + 3, i],
                rows[t + 3, i],
            )
            f, g, h, k = 3 * c * w1 * w2, 3 * l * v1 * v2, c * w1**3, l * v1**3
            rx = rows[q + 6, i] - rows[p + 6, i] + f * sx - h * sy - g * tx + k * ty
            ry = rows[q + 7, i] - rows[p + 7, i] + f * sy + h * sx - g * ty - k * tx
            rows[s + 4, i] = n * by_c * (rx * tx + ry * ty)
            rows[t + 4, i] = n * by_l * (rx * sx + ry * sy)


@compiled
def _complex(rows: Array, row: int, i: int) -> complex:
    return complex(rows[row, i], rows[row + 1, i])


@compiled
def close_pin_and_slide(
    p: int, q: int, n: int, numbers: Array, s: int, way: int, out: int, rates: int, size: int, rows: Array
) -> None:
    """PIN_AND_SLIDE: the turning ``s`` of a bar from ``p`` whose end is on the line ``q``, ``n`` (RRP).

    Numbers: the bar's length, the offset of its end from the line, the branch, and the angle by which the
    link turns behind the bar. ``way`` is how far the end is along the line.
    """
    length, h, branch = numbers[0], numbers[1], numbers[2]
    back = complex(math.cos(numbers[3]), math.sin(numbers[3]))
    for i in range(size):
        turn = _complex(rows, n, i)
        un = turn.conjugate()
        d = (_complex(rows, p, i) - _complex(rows, q, i)) * un
        across = h - d.imag
        along = branch * math.sqrt(length * length - across * across)
        z, e = complex(along, across), complex(d.real + along, h)
        bar = z * turn / length * back
        rows[s, i], rows[s + 1, i], rows[way, i] = bar.real, bar.imag, e.real
        rows[out, i], rows[out + 1, i] = along / length, across / length
        if rates == 0:
            continue
        b1 = 1j * rows[n + 2, i]
        r = (_complex(rows, q + 2, i) - _complex(rows, p + 2, i)) * un + b1 * e
        w1 = r.imag / z.real
        s1 = -w1 * z.imag - r.real
        rows[s + 2, i], rows[way + 1, i] = w1, s1
        if rates == 1:
            continue
        a2 = 1j * rows[n + 3, i] + b1 * b1
        r = (_complex(rows, q + 4, i) - _complex(rows, p + 4, i)) * un + a2 * e + 2 * b1 * s1 + w1 * w1 * z
        w2 = r.imag / z.real
        s2 = -w2 * z.imag - r.real
        rows[s + 3, i], rows[way + 2, i] = w2, s2
        if rates == 2:
            continue
        a3 = 1j * rows[n + 4, i] + 3 * b1 * 1j * rows[n + 3, i] + b1 * b1 * b1
        r = (_complex(rows, q + 6, i) - _complex(rows, p + 6, i)) * un + a3 * e + 3 * a2 * s1 + 3 * b1 * s2
        r += (3 * w1 * w2 + 1j * w1**3) * z
        w3 = r.imag / z.real
        rows[s + 4, i], rows[way + 3, i] = w3, -w3 * z.imag - r.real


@compiled
def close_slide_between(
    p: int, q: int, numbers: Array, n: int, out: int, rates: int, size: int, rows: Array
) -> None:
    """SLIDE_BETWEEN: the turning ``n`` of the line on which bars from ``p`` and ``q`` slide (RPR).

    Numbers: the offset of the second pin from the first, and the branch.
    """
    offset, branch = numbers[0], numbers[1]
    for i in range(size):
        apart = _complex(rows, q, i) - _complex(rows, p, i)
        distance = abs(apart)
        along = branch * math.sqrt(distance * distance - offset * offset)
        e = complex(along, offset)
        turn = apart / e
        turn /= abs(turn)
        un = turn.conjugate()
        rows[n, i], rows[n + 1, i] = turn.real, turn.imag
        rows[out, i], rows[out + 1, i] = along / distance, offset / distance
        if rates == 0:
            continue
        x = (_complex(rows, q + 2, i) - _complex(rows, p + 2, i)) * un
        b1 = x.imag / along
        s1 = x.real + b1 * offset
        rows[n + 2, i] = b1
        if rates == 1:
            continue
        x = (_complex(rows, q + 4, i) - _complex(rows, p + 4, i)) * un - 2j * b1 * s1 + b1 * b1 * e
        b2 = x.imag / along
        s2 = x.real + b2 * offset
        rows[n + 3, i] = b2
        if rates == 2:
            continue
        x = (_complex(rows, q + 6, i) - _complex(rows, p + 6, i)) * un
        x += -3j * b1 * s2 - 3 * (1j * b2 - b1 * b1) * s1 + (3 * b1 * b2 + 1j * b1**3) * e
        rows[n + 4, i] = x.imag / along


@compiled
def close_crossing(
    p: int, m: int, q: int, n: int, numbers: Array, way: int, rates: int, size: int, rows: Array
) -> None:
    """CROSSING: how far a point that slides on the lines ``p``, ``m`` and ``q``, ``n`` is along the first.

    Numbers: the offsets of the point from both lines (PRP, RPP). Sine and cosine between the lines follow
    ``way``.
    """
    for i in range(size):
        one, two = _complex(rows, m, i), _complex(rows, n, i)
        across = one * two.conjugate()
        sine = across.imag
        rows[way + 4, i], rows[way + 5, i] = sine, across.real
        apart = _complex(rows, q, i) + 1j * numbers[1] * two - _complex(rows, p, i) - 1j * numbers[0] * one
        s0, t0 = (apart * two.conjugate()).imag / sine, (apart * one.conjugate()).imag / sine
        rows[way, i] = s0
        if rates == 0:
            continue
        e, f = complex(s0, numbers[0]), complex(t0, numbers[1])
        b, c = 1j * rows[m + 2, i], 1j * rows[n + 2, i]
        apart = _complex(rows, q + 2, i) + c * f * two - _complex(rows, p + 2, i) - b * e * one
        s1, t1 = (apart * two.conjugate()).imag / sine, (apart * one.conjugate()).imag / sine
        rows[way + 1, i] = s1
        if rates == 1:
            continue
        b2, c2 = 1j * rows[m + 3, i] + b * b, 1j * rows[n + 3, i] + c * c
        apart = _complex(rows, q + 4, i) + (c2 * f + 2 * c * t1) * two
        apart -= _complex(rows, p + 4, i) + (b2 * e + 2 * b * s1) * one
        s2, t2 = (apart * two.conjugate()).imag / sine, (apart * one.conjugate()).imag / sine
        rows[way + 2, i] = s2
        if rates == 2:
            continue
        b3 = 1j * rows[m + 4, i] + 3 * b * 1j * rows[m + 3, i] + b * b * b
        c3 = 1j * rows[n + 4, i] + 3 * c * 1j * rows[n + 3, i] + c * c * c
        apart = _complex(rows, q + 6, i) + (c3 * f + 3 * c2 * t1 + 3 * c * t2) * two
        apart -= _complex(rows, p + 6, i) + (b3 * e + 3 * b2 * s1 + 3 * b * s2) * one
        rows[way + 3, i] = (apart * two.conjugate()).imag / sine


@compiled
def place_on_line(q: int, n: int, way: int, h: float, out: int, rates: int, size: int, rows: Array) -> None:
    """SLID: the point that is so far along the line ``q``, ``n``, and ``h`` to the left of it."""
    for i in range(size):
        turn, e, s1 = _complex(rows, n, i), complex(rows[way, i], h), rows[way + 1, i]
        place = _complex(rows, q, i) + e * turn
        rows[out, i], rows[out + 1, i] = place.real, place.imag
        if rates == 0:
            continue
        b1 = 1j * rows[n + 2, i]
        rate = _complex(rows, q + 2, i) + (b1 * e + s1) * turn
        rows[out + 2, i], rows[out + 3, i] = rate.real, rate.imag
        if rates == 1:
            continue
        a2, s2 = 1j * rows[n + 3, i] + b1 * b1, rows[way + 2, i]
        rate = _complex(rows, q + 4, i) + (a2 * e + 2 * b1 * s1 + s2) * turn
        rows[out + 4, i], rows[out + 5, i] = rate.real, rate.imag
        if rates == 2:
            continue
        a3 = 1j * rows[n + 4, i] + 3 * b1 * 1j * rows[n + 3, i] + b1 * b1 * b1
        rate = _complex(rows, q + 6, i) + (a3 * e + 3 * a2 * s1 + 3 * b1 * s2 + rows[way + 3, i]) * turn
        rows[out + 6, i], rows[out + 7, i] = rate.real, rate.imag


@compiled
def measure_way(p: int, q: int, n: int, out: int, rates: int, size: int, rows: Array) -> None:
    """WAY: how far the point ``p`` is along the line ``q``, ``n``, and its rates as the line sees it."""
    for i in range(size):
        un = _complex(rows, n, i).conjugate()
        e = (_complex(rows, p, i) - _complex(rows, q, i)) * un
        rows[out, i] = e.real
        if rates == 0:
            continue
        w = rows[n + 2, i]
        e1 = (_complex(rows, p + 2, i) - _complex(rows, q + 2, i)) * un - 1j * w * e
        rows[out + 1, i] = e1.real
        if rates == 1:
            continue
        a2 = complex(-w * w, rows[n + 3, i])
        e2 = (_complex(rows, p + 4, i) - _complex(rows, q + 4, i)) * un - 2j * w * e1 - a2 * e
        rows[out + 2, i] = e2.real
        if rates == 2:
            continue
        a3 = complex(-3 * w * rows[n + 3, i], rows[n + 4, i] - w**3)
        e3 = (_complex(rows, p + 6, i) - _complex(rows, q + 6, i)) * un - 3j * w * e2 - 3 * a2 * e1 - a3 * e
        rows[out + 3, i] = e3.real


@compiled
def measure_angle(
    turning: int, numbers: Array, out: int, start: int, size: int, rows: Array, last: Array
) -> None:
    """ANGLE: the angle of a turning, rad, which runs on over the samples.

    Numbers: an angle, a ratio, and whether the first angle is near to the ratio times the input plus the
    angle; else it is within (-π, π] of the angle.
    """
    offset, ratio, aimed = numbers[0], numbers[1], numbers[2] > 0
    for i in range(size):
        angle = math.atan2(rows[turning + 1, i], rows[turning, i])
        if start + i > 0:
            angle -= math.tau * np.rint((angle - last[out]) / math.tau)
        elif aimed:
            angle -= math.tau * np.rint((angle - ratio * rows[DRIVE, i] - offset) / math.tau)
        else:
            angle -= math.tau * math.ceil((angle - offset - math.pi) / math.tau)
        rows[out, i] = last[out] = angle


@compiled
def take_smaller(a: int, b: int, out: int, size: int, rows: Array) -> None:
    """SMALLER: the smaller size of two rows."""
    for i in range(size):
        rows[out, i] = min(abs(rows[a, i]), abs(rows[b, i]))
