"""The order of operations: fewest tool changes among those that respect what must come first."""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

from mechwright_cam.program.moves import Move
from mechwright_cam.shop.tool import Tool


@dataclass(frozen=True)
class Step:
    """An operation that waits for others."""

    name: str
    tool: Tool
    spindle: float
    moves: tuple[Move, ...]
    after: frozenset[int]
    """Indices of the steps that come before it."""


def order(steps: Sequence[Step]) -> list[list[int]]:
    """Indices of the steps in runs of one tool.

    A breadth-first search over the sets of finished steps: each change of tool does all that this tool can do
    by then. Where several orders need the fewest changes, the one that follows the given order counts.
    """
    every = frozenset(range(len(steps)))
    queue: deque[tuple[frozenset[int], list[list[int]]]] = deque([(frozenset(), [])])
    seen: set[frozenset[int]] = set()
    while queue:
        done, runs = queue.popleft()
        if done == every:
            return runs
        if done in seen:
            continue
        seen.add(done)
        ready = [i for i in range(len(steps)) if i not in done and steps[i].after <= done]
        for number in dict.fromkeys(steps[i].tool.number for i in ready):
            run: list[int] = []
            finished = done
            while True:
                more = [
                    i
                    for i in range(len(steps))
                    if i not in finished and steps[i].tool.number == number and steps[i].after <= finished
                ]
                if not more:
                    break
                run.append(more[0])
                finished = finished | {more[0]}
            queue.append((finished, [*runs, run]))
    raise AssertionError("the steps wait for each other")
