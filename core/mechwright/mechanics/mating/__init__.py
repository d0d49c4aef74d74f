"""How the round faces of an assembly go into each other: which pin is in which hole, and with what fit."""
