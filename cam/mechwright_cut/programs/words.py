"""Words that programs of all controls share."""

from mechwright.geometry.segments import Point
from mechwright_cut.jobs import CutJob
from mechwright_plane.path import Cut, Path
from mechwright_plane.text import GRBL_COMMENT_WIDTH, GRBL_REALTIME, LINUXCNC_ACTIVE, comment_lines, number

UNSAFE = "%;" + GRBL_REALTIME
"""Characters that a control or a sender obeys or chokes on even in a comment."""


def at(point: Point) -> str:
    """X and Y."""
    return f"X{number(point[0])} Y{number(point[1])}"


def move(here: Point, cut: Cut) -> str:
    """A line, or an arc with its centre from its start."""
    if not cut.turn:
        return f"G1 {at((cut.x, cut.y))}"
    word = "G3" if cut.turn > 0 else "G2"
    return f"{word} {at((cut.x, cut.y))} I{number(cut.cx - here[0])} J{number(cut.cy - here[1])}"


def moves(path: Path) -> list[str]:
    """All moves of a path."""
    return [move(here, cut) for here, cut, _ in path.walk()]


def comment(text: str) -> str:
    """A comment that every control and sender lets pass, of one line.

    >>> comment("wheel (2): 3 mm × 5"), comment("logopen,file")
    ('(wheel [2]: 3 mm x 5)', "('logopen,file)")
    """
    return f"({next(iter(comment_lines(text, LINUXCNC_ACTIVE, UNSAFE, width=GRBL_COMMENT_WIDTH)), '')})"


def title(job: CutJob) -> list[str]:
    """What is cut, of what, with which kerf, and where the zero is."""
    return [
        comment(f"{job.name}: {job.process.words}"),
        comment(f"{job.material} {job.thickness:g} mm, kerf {job.kerf.width:g} mm"),
        comment(f"X0 Y0: lower left corner of the sheet {job.size[0]:g} x {job.size[1]:g}"),
    ]
