"""In which order a mechanism can be put together: who goes on whom, and which way.

Glossary
--------
way
    A unit vector of the assembly along which a body leaves its seat in a straight line.
layer
    What a body is between two planes across a way: its shadow along it, and where it begins and ends.
barred
    A body bars another's way if the other would meet it, wherever along its way that is.
group
    Bodies that are put together first, and then go to their place as one.
step
    One or more bodies that go to their seat, or a group that does.
"""
