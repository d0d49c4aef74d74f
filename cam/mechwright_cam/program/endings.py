"""What names of files end with that stand beside a program."""

CERTIFICATE = ".certificate.json"
"""Of a program's certificate."""
