"""A frame that cannot be had for a size, mm, or for a choice."""

from mechwright.contracts.finding import Change, Finding, Stage


def fault(
    code: str,
    key: str,
    said: str,
    value: float | None = None,
    limit: float | None = None,
    remedy: str = "",
    proposed: tuple[Change, ...] = (),
) -> Finding:
    """An error of the parts; ``value`` and ``limit`` are lengths, mm, where there are any."""
    unit = "" if value is None else "mm"
    return Finding.error(code, key, said, value, limit, unit, remedy, Stage.PARTS, proposed)
