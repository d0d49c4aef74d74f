"""What an engineer objects to in a cam and its follower."""
