"""Compiled rates of a coupler point, for kernels that go through many linkages."""

from mechwright.mechanics.compiled import compiled

Rates = tuple[float, float, float, float, float, float]


@compiled
def point_rates(
    x: float,
    y: float,
    qx: float,
    qy: float,
    crank: tuple[float, float, float],
    coupler: tuple[float, float, float],
) -> Rates:
    """Velocity, acceleration and jerk of a coupler point, x and y of each, mm/s, mm/s² and mm/s³.

    The point stands at p + q: p is the crank (``x``, ``y``), q the way from the crank's pin to the point, mm.
    ``crank`` and ``coupler`` are their angular velocity w, acceleration g and jerk j, in rad and s; each adds

        w i p,    (i g - w²) p,    (i (j - w³) - 3 w g) p

    to the rates, as complex numbers.
    """
    w, g, j = crank
    v, h, k = coupler
    m, n = j - w**3, k - v**3
    return (
        -w * y - v * qy,
        w * x + v * qx,
        -g * y - w * w * x - h * qy - v * v * qx,
        g * x - w * w * y + h * qx - v * v * qy,
        -m * y - 3 * w * g * x - n * qy - 3 * v * h * qx,
        m * x - 3 * w * g * y + n * qx - 3 * v * h * qy,
    )
