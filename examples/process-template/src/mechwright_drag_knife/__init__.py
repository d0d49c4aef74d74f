"""A drag knife as a process of Mechwright."""
