"""What the core itself registers."""

from mechwright.build.tables import MotionTables
from mechwright.build.tolerances import ToleranceKeys, TolerancePage, TolerancesTable
from mechwright.contracts.plugin import Plugin
from mechwright.plugins.hookspecs import hookimpl


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The pages that need no other room, and the table ``[tolerances]``."""
    return [MotionTables, TolerancesTable, ToleranceKeys, TolerancePage]
