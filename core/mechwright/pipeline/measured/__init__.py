"""Parts as measured: which limits hold, what the next piece takes, which parts go together, how they run."""
