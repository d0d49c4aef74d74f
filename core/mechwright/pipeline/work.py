"""What each command makes of a design: the last stage of its work, and what it makes on the way."""

from dataclasses import dataclass

from mechwright.contracts.finding import Stage

SOLIDS, PROGRAMS = "solids", "programs"
"""What takes long to make: bodies in the CAD kernel; programs, planned and proven."""


@dataclass(frozen=True)
class Work:
    """What a run does.

    Parameters
    ----------
    stage
        The last stage of it: errors of later ones are told and stop nothing.
    makes
        What it makes for the inspections that need it, such as :data:`SOLIDS`.
    process
        The process whose files it writes: what others find of the parts is not asked. Empty asks all.
    """

    stage: Stage
    makes: frozenset[str] = frozenset()
    process: str = ""


WORK = {
    "solve": Work(Stage.MOTION),
    "model": Work(Stage.ASSEMBLY, frozenset({SOLIDS})),
    "cam": Work(Stage.MACHINING, frozenset({PROGRAMS})),
    "build": Work(Stage.OUTPUT, frozenset({SOLIDS, PROGRAMS})),
}
"""The commands that write a design's files, in the order of the work."""

LOOK = Work(Stage.OUTPUT)
"""All that can be said before anything is made: what ``check`` asks by itself."""


def work_to(stage: Stage) -> tuple[str, Work]:
    """Everything up to a stage, and the command whose files are made at its end; empty where none is."""
    makes = frozenset().union(*(one.makes for one in WORK.values() if not one.stage.is_after(stage)))
    command = next((name for name, one in WORK.items() if one.stage is stage), "")
    return command, Work(stage, makes)
