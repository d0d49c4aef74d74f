"""Burmester: linkages that guide a body through poses, and those whose follower answers the crank."""
