"""Output folders and the files of a motion."""
