"""How finely a motion is sampled where nobody says; it imports nothing, for the command line tells it."""

SAMPLES = 721
"""Of a motion, and of that whose figures are columns of a study: every half degree of one turn, both ends."""
