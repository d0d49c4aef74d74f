"""The plates that the mill takes, for the bill of materials."""

from collections.abc import Sequence

from mechwright.contracts.part import Part
from mechwright.pipeline import Blank, Build, RawStock


class MilledPlates(RawStock):
    """The stock of each job, as its setup sheet says it."""

    name = "milled-plates"
    commands = frozenset({"build"})

    def blanks(self, build: Build) -> Sequence[Blank]:
        """One for each plate or nest; the second side of a plate is no second plate."""
        from mechwright_cam.machining import Machining
        from mechwright_cam.pages.setup_sheet.several import quantity

        found = []
        for job in build.made(Machining).jobs:
            if job.side == "top":
                x0, y0, x1, y1 = job.stock
                size = (x1 - x0, y1 - y0, job.thickness)
                found.append(Blank(_names(job.part), quantity(job), job.part.material, size))
        return found


def _names(part: Part) -> tuple[str, ...]:
    """The parts that are cut from a plate, each once."""
    from mechwright_plane.nest import Nest

    placed = [one.part.name for one in part.placed] if isinstance(part, Nest) else [part.name]
    return tuple(dict.fromkeys(placed))
