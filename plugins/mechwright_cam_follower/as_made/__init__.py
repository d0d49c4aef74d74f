"""How the follower moves with parts as their programs leave them."""
