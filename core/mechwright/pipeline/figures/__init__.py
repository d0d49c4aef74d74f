"""A page of figures with captions and tables, one file without network or script; made with jinja2."""

from mechwright.pipeline.figures.page import Figure, Grid, figures_page

__all__ = ["Figure", "Grid", "figures_page"]
