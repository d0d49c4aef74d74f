"""A source of a sweep that measures itself, in a module that workers can import."""

import struct
import time
from collections import deque

from mechwright.studies.task import Source, Task


class Tasks(deque[Task]):
    """Tasks that are all there from the beginning."""

    def take(self) -> Task | None:
        """The next task."""
        return self.popleft() if self else None

    def again(self, task: Task) -> None:
        """Take back a task."""
        self.appendleft(task)


class Timed(Source):
    """A source that adds to each table the seconds that its thread took for it."""

    def done(self, task: Task) -> bytes:
        """The table is made, and goes the same way; its last eight bytes are the seconds."""
        start = time.thread_time()
        content = super().done(task)
        assert isinstance(content, bytes)
        return content + struct.pack("d", time.thread_time() - start)
