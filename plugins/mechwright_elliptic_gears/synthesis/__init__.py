"""Trains for a requirement."""
