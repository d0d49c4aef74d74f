"""The family of gears whose pitch curves follow from any law."""
