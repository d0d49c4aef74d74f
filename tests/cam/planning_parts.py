"""Parts for the planning tests."""

import math

import numpy as np

from mechwright.contracts.part import Part
from mechwright.geometry import Arc, Line, Loop, Outline, circle
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.settings import CamSettings

LIBRARY = load_library()


def rounded_box(width, height, radius, clockwise=False):
    """A loop with round corners."""
    w, h = width / 2 - radius, height / 2 - radius
    corners = [((w, -h), -0.5), ((w, h), 0.0), ((-w, h), 0.5), ((-w, -h), 1.0)]
    segments = []
    for centre, start in corners:
        corner = Arc(centre, radius, start * math.pi, math.pi / 2)
        if segments:
            segments.append(Line(segments[-1].end, corner.start))
        segments.append(corner)
    segments.append(Line(segments[-1].end, segments[0].start))
    loop = Loop(tuple(segments))
    return loop.reversed() if clockwise else loop


def bore(diameter, at=(0.0, 0.0)):
    return Loop((circle(at, diameter / 2, clockwise=True),))


def keyed_bore(diameter, width, height):
    """A bore with a keyway: ``height`` from its bottom to the keyway's ground."""
    radius = diameter / 2
    half = math.asin(width / diameter)
    round_part = Arc((0.0, 0.0), radius, math.pi / 2 - half, -(math.tau - 2 * half))
    top = height - radius
    left, right = (-width / 2, top), (width / 2, top)
    return Loop((round_part, Line(round_part.end, left), Line(left, right), Line(right, round_part.start)))


def lobes(count, radius, depth, points=1500, sharpness=0.0):
    """A smooth, toothed outline."""
    t = np.linspace(0, math.tau, points, endpoint=False)
    wave = np.sin(count * t)
    if sharpness:
        wave = np.tanh(sharpness * wave) / math.tanh(sharpness)
    r = radius + depth / 2 * wave
    return Loop.polygon(np.column_stack((r * np.cos(t), r * np.sin(t))))


def part(outer, *inner, thickness=6.0, material="aluminium", machined=()):
    return Part("plate", Outline(outer, inner), thickness, material, machined=machined)


def plate(*inner, **more):
    return part(rounded_box(60, 40, 6), *inner, **more)


def job(of, *names, **settings):
    return make_job(of, CamSettings.model_validate(settings), [LIBRARY.get(name) for name in names])
