"""Chains: mechanisms of which each turns the next, as a family of its own.

Glossary
--------
stage
    One mechanism of a chain, counted from 1.
name of a stage's thing
    The number before it: part and body ``2-wheel``, channel ``2.theta_w``.
"""

from mechwright.mechanics.chain.family import Chain
from mechwright.mechanics.chain.params import ChainParams, Families, StageTable

__all__ = ["Chain", "ChainParams", "Families", "StageTable"]
