"""Family four-bar: crank, coupler, follower and ground, with synthesis from paths and acceleration poles."""
