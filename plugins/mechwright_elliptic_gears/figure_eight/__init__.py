"""The page on which phase and eccentricity of a train are turned, and its speed and tables follow."""
