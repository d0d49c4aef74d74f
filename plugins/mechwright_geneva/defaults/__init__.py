"""What a design leaves open."""
