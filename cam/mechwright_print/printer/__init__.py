"""The printer: its bed, its nozzle, how far its sizes are off, and what that follows from."""
