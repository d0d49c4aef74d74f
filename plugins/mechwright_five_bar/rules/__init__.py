"""What an engineer objects to."""
