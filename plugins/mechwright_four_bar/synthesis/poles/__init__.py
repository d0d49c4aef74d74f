"""Four-bars whose coupler has its acceleration pole in prescribed places."""
