"""Output folders, and pictures that stand in them."""
