"""Positions, contact, forces and figures of a cam and its follower."""
