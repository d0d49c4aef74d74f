"""All four-bars whose coupler point passes through nine points."""
