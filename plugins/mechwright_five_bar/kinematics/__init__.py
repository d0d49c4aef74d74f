"""Positions, rates, loads and figures of five-bars, over tables of designs."""
