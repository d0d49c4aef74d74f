"""Bought parts and standard sizes: tables with the number of their standard, and how they are looked up.

Sizes are nominal, in mm; masses in g; loads in N; torques in N m. Each table stands in a file of its own in
``tables``, with its standard, where its numbers are from, and which of them nobody has checked: compare them
with the sheet of the maker you buy from. Shapes stand on z = 0 with their axis upright, a screw's and a
motor's bearing face lies in z = 0.
"""
