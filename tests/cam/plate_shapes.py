"""Plates for the tests of solids and files: every kind of segment, every kind of opening."""

import math

import numpy as np

from mechwright.contracts.motion import Channel, Motion, Poses
from mechwright.contracts.part import Instance, Part
from mechwright.geometry import Arc, BSpline, Line, Loop, Outline, circle

WAVE_RADIUS, WAVE_HEIGHT = 30.0, 2.0


def bezier_through(points, t):
    """The Bezier curve whose point at each of the n parameters t is given: degree n - 1."""
    n = len(t) - 1
    k = np.arange(n + 1)
    binomial = np.array([math.comb(n, i) for i in k], dtype=float)
    basis = binomial * t[:, None] ** k * (1 - t[:, None]) ** (n - k)
    net = np.linalg.solve(basis, points)
    net[0], net[-1] = points[0], points[-1]
    return net


def wavy(lobes=9, pieces=4, degree=5):
    """A loop of Bezier curves along r = 30 + 2 cos(lobes * theta), mm."""
    count = lobes * pieces
    t = (1 - np.cos(np.pi * np.arange(degree + 1) / degree)) / 2
    corners = _wave(2 * np.pi * np.arange(count) / count, lobes)
    segments = []
    for i in range(count):
        points = _wave(2 * np.pi * (i + t) / count, lobes)
        points[0], points[-1] = corners[i], corners[(i + 1) % count]
        segments.append(BSpline.bezier(bezier_through(points, t), "wave"))
    return Loop(tuple(segments))


def _wave(theta, lobes):
    r = WAVE_RADIUS + WAVE_HEIGHT * np.cos(lobes * theta)
    return np.column_stack((r * np.cos(theta), r * np.sin(theta)))


def many_spans():
    """A loop of two B-splines of degree 3 with ten spans each, around a rounded triangle-like shape."""
    halves = []
    for start in (0.0, np.pi):
        theta = start + np.pi * np.arange(11) / 10
        r = 25 + 1.5 * np.cos(3 * theta)
        slope = -4.5 * np.sin(3 * theta)
        points = np.column_stack((r * np.cos(theta), r * np.sin(theta)))
        rates = np.column_stack(
            (slope * np.cos(theta) - r * np.sin(theta), slope * np.sin(theta) + r * np.cos(theta))
        ) * (np.pi / 30)
        inner = np.stack([points[:-1] + rates[:-1], points[1:] - rates[1:]], axis=1).reshape(-1, 2)
        poles = np.concatenate([points[:1], inner, points[-1:]])
        knots = np.concatenate([np.zeros(4), np.repeat(np.arange(1, 10) / 10, 2), np.ones(4)])
        halves.append((tuple(knots.tolist()), [tuple(row) for row in poles.tolist()]))
    (k1, p1), (k2, p2) = halves
    p1[-1], p2[-1] = p2[0], p1[0]
    return Loop((BSpline(3, k1, tuple(p1)), BSpline(3, k2, tuple(p2))))


def rounded_rectangle(width, height, radius, tag=""):
    """A counter-clockwise loop of four lines and four quarter arcs around the origin, mm."""
    x, y = width / 2, height / 2
    a, b, quarter = x - radius, y - radius, math.pi / 2
    return Loop(
        (
            Line((-a, -y), (a, -y), tag),
            Arc((a, -b), radius, -quarter, quarter, tag),
            Line((x, -b), (x, b), tag),
            Arc((a, b), radius, 0.0, quarter, tag),
            Line((a, y), (-a, y), tag),
            Arc((-a, b), radius, quarter, quarter, tag),
            Line((-x, b), (-x, -b), tag),
            Arc((-a, -b), radius, 2 * quarter, quarter, tag),
        )
    )


def keyed_bore(radius=10.0, width=6.0, depth=2.8):
    """A clockwise loop: a bore with a keyway towards +x, mm."""
    h = width / 2
    half = math.asin(h / radius)
    x0, x1 = radius * math.cos(half), radius + depth
    lines = (Line((x0, -h), (x1, -h)), Line((x1, -h), (x1, h)), Line((x1, h), (x0, h)))
    return Loop((*lines, Arc((0.0, 0.0), radius, half, math.tau - 2 * half))).reversed()


def wavy_plate():
    """Splines outside, a keyed bore and a round hole inside: 36 + 4 + 1 segments."""
    hole = Loop((circle((0.0, 20.0), 4.0, clockwise=True),))
    return Outline(wavy(), (keyed_bore(), hole), 0.001)


def spanned_plate():
    """Splines of many spans outside, a round hole inside: 2 + 1 segments."""
    return Outline(many_spans(), (Loop((circle((0.0, 0.0), 5.0, clockwise=True),)),), 0.001)


def slotted_plate():
    """Lines and arcs outside, a rounded slot inside: 8 + 8 segments."""
    return Outline(rounded_rectangle(60, 40, 6), (rounded_rectangle(20, 8, 3).reversed(),))


def bent_plate():
    """A crescent whose end is an arc of more than half a turn, clockwise arcs included: 4 segments."""
    return Outline(
        Loop(
            (
                Line((0.0, -10.0), (20.0, -10.0)),
                Arc((20.0, 0.0), 10.0, -math.pi / 2, math.pi),
                Line((20.0, 10.0), (0.0, 10.0)),
                Arc((-6.0, 0.0), math.hypot(6, 10), math.atan2(10, 6), -2 * math.atan2(10, 6)),
            )
        )
    )


PLATES = {
    "wavy": wavy_plate,
    "spanned": spanned_plate,
    "slotted": slotted_plate,
    "bent": bent_plate,
}


def wavy_part(name="wheel"):
    """A part with two instances on bodies that turn."""
    instances = (Instance("driver"), Instance("driven", 1.5))
    return Part(name, wavy_plate(), 8.0, "steel", instances, colour=(0.8, 0.5, 0.2))


def turning(samples=5):
    """A motion of two bodies that turn against each other, 65 mm apart."""
    theta = np.linspace(0, 1, samples)
    poses = {"driver": Poses.planar(0.0, 0.0, theta), "driven": Poses.planar(65.0, 0.0, -theta)}
    return Motion("theta", {"theta": Channel(theta, "rad")}, poses)


def volume_of(mesh):
    """Volume of a closed mesh, mm³, by the divergence theorem."""
    a, b, c = mesh.points[mesh.triangles].transpose(1, 0, 2)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)
