"""Controls: how each writes programs, reads them, and what it keeps of tools and work offsets."""
