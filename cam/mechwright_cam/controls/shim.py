"""Interim."""

from mechwright_cam.controls.contract import Post
from mechwright_cam.controls.reading import DIALECTS, Dialect


def dialect_of(post: Post) -> Dialect:
    return DIALECTS[post.dialect]
