"""One table of words for each control: which code takes which words of its block."""
