"""Tasks of a sweep that are all there from the beginning, as a queue."""

from collections import deque
from typing import TypeVar

T = TypeVar("T")


class ListedTasks(deque[T]):
    """The first is taken first; one that is given back is the next."""

    def take(self) -> T | None:
        return self.popleft() if self else None

    def again(self, task: T) -> None:
        self.appendleft(task)
