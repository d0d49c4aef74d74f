"""Screws that clamp: socket heads of common threads."""

SCREWS = {
    2.0: (0.4, 3.8, 2.0, 2.4),
    2.5: (0.45, 4.5, 2.5, 2.9),
    3.0: (0.5, 5.5, 3.0, 3.4),
    4.0: (0.7, 7.0, 4.0, 4.5),
    5.0: (0.8, 8.5, 5.0, 5.5),
    6.0: (1.0, 10.0, 6.0, 6.6),
    8.0: (1.25, 13.0, 8.0, 9.0),
    10.0: (1.5, 16.0, 10.0, 11.0),
}
"""Thread to pitch (ISO 261), head diameter and height (ISO 4762), clearance hole (ISO 273, medium), mm."""
