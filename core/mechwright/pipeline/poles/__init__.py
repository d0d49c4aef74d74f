"""The page of acceleration poles: their loci on the ground and in the coupler, and the circles."""

from mechwright.pipeline.poles.coupler import Coupler
from mechwright.pipeline.poles.page import NAME, PolesPage

__all__ = ["NAME", "Coupler", "PolesPage"]
