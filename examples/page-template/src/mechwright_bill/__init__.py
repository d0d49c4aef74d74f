"""A bill of materials for Mechwright."""
