"""The report on a program from anywhere, as a page."""
