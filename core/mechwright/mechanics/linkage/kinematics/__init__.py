"""Motion, forces and figures."""
