"""Drawings that cutting services take, a checker of their rules, and the order sheet."""
