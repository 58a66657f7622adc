"""Draws a picture with plotly."""

import math

import numpy as np

from .picture import Area, Cells, Label, Line, Marks, Span
from .style import GRID, INK

DASHES = {"solid": "solid", "dash": "6px,3px", "dot": "2px,3px"}
PIXELS = 96     # per inch
POINT = 96 / 72  # pixels


def draw(picture):
    """A plotly Figure."""
    try:
        import plotly.graph_objects as go
    except ImportError as error:
        raise ImportError("figures need the package plotly: apt install python3-plotly, or pip install plotly; "
                          "backend=\"matplotlib\" does without it") from error
    figure = go.Figure()
    left = picture.left
    figure.update_layout(width=PIXELS * picture.width, height=PIXELS * picture.height, margin=dict(l=0, r=0, t=0, b=0),
                         paper_bgcolor="#fff", plot_bgcolor="#fff", hovermode="closest",
                         font=dict(family="system-ui, DejaVu Sans, sans-serif", size=9 * POINT, color=INK),
                         legend=_legend_place(picture, left))
    texts = []  # all at once: plotly copies those that it has for each one that is added
    if picture.title:
        texts.append(dict(x=left, y=1 - 0.1 / picture.height, xref="paper", yref="paper", xanchor="left", yanchor="top",
                          text=plain(picture.title), showarrow=False, font=dict(size=picture.title_size * POINT)))
    for number, panel in enumerate(picture.panels):
        texts += _draw_panel(figure, go, panel, "" if number == 0 else str(number + 1))
    figure.layout.annotations = texts
    for item in picture.legend:
        figure.add_trace(go.Scatter(x=[None], y=[None], name=plain(item.legend), showlegend=True, hoverinfo="skip", **_style(item)))
    return figure


def _legend_place(picture, left):
    place = dict(xanchor="left", yanchor="top", font=dict(size=8 * POINT), bgcolor="rgba(255,255,255,0)", itemclick=False,
                 itemdoubleclick=False)
    if not picture.legend_right:
        return dict(place, orientation="h", x=left, y=1 - (0.3 if picture.title else 0.05) / picture.height)
    panel = picture.panels[0]
    return dict(place, x=panel.left + panel.width + 0.1 / picture.width, y=panel.bottom + panel.height)


