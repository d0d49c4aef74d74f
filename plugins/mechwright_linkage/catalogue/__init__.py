"""Linkages that have names, each with its dimensions."""
