"""Teeth, plates, joints, hardware, mounting."""
