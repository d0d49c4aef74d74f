"""What the CAD room registers: exporters, solids, the page of the motion, and what collides."""

from mechwright.contracts.plugin import Plugin
from mechwright.plugins.hookspecs import hookimpl
from mechwright_cad.assembly_guide.page import AssemblyGuide
from mechwright_cad.assembly_order.inspections import AssemblyOrder
from mechwright_cad.bill.inspections import SoldPlates
from mechwright_cad.bill.page import BillOfMaterials
from mechwright_cad.contacts.inspections import Contact, ScrewLengths
from mechwright_cad.exporters import (
    DxfExporter,
    GlbExporter,
    MjcfExporter,
    SdfExporter,
    StepExporter,
    StlExporter,
    ThreeMfExporter,
    UrdfExporter,
)
from mechwright_cad.exporters.simulation.settings import SimulationTable
from mechwright_cad.form_drawing.page import FormDrawings
from mechwright_cad.pages import Interference, MotionPage, SolidFiles
from mechwright_cad.plate_drawing.page import PlateDrawings
from mechwright_cad.results import Assembled, PartPicture, PartSolid
from mechwright_cad.sheet.settings import DrawingTable
from mechwright_cad.turned_drawing.page import TurnedDrawings


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The file formats, the pages, and the inspection."""
    return [
        StepExporter,
        DxfExporter,
        StlExporter,
        ThreeMfExporter,
        GlbExporter,
        MjcfExporter,
        UrdfExporter,
        SdfExporter,
        SolidFiles,
        MotionPage,
        BillOfMaterials,
        SoldPlates,
        DrawingTable,
        SimulationTable,
        PlateDrawings,
        TurnedDrawings,
        FormDrawings,
        AssemblyGuide,
        Interference,
        ScrewLengths,
        Contact,
        AssemblyOrder,
        PartSolid,
        PartPicture,
        Assembled,
    ]
