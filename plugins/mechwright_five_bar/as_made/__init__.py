"""What plates as made do, and what tolerances do."""
