"""Tool libraries of other programs, one file for each format; see :mod:`.contract` and :mod:`.known`."""
