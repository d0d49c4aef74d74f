"""Output folders, and the pages and pictures that stand in them."""
