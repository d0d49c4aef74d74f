"""What a printer cannot make of a design."""
