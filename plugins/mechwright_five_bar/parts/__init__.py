"""Outlines, plates, joints, hardware, mounting."""
