"""Drawings of turned parts: one sheet of lines, texts and dimensions, written as DXF and as PDF.

Glossary
--------
label
    The diameter of a step with its fit, on a line that goes up from the step.
base line
    The lower end of the part, on the left of the view: lengths are measured from it, as on the lathe.
"""
