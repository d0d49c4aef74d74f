"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_bill.page import Bill


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The page."""
    return [Bill]
