"""What an engineer objects to in a spherical linkage."""
