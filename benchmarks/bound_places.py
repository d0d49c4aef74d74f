"""Places and numbers that the programs for bench_bounds.py share."""

import random

MANY = 100_000
RNG = random.Random(1)


def places(count: int) -> list[str]:
    return [f"X{RNG.uniform(-25, 25):.3f} Y{RNG.uniform(-20, 20):.3f}" for _ in range(count)]


def inside(half: float) -> str:
    return f"X{RNG.uniform(-half, half):.3f} Y{RNG.uniform(-half, half):.3f}"
