"""What the page says of taking a mechanism apart again."""

from collections.abc import Callable

from mechwright_cad.assembly_order.plan import Plan
from mechwright_cad.assembly_order.undo import bonded, locked


def undone(plan: Plan, name: Callable[[int], str]) -> list[str]:
    """Sentences on seats that do not come apart as they went together; none where all do."""
    order = plan.order
    found = [
        f"{name(one.pin)} cannot be driven out of {name(one.hole)}: its hole is blind and nothing stands out."
        for one in locked(order)
    ]
    found += [
        f"{name(one.pin)} in {name(one.hole)}: where retaining compound holds it, warm it before pulling."
        for one in bonded(order)
    ]
    return list(dict.fromkeys(found))
