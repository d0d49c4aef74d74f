"""A design in the browser: every parameter as a field, the mechanism redrawn as one changes it.

Glossary
--------
session
    The design file that a page shows, and the changes that a page has made to it and not saved.
change
    What the page says in place of the file (:data:`mechwright.contracts.finding.Change`).
answer
    What the page is given for a change: the motion, what the family finds, or remedies.
target
    A place that a requirement asks for, which a page lets one drag
    (:class:`~mechwright.contracts.target.Target`).
token
    A secret in the address; whoever does not know it gets nothing.
"""
