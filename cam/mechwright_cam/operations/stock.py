"""What still stands where a task cuts: a value, of which every cut makes the next one."""

from dataclasses import dataclass, field, replace

import shapely

from mechwright_cam.setup.job import Air, air_below


@dataclass(frozen=True, eq=False)
class Stock:
    """The stock of one task, or of one layer of it; shapes in work coordinates, mm."""

    left: shapely.Geometry = field(default_factory=shapely.Polygon)
    """What has to go, seen from above; once a wall is roughed, the allowance in front of it."""
    gone: tuple[Air, ...] = ()
    """What earlier setups have cut from the other side."""
    over: float = 0.0
    """By how much more than the cutters reached may be missing in ``left``, mm."""
    begun: bool = False
    """Whether an end mill has been in it."""
    ridges: shapely.Geometry = field(default_factory=shapely.Polygon)
    """Where round mills have cleared all but the floor: fillets at its edge, cusps between their cuts."""
    ridge_height: float = 0.0
    """Height of the ridges above the floor, mm."""
    fillet: float = 0.0
    """Height of what round mills have left at the foot of a wall that goes on below, mm."""
    waste: shapely.Geometry = field(default_factory=shapely.Polygon)
    """What of ``left`` need not go: it stays with the frame."""

    @property
    def remaining_area(self) -> shapely.Geometry:
        """Where a cutter that goes down to the floor meets stock."""
        return self.left if shapely.is_empty(self.ridges) else shapely.union(self.left, self.ridges)

    def without(self, cut: shapely.Geometry) -> "Stock":
        """What is left after a region has been cut."""
        return replace(self, left=shapely.difference(self.left, cut))

    def with_ridges(self, where: shapely.Geometry, height: float) -> "Stock":
        """The same with what a round mill has left standing on the floor."""
        return replace(self, ridges=where, ridge_height=max(self.ridge_height, height))

    def air_below(self, z: float) -> shapely.Geometry:
        """Where nothing stands below a height z, mm; for 0, where earlier setups have cut through."""
        return air_below(self.gone, z)


def combined_stock(stocks: list[Stock]) -> Stock:
    """The stock of several layers of one recess, as seen from above."""
    left, *others = dict.fromkeys(stock.left for stock in stocks)
    left = shapely.union_all([left, *others]) if others else left
    return replace(stocks[-1], left=left, over=max(stock.over for stock in stocks))
