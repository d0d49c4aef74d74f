"""A saw list for Mechwright."""
