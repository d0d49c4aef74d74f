"""The contracts: what a plugin gives and what it is given."""
