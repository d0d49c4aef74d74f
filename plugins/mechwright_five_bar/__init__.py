"""Family five-bar: a crank, an arm geared to it, and two links between, with synthesis of paths in phases."""
