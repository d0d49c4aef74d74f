"""Motion, figures, and the pair as a stage of a chain."""
