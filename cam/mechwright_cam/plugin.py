"""What the CAM room registers: controls, the table ``[cam]``, pages, and the inspection of cutters."""

from mechwright.contracts.plugin import Plugin
from mechwright.plugins.hookspecs import hookimpl


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """Imports what it gives only now: a module of plugins stays light."""
    from mechwright_cam.controls import FanucPost, GrblPost, HaasPost, LinuxCncPost, Mach3Post
    from mechwright_cam.inspection import Machinable
    from mechwright_cam.pages.registered import DrawingFiles, ProgramFiles, ProofFile, SetupSheets
    from mechwright_cam.shop.table import CamTable

    controls = [LinuxCncPost, FanucPost, HaasPost, Mach3Post, GrblPost]
    return [*controls, CamTable, DrawingFiles, ProgramFiles, ProofFile, SetupSheets, Machinable]
