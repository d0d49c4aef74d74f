"""How gears run as their programs leave them, and what tolerances do."""
