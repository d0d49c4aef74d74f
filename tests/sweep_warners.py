"""A source of work whose worker warns: each task of something of its own, and all of them of the same."""

import warnings

from mechwright.contracts.guard import during
from mechwright.studies.task import Source, Task


class UnusualWarning(UserWarning):
    """One that the process which asks does not know."""


class Warner(Source):
    """Gives the name of a task as its table."""

    def done(self, task: Task) -> bytes:
        """Warn of the same and of the task."""
        with during("family odd of odd-families: evaluate"):
            warnings.warn("divide by zero", RuntimeWarning, stacklevel=1)
        warnings.warn(f"of {task.name}", UnusualWarning, stacklevel=1)
        return task.name.encode()
