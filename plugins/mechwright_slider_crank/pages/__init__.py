"""Pages of a slider-crank: its construction with the auxiliary circle, and its acceleration poles."""
