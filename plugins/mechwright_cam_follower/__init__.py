"""Disc cams and their followers."""