def plain(text):
    """A text in which plotly finds no markup."""
    return str(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def _draw_panel(figure, go, panel, suffix):
    """Draws all but the texts, and returns these."""
    common = dict(gridcolor=GRID, zeroline=False, linecolor="#555", showline=panel.frame, ticks="outside" if panel.frame else "",
                  ticklen=4, tickcolor="#555", exponentformat="power", minexponent=4, showgrid=panel.frame, visible=panel.frame)
    for which, axis, start, length in (("x", panel.x, panel.left, panel.width), ("y", panel.y, panel.bottom, panel.height)):
        ends = [math.log10(axis.low), math.log10(axis.high)] if axis.log else [axis.low, axis.high]
        figure.layout[f"{which}axis{suffix}"] = dict(
            common, domain=[start, start + length], range=ends, type="log" if axis.log else "linear",
            anchor=f"{'y' if which == 'x' else 'x'}{suffix}", title=dict(text=plain(axis.title), standoff=8),
            showticklabels=axis.shown, **_ticks(axis))
    axes = dict(xaxis=f"x{suffix}", yaxis=f"y{suffix}")
    for item in sorted(panel.items, key=lambda item: isinstance(item, Marks)):  # marks lie on lines
        if not isinstance(item, Label):
            _DRAWN[type(item)](figure, go, item, axes, panel)
    return [_text(item, axes, panel) for item in panel.of(Label)]


def _ticks(axis):
    if axis.ticks is not None:
        return dict(tickvals=[place for place, _ in axis.ticks], ticktext=[plain(text) for _, text in axis.ticks])
    if axis.log and axis.high < 500 * axis.low:
        return dict(dtick="D2")
    return dict(dtick=max(1, round(math.log10(axis.high / axis.low) / 7))) if axis.log else {}


def _hover(panel, name):
    if not name:
        return dict(hoverinfo="skip")
    x, y = plain(panel.x.title or "x"), plain(panel.y.title)
    return dict(hovertemplate=f"{x}: %{{x:.6g}}<br>{y}: %{{y:.6g}}<extra>{plain(name)}</extra>")


def _style(item):
    """How a trace looks that shows an item, or its entry in the legend."""
    if isinstance(item, Line):
        return dict(mode="lines", line=dict(color=item.colour, width=item.width * POINT, dash=DASHES[item.dash], simplify=False))
    if isinstance(item, Marks):
        width, edge = (1.7, item.colour) if "-open" in item.symbol else (0.5, "#fff")
        marker = dict(symbol=item.symbol, color=item.colour, size=item.size * POINT, line=dict(width=width, color=edge))
        line = dict(color=item.colour, dash=DASHES[item.legend_line or "solid"])
        return dict(mode="lines+markers" if item.legend_line else "markers", marker=marker, line=line)
    faded = f"rgba({','.join(str(int(item.colour[i:i + 2], 16)) for i in (1, 3, 5))},{item.opacity:g})"
    if not len(getattr(item, "x", ())):
        return dict(mode="markers", marker=dict(symbol="square", size=11, color=faded, line=dict(width=0)))
    return dict(mode="lines", fill="toself", line=dict(width=0), fillcolor=faded)


def _draw_trace(figure, go, item, axes, panel):
    """A line, marks, or an area."""
    clip = item.clip if isinstance(item, Line) else not isinstance(item, Marks)
    hover = _hover(panel, "" if isinstance(item, Area) else item.name)
    figure.add_trace(go.Scatter(x=item.x, y=item.y, name=item.name, showlegend=False, text=getattr(item, "texts", None),
                                cliponaxis=clip, **_style(item), **hover, **axes))


def _draw_span(figure, go, item, axes, panel):
    figure.add_shape(type="rect", x0=item.low, x1=item.high, y0=0, y1=1, xref=axes["xaxis"], yref=f"{axes['yaxis']} domain",
                     fillcolor=item.colour, opacity=item.opacity, line=dict(width=0), layer="below")


def _text(item, axes, panel):
    x, xref = _reference(panel.x, item.x, axes["xaxis"], panel.left, panel.width)
    y, yref = _reference(panel.y, item.y, axes["yaxis"], panel.bottom, panel.height)
    return dict(x=x, y=y, xref=xref, yref=yref, text=plain(item.text), showarrow=False,
                font=dict(color=item.colour, size=item.size * POINT), xanchor=item.align, yanchor="middle",
                xshift=item.dx * POINT, yshift=item.dy * POINT, borderpad=0,
                bgcolor="rgba(255,255,255,0.85)" if item.boxed else "rgba(255,255,255,0)")


def _reference(axis, value, name, start, length):
    """A coordinate and what it refers to: plotly hides texts that refer to an axis beyond its ends."""
    share = float(axis.share(value))
    if not -1e-9 <= share <= 1 + 1e-9:
        return start + share * length, "paper"
    return (math.log10(value) if axis.log else value), name


def _draw_cells(figure, go, item, axes, panel):
    n = len(item.colours)
    scale = [[(i + side) / n, colour] for i, colour in enumerate(item.colours) for side in (0, 1)]
    names = np.asarray(item.names, object)[np.asarray(item.kind)]
    figure.add_trace(go.Heatmap(x=item.x, y=item.y, z=np.asarray(item.kind), zmin=-0.5, zmax=n - 0.5, colorscale=scale,
                                showscale=False, text=[[plain(name) for name in row] for row in names],
                                hovertemplate="%{x:.6g}, %{y:.6g}: %{text}<extra></extra>", **axes))


_DRAWN = {Line: _draw_trace, Marks: _draw_trace, Area: _draw_trace, Span: _draw_span, Cells: _draw_cells}
