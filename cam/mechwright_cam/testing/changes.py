"""A program with one number changed, for every number that it has."""

from collections.abc import Iterator
from dataclasses import fields, replace

from mechwright_cam.program.moves import Drill, FeedArc, Move, Pause, Program

_STEP = 0.125
"""Change of a number that any control can show: mm, mm/min or s."""


def changed(program: Program) -> Iterator[tuple[str, Program]]:
    """The program with one number of one move changed, for every number of every move."""
    for s, section in enumerate(program.sections):
        for o, operation in enumerate(section.operations):
            for m, move in enumerate(operation.moves):
                for what, other in _changed_move(move):
                    moves = (*operation.moves[:m], other, *operation.moves[m + 1 :])
                    operations = list(section.operations)
                    operations[o] = replace(operation, moves=moves)
                    sections = list(program.sections)
                    sections[s] = replace(section, operations=tuple(operations))
                    where = f"{what} of {move} in operation {operation.name!r}"
                    yield where, replace(program, sections=tuple(sections))


def _changed_move(move: Move) -> Iterator[tuple[str, Move]]:
    if isinstance(move, Pause):
        yield "the message", replace(move, message=f"{move.message} again")
        return
    if isinstance(move, FeedArc):
        yield "the direction", replace(move, ccw=not move.ccw)
    # The rest of an arc hangs together: one number alone would leave no circle.
    free = {"z", "feed"} if isinstance(move, FeedArc) else {item.name for item in fields(move)}
    if isinstance(move, Drill) and move.peck is not None and move.dwell == 0:  # one go breaks no chips
        yield "the breaking of chips", replace(move, breaking=not move.breaking)
    for name in sorted(free - {"breaking"}):
        value = getattr(move, name)
        # A dwell of nothing is no dwell, and not every control can dwell in every cycle.
        if value is not None and not (name == "dwell" and value == 0):
            yield name, replace(move, **{name: value + _STEP})
