"""What the core itself registers."""

from mechwright.contracts.plugin import Plugin
from mechwright.designs.fits_table import FitsTable
from mechwright.machine.inspection import MachineDrive
from mechwright.machine.page import DrivePage
from mechwright.machine.stack_inspection import AxialStacks
from mechwright.machine.stacks_page import StacksPage
from mechwright.machine.table import MachineTable
from mechwright.pipeline.as_made import RunningAsMade
from mechwright.pipeline.file_names import FileNames
from mechwright.pipeline.fits import DeclaredFits
from mechwright.pipeline.process import ChosenProcesses, ProcessTable
from mechwright.pipeline.tables import MotionTables
from mechwright.pipeline.tolerances import ToleranceKeys, TolerancePage, TolerancesTable
from mechwright.plugins.hookspecs import hookimpl


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The pages that need no other room, what checks file names, and the tables of the core."""
    return [
        FileNames,
        MotionTables,
        ProcessTable,
        ChosenProcesses,
        RunningAsMade,
        FitsTable,
        DeclaredFits,
        TolerancesTable,
        ToleranceKeys,
        TolerancePage,
        MachineTable,
        MachineDrive,
        DrivePage,
        AxialStacks,
        StacksPage,
    ]
