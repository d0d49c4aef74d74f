"""Plots of channels; imports plotly when it is asked for one."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from mechwright.arrays import Array
from mechwright.extras import optional

if TYPE_CHECKING:
    import plotly.graph_objects

ROW = 180
"""Height of one plot, pixels."""


def stacked(over: str, values: Array, columns: Mapping[str, Array]) -> "plotly.graph_objects.Figure":
    """Plots of ``columns``, title to values (n,), below each other over the ``values`` (n,) of ``over``.

    Raises PluginError where plotly is not installed.
    """
    graphs, subplots = optional("plotly.graph_objects"), optional("plotly.subplots")
    figure = subplots.make_subplots(rows=len(columns), cols=1, shared_xaxes=True, vertical_spacing=0.02)
    for row, (name, ordinates) in enumerate(columns.items(), start=1):
        figure.add_trace(graphs.Scatter(x=values, y=ordinates, name=name, mode="lines"), row=row, col=1)
        figure.update_yaxes(title_text=name, row=row, col=1)
    figure.update_xaxes(title_text=over, row=len(columns), col=1)
    figure.update_layout(height=ROW * len(columns) + 100, showlegend=False, margin={"t": 20})
    return figure
