"""Sheets of drawings, written as DXF and as PDF.

Glossary
--------
sheet
    The paper: mm from its lower left corner. A view stands on it in the sheet's scale.
"""
