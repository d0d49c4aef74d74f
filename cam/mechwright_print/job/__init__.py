"""What is printed of a design: parts, holes, places on the bed, filament."""
