"""What scripts ask for, and the command line with them: a mechanism opened, checked, written, sought."""
