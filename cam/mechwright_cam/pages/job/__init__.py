"""The page on which a program is played on its stock: tool, path, stock, text and what the proof has found.

Glossary
--------
step
    A step of the run, as the proof has it. The page holds all of them, and shows the tool where the proof has
    it.
relief
    The stock on a grid of heights, lowered along the path as the proof's simulation does, on wider cells.
mark
    A place that one can jump to: what the proof found, plunges, tabs, the way past a clamp.
"""

JOB = ".job.html"
"""What the page of a program is named behind the program's name."""
