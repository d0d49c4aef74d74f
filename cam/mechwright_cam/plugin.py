"""What the CAM room registers: controls, the table ``[cam]``, rules, pages, and the inspection of cutters."""

from mechwright.contracts.plugin import Plugin
from mechwright.plugins.hookspecs import hookimpl


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """Imports what it gives only now: a module of plugins stays light."""
    from mechwright_cam.controls.fanuc import Fanuc
    from mechwright_cam.controls.grbl import Grbl
    from mechwright_cam.controls.haas import Haas
    from mechwright_cam.controls.heidenhain_tnc import HeidenhainTnc
    from mechwright_cam.controls.linuxcnc import LinuxCnc
    from mechwright_cam.controls.mach3 import Mach3
    from mechwright_cam.controls.siemens_840d import Siemens840D
    from mechwright_cam.inspection import InHand, Machinable, OpenWalls, Proven
    from mechwright_cam.pages.as_made import AsMadeFiles
    from mechwright_cam.pages.blanks import MilledPlates
    from mechwright_cam.pages.certificate import Certificates
    from mechwright_cam.pages.registered import DrawingFiles, JobPages, ProgramFiles, ProofFile, SetupSheets
    from mechwright_cam.process import Milling
    from mechwright_cam.proof.rules import BUILT_IN
    from mechwright_cam.results import Minutes, Programs
    from mechwright_cam.shop.shop_table import ShopTable
    from mechwright_cam.shop.table import CamTable

    controls = [LinuxCnc, Fanuc, Haas, Mach3, Grbl, Siemens840D, HeidenhainTnc]
    pages = [DrawingFiles, ProgramFiles, ProofFile, SetupSheets, JobPages, Certificates, AsMadeFiles]
    return [
        *controls,
        *BUILT_IN,
        ShopTable,
        CamTable,
        *pages,
        MilledPlates,
        Milling,
        Machinable,
        InHand,
        Proven,
        OpenWalls,
        Programs,
        Minutes,
    ]
