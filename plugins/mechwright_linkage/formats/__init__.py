"""Linkages that other programs have drawn, read as drawn linkages."""
