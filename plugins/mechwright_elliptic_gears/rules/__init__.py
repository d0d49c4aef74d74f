"""What an engineer objects to, a file for each concern."""
