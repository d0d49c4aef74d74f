"""What controls share in writing programs."""
