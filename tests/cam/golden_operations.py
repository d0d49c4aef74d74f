"""The programs of one small part for each operation, on each control: ``python tests/cam/golden_operations.py``
writes ``tests/golden/operations/OPERATION/CONTROL.nc`` anew, or those of the operations named after it.

Every text has been read line by line as a machinist would before it was kept; read it again when it changes.
"""

import sys
from functools import cache
from pathlib import Path

from golden_case import MORE
from golden_cases import CASES

from mechwright.contracts.finding import errors
from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import Machined, machine, second_setup
from mechwright_cam.planning.setups import lay_out_setups
from mechwright_cam.shop.settings import CamSettings

FOLDER = Path(__file__).parents[1] / "golden" / "operations"


@cache
def made(operation: str, control: str, units: str = "") -> tuple[Machined, ...]:
    """The proven programs of an operation's part: one, or two where it has a second side.

    They are in the units of the case, unless others are named.
    """
    case, post = CASES[operation], host().get(Control, control)
    plain = {"control": control, "tools": case.tools, "floor_to_leave": 0}
    cam = CamSettings.model_validate({**plain, **case.settings})
    if units:
        cam = cam.model_copy(update={"post": cam.post.model_copy(update={"units": units})})
    post = post.speaking(cam.post.units or "mm")
    jobs, found = lay_out_setups(case.part(operation), cam, MORE)
    if errors(found):
        raise AssertionError(f"{operation}: {errors(found)[0]}")
    done: list[Machined] = []
    for place, job in enumerate(jobs):
        done.append(machine(job if job.side == "top" else second_setup(done[-1], job), post, place))
    return tuple(done)


def texts(operation: str, control: str) -> dict[str, str]:
    """File name to text of an operation's programs on a control."""
    kept = {}
    for place, one in enumerate(made(operation, control)):
        start = f"{control}{'-underside' if place else ''}"
        for stem, text in one.files.items():
            name = one.program.name
            kept[start + (stem.removeprefix(name) if stem.startswith(name) else "") + ".nc"] = text
    return kept


def keep(operation: str) -> None:
    """Write the kept texts of an operation, and take away those that nothing writes."""
    here = FOLDER / operation
    here.mkdir(parents=True, exist_ok=True)
    written = {
        name: text
        for control in CASES[operation].controls
        for name, text in texts(operation, control).items()
    }
    for old in here.glob("*.nc"):
        if old.name not in written:
            old.unlink()
    for name, text in written.items():
        (here / name).write_text(text, encoding="ascii")


if __name__ == "__main__":
    for operation in sys.argv[1:] or CASES:
        keep(operation)
