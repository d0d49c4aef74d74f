"""Curves that a point of a linkage draws, led through prescribed points within limits.

Glossary
--------
unknowns
    What a linkage is made of, (..., k), of the order of 1: logarithms of lengths, angles, places.
angles
    Of the crank at the points, (..., n), rad. They are eliminated point by point and go one way.
room
    Unknowns of one branch and one sense of the crank: what cannot change into each other.
"""
