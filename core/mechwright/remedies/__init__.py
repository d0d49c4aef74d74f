"""Remedies: changes of a design file that were tried before anybody is told of them.

Glossary
--------
change
    Dotted keys of the design file to new values (:data:`mechwright.contracts.finding.Change`).
bench
    A design with a judge, where changes are tried and counted.
judge
    What finds things about a design: its family, or inspections besides.
step
    A change of one key, or of those proposed together, that does something against one finding.
nearest
    The smallest change found with which the design builds.

A finding's ``fix`` is sought in this order: what the finding proposes; values along the keys that it names,
from the present one outwards; the nearest design that builds. A search ends after so many tries
(:class:`Limits`).
"""

from mechwright.remedies.bench import Bench, Limits, of_family
from mechwright.remedies.nearest import MOST_CHANGES, nearest
from mechwright.remedies.remedied import proposed_tried, remedied, tried, with_remedies
from mechwright.remedies.repair import Repair, repaired

__all__ = [
    "MOST_CHANGES",
    "Bench",
    "Limits",
    "Repair",
    "nearest",
    "of_family",
    "proposed_tried",
    "remedied",
    "repaired",
    "tried",
    "with_remedies",
]
