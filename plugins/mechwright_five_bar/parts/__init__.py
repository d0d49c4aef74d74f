"""Positions, rates, loads and figures of Geneva mechanisms, over tables of designs."""
