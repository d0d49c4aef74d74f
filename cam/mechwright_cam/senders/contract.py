"""What a place is that takes programs."""

from abc import ABC, abstractmethod

from mechwright_cam.senders.certified import ProgramFile


class Target(ABC):
    """A place that takes programs.

    Raises OutputError where it cannot be reached or does not hold afterwards what was sent.
    """

    controls: frozenset[str] = frozenset()
    """Names of the controls whose programs it takes; empty for all."""
    single: bool = False
    """Whether it holds one file at a time."""

    @abstractmethod
    def send(self, file: ProgramFile, *, replace: bool) -> str:
        """Send a file, and say where it is."""
