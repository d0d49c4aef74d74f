"""Parts that are cut through a sheet by a beam, a jet, an arc or a wire; and orders for a cutting service.

Glossary
--------
kerf
    Width of the slot that a beam, jet, arc or wire leaves, mm.
contour
    One closed cut, with its way in and out.
slug
    What falls out of an opening.
piece
    One copy of a part on the sheet.
pierce
    The place where the beam goes through before it moves.
"""
