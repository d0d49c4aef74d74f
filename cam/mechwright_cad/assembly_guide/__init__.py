"""How the mechanism is put together: steps with pictures, the exploded view, and the drawing of the assembly.

Glossary
--------
scene
    Bodies, each with a shift, mm, from where it stands in the finished mechanism.
trace
    The line along which a body goes to its seat.
balloon
    The number of an item in a ring, with a leader to the item (ISO 6433).
"""
