"""Laws of a pair: each file makes one kind of :class:`mechwright.mechanics.gearing.RatioLaw`."""
