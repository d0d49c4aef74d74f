"""``python -m mechwright``."""

from mechwright.cli import main

main()
