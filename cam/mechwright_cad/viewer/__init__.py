"""The viewer in three dimensions: what a page holds of bodies, and the scripts that draw them by WebGL 2.

Glossary
--------
form
    The triangles of one part in its own coordinates. Copies of a part share one form.
body
    One copy of a part where it stands, with the name of the poses that move it.
group
    Bodies that move as one. Fasteners are a group of their own.
shift
    By how much a body stands off its seat in the exploded view, mm, in the coordinates of the ground.
packed
    An array as text: its bytes, little end first, as base64. It is not compressed, so that a page reads it at
    once and its bytes do not depend on the version of a compressor.
"""

from pathlib import Path

VIEWER = Path(__file__).parent
"""The folder of its scripts and its style, which templates of pages take in."""

ANIMATION = VIEWER.parent / "animation"
"""The folder of the scripts that read a motion."""
