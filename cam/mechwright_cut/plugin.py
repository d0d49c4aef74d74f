"""What the room registers: processes, the table ``[cut]``, inspections, pages."""

from mechwright.contracts.plugin import Plugin
from mechwright.plugins.hookspecs import hookimpl


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """Imports what it gives only now: a module of plugins stays light."""
    from mechwright_cut.inspection import Cuttable, ProvenCuts
    from mechwright_cut.pages.blanks import CutBlanks
    from mechwright_cut.pages.registered import CutPrograms, CutSheets
    from mechwright_cut.processes import Laser, Plasma, Service, Waterjet, Wire
    from mechwright_cut.settings.cut_table import CutTable

    processes = [Laser, Waterjet, Plasma, Wire, Service]
    return [CutTable, *processes, Cuttable, ProvenCuts, CutPrograms, CutSheets, CutBlanks]
