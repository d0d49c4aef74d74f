"""The family ``plate``: plates from DXF drawings, of anybody's program."""
