"""Trochoidal slotting for Mechwright."""
