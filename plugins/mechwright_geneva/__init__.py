"""The family ``geneva``: Geneva mechanisms with straight or curved slots."""
