"""Design and requirement files."""
