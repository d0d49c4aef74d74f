"""Whether the clearances of a design leave room for what its programs leave on the walls."""

from collections.abc import Iterator

from mechwright import Finding, Severity, Stage, of_stage
from mechwright.tolerances import falls_short
from mechwright_geneva.assembly import BINDING, LEAST_GROOVE, LEAST_LOCK
from mechwright_geneva.params import GenevaParams


@of_stage(Stage.MACHINING)
def clearance_findings(params: GenevaParams) -> Iterator[Finding]:
    """Slot and lock: an error where walls as planned bind, a warning where walls within tolerance may."""
    for parameter, least, what in (
        ("groove_clearance", LEAST_GROOVE, "the roller binds in its slot"),
        ("lock_clearance", LEAST_LOCK, "the locking disc seizes in the wheel"),
    ):
        given = getattr(params, parameter)
        if not falls_short(given, least):
            continue
        binds = given < BINDING
        does = what if binds else what.replace("binds", "may bind").replace("seizes", "may seize")
        takes = "walls as they are planned" if binds else "walls and axes within tolerance"
        yield Finding(
            "geneva.clearance",
            Severity.ERROR if binds else Severity.WARNING,
            parameter,
            f"as made {does}: {takes} take up to {BINDING if binds else least:g} mm of the clearance",
            given,
            least,
            "mm",
            f"make {parameter} at least {least:g}",
        )
