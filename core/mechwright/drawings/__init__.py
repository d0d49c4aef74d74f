"""DXF drawings of plates, read: what anybody's program writes becomes contours, and those a part.

Glossary
--------
stroke
    One curve as it is drawn: the segments of a line, an arc, a polyline, a spline.
contour
    A closed loop that strokes make together.
meaning
    What a layer says of its contours: an outline, an opening, a pocket and its depth, a thread.
fault
    What keeps a drawing from being a part, with the place; nothing is guessed instead.
"""
