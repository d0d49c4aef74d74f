"""From what a slider-crank is asked for to designs: a room for each kind of requirement."""
