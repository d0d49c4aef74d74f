"""From what a four-bar is asked for to designs: a room for each kind of requirement."""
