"""One small part finished with cutter compensation, for each control that has it and both ways of using D:
``python tests/cam/golden_compensation.py`` writes ``tests/golden/compensation/WAY-CONTROL.nc`` anew.

Every text has been read line by line as a machinist would before it was kept; read it again when it changes.
"""

from functools import cache
from pathlib import Path

from planning_parts import LIBRARY, bore, part

from mechwright.geometry import Loop
from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import Machined, machine
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.settings import CamSettings

FOLDER = Path(__file__).parents[1] / "golden" / "compensation"
CONTROLS = ("linuxcnc", "fanuc", "haas", "mach3")
WAYS = ("control", "wear")

CORNERED = Loop.polygon([(-16, -12), (16, -12), (16, 12), (6, 12), (6, 4), (-16, 4)])
"""Sharp corners outside and one inside."""


@cache
def made(way: str, control: str) -> Machined:
    """The proven program: a bore, and an outside held by the bore."""
    settings = {
        "control": control,
        "compensation": way,
        "tools": ("mill-4",),
        "hold": {"method": "bore", "clamp_diameter": 6, "clamp_height": 8},
    }
    plate = part(CORNERED, bore(10.0, (0.0, -4.0)), thickness=3.0)
    job = make_job(plate, CamSettings.model_validate(settings), [LIBRARY.get("mill-4")])
    return machine(job, host().get(Control, control))


def texts() -> dict[str, str]:
    """File name to text of everything that is kept."""
    return {f"{way}-{control}.nc": made(way, control).text for way in WAYS for control in CONTROLS}


if __name__ == "__main__":
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, text in texts().items():
        (FOLDER / name).write_text(text, encoding="ascii")
