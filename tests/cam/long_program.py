"""A program of as many moves as one likes, proven all the same."""

import math
from dataclasses import replace

import numpy as np
from shop import MILL, plate_program

from mechwright_cam.program.moves import Feed, Operation, Program, Rapid, ToolSection


def long_program(moves: int) -> Program:
    """The plate of the tests, and before its outside many short moves around it: a wavy spiral in the frame."""
    program = plate_program()
    *before, last = program.sections
    turn = np.linspace(0, 60 * math.pi, moves)
    wave = 1 + 0.004 * np.sin(40 * turn)
    x = 36.0 * np.sign(np.cos(turn)) * np.abs(np.cos(turn)) ** 0.4 * wave
    y = 26.0 * np.sign(np.sin(turn)) * np.abs(np.sin(turn)) ** 0.4 * wave
    z = -0.4 * np.arange(moves) / moves
    cuts = tuple(Feed(a, b, c, 900.0) for a, b, c in zip(x.tolist(), y.tolist(), z.tolist(), strict=True))
    wavy = Operation("waves", (Rapid(x[0], y[0]), Rapid(z=1.0), *cuts, Rapid(z=5.0)))
    section = ToolSection(MILL, last.spindle, last.coolant, (wavy,))
    return replace(program, sections=(*before, section, last))
