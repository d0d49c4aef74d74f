"""The extension spring that holds a follower on its cam: where it hooks, and which one it is."""
