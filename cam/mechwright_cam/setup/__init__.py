"""A part in its stock: origin, holding, sides."""
