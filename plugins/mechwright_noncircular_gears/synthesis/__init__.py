"""Laws fitted to what a person wants of the driven shaft."""
