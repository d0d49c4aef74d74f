"""What the room of printing registers: the table ``[print]``, the process, rules, files, and stock."""

from mechwright.contracts.plugin import Plugin
from mechwright.plugins.hookspecs import hookimpl


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """Imports what it gives only now: a module of plugins stays light."""
    from mechwright_print.pages.files import PrintFiles
    from mechwright_print.pages.raw_stock import PrintStock
    from mechwright_print.process import Printing
    from mechwright_print.rules.inspection import Printable
    from mechwright_print.table import PrintTable

    return [PrintTable, Printing, Printable, PrintFiles, PrintStock]
