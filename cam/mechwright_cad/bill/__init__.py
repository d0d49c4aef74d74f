"""The bill of materials: what is made, what is bought, and what stock is sawn off for it."""
