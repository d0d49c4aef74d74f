"""The Larch 300 control for Mechwright."""
