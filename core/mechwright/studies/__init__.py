"""Many designs of one family: which of them can be, which are best, and files of those."""
