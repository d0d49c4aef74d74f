"""The mechanism with parts as their programs leave them."""
