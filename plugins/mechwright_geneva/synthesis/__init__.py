"""Finding mechanisms for a requirement."""
