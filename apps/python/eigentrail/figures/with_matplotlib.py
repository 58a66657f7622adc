"""Draws a picture with matplotlib."""

import io

import numpy as np

from .picture import Area, Cells, Label, Line, Marks, Span
from .style import GRID, INK

DASHES = {"solid": "solid", "dash": (0, (4, 2)), "dot": (0, (1.2, 1.8))}
SYMBOLS = {"circle": "o", "square": "s", "diamond": "D", "triangle-up": "^", "triangle-down": "v", "triangle-left": "<",
           "cross": "P", "x": "X", "star": "*", "pentagon": "p", "hexagram": (6, 1, 0), "hexagon": "h", "asterisk": (8, 2, 0),
           "bowtie": [(-1, -1), (-1, 1), (1, -1), (1, 1), (-1, -1)], "line-ew": "_", "line-ns": "|", "circle-open-dot": "o"}
STROKES = {"asterisk", "line-ew", "line-ns"}  # marks without an inside
LARGER = {"star": 1.5, "hexagram": 1.4}
KINDS = {"svg": "image/svg+xml", "pdf": "application/pdf", "png": "image/png"}
RESOLUTION = 200  # dots per inch of PNG files


def draw(picture):
    """A matplotlib Figure."""
    try:
        import matplotlib
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError as error:
        raise ImportError("pictures with matplotlib need the package matplotlib: apt install python3-matplotlib, or "
                          "pip install matplotlib") from error
    with matplotlib.rc_context(_style()):
        figure = _in_notebooks(Figure)(figsize=(picture.width, picture.height), dpi=110)
        FigureCanvasAgg(figure)
        for panel in picture.panels:
            _draw_panel(figure, panel)
        left, top = picture.left, 1 - 0.1 / picture.height
        if picture.title:
            figure.text(left, top, picture.title, va="top", ha="left", fontsize=picture.title_size, color=INK, parse_math=False)
            top -= 0.2 / picture.height
        if picture.legend:
            _draw_legend(figure, picture, left, top)
    return figure


def _in_notebooks(figure_class):
    """The class of figures that notebooks show, whether pyplot is in use or not."""
    class Shown(figure_class):
        def _repr_png_(self):
            bytes_of_file = io.BytesIO()
            self.savefig(bytes_of_file, format="png")
            return bytes_of_file.getvalue()

    return Shown


def image(picture, kind, version=""):
    """The bytes of a file of the kind svg, pdf or png; the same for the same picture."""
    import matplotlib
    creator = f"eigentrail {version}".strip()
    metadata = {"svg": {"Creator": creator, "Date": None}, "pdf": {"Creator": creator, "CreationDate": None, "Producer": None},
                "png": {"Software": creator}}[kind]
    figure, file = draw(picture), io.BytesIO()
    with matplotlib.rc_context({**_style(), "svg.hashsalt": "eigentrail"}):
        figure.savefig(file, format=kind, metadata=metadata, dpi=RESOLUTION)
    return file.getvalue()


def _style():
    return {"font.size": 9, "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans"], "axes.edgecolor": "#555555",
            "axes.labelcolor": INK, "axes.linewidth": 0.8, "xtick.color": "#333333", "ytick.color": "#333333",
            "axes.unicode_minus": True, "axes.formatter.useoffset": False, "text.usetex": False, "mathtext.default": "regular",
            "svg.fonttype": "path", "path.simplify": True, "lines.scale_dashes": True}


def _draw_panel(figure, panel):
    axes = figure.add_axes((panel.left, panel.bottom, panel.width, panel.height))
    axes.set_axisbelow(True)
    if not panel.frame:
        axes.axis("off")
    for axis, which in ((panel.x, "x"), (panel.y, "y")):
        _set_axis(axes, axis, which)
    axes.grid(True, color=GRID, linewidth=0.7)
    axes.spines[["top", "right"]].set_visible(False)
    for item in panel.items:
        _DRAWN[type(item)](axes, item)


def _set_axis(axes, axis, which):
    if axis.log:
        getattr(axes, f"set_{which}scale")("log")
    getattr(axes, f"set_{which}lim")(axis.low, axis.high)
    getattr(axes, f"set_{which}label")(axis.title, parse_math=False)
    target = getattr(axes, f"{which}axis")
    if axis.ticks is not None:
        target.set_ticks([place for place, _ in axis.ticks], [text for _, text in axis.ticks])
    elif axis.log and axis.high < 500 * axis.low:
        from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter
        target.set_major_locator(LogLocator(subs=(1, 2, 5)))
        target.set_major_formatter(StrMethodFormatter("{x:g}"))
        target.set_minor_formatter(NullFormatter())
    if not axis.shown:
        axes.tick_params(**{f"label{'bottom' if which == 'x' else 'left'}": False})


def _mark(item):
    """Keywords of a line that shows marks."""
    base, colour = item.symbol.removesuffix("-open"), item.colour
    open_ = item.symbol != base or base.endswith("-dot")
    width = 1.3 if open_ or base in STROKES else 0.5
    return {"marker": SYMBOLS[base], "markersize": item.size * LARGER.get(base, 1.0), "markeredgewidth": width,
            "markerfacecolor": "none" if open_ else colour, "markeredgecolor": colour if open_ or base in STROKES else "white"}


def _draw_line(axes, item):
    return axes.plot(item.x, item.y, color=item.colour, linewidth=item.width, linestyle=DASHES[item.dash], clip_on=item.clip,
                     solid_capstyle="round", label=item.name or None)


def _draw_marks(axes, item):
    style = DASHES[item.legend_line] if item.legend_line else "none"
    return axes.plot(item.x, item.y, linestyle=style, color=item.colour, zorder=3, label=item.name or None, clip_on=False,
                     **_mark(item))


def _draw_area(axes, item):
    return axes.fill(item.x, item.y, color=item.colour, alpha=item.opacity, linewidth=0, label=item.name or None)


def _draw_span(axes, item):
    return [axes.axvspan(item.low, item.high, color=item.colour, alpha=item.opacity, linewidth=0, zorder=0)]


def _draw_label(axes, item):
    from matplotlib.patheffects import withStroke
    more = {"path_effects": [withStroke(linewidth=2, foreground="white")]} if item.halo else {}
    if item.boxed:
        more["bbox"] = dict(facecolor="white", edgecolor="none", pad=0.6, alpha=0.85)
    axes.annotate(item.text, (item.x, item.y), xytext=(item.dx, item.dy), textcoords="offset points", ha=item.align,
                  va="center", fontsize=item.size, color=item.colour, annotation_clip=False, zorder=5, parse_math=False, **more)


def _draw_cells(axes, item):
    """Neighbours of a row with the same colour are one rectangle, which keeps files small. Each goes on below the next one
    and the next row, which are drawn later, so that no gap shines through."""
    from matplotlib.collections import PolyCollection
    x, y, kind = _edges(item.x), _edges(item.y), np.asarray(item.kind)
    polygons, colours = [], []
    for row, values in enumerate(kind):
        begins = np.flatnonzero(np.diff(values, prepend=-1))
        for begin, end in zip(begins, np.append(begins[1:], len(values))):
            right, top = x[min(end + 1, len(x) - 1)], y[min(row + 2, len(y) - 1)]
            polygons.append([(x[begin], y[row]), (right, y[row]), (right, top), (x[begin], top)])
            colours.append(item.colours[values[begin]])
    axes.add_collection(PolyCollection(polygons, facecolors=colours, linewidths=0, antialiaseds=False, zorder=0))


def _edges(values):
    values = np.asarray(values, float)
    if len(values) < 2:
        return np.array([values[0] - 0.5, values[0] + 0.5])
    middle = 0.5 * (values[1:] + values[:-1])
    return np.concatenate([[values[0]], middle, [values[-1]]])


_DRAWN = {Line: _draw_line, Marks: _draw_marks, Area: _draw_area, Span: _draw_span, Label: _draw_label, Cells: _draw_cells}


def _draw_legend(figure, picture, left, top):
    handles = []
    for item in picture.legend:  # they have no data, so that nothing of them is seen in the axes
        (handle,) = _DRAWN[type(item)](figure.axes[0], item)
        handle.set_label(item.legend)
        handles.append(handle)
    columns = picture.legend_columns
    if picture.legend_right:
        panel = picture.panels[0]
        left, top, columns = panel.left + panel.width + 0.15 / picture.width, panel.bottom + panel.height, 1
    legend = figure.legend(handles=handles, loc="upper left", bbox_to_anchor=(left, top), ncols=columns,
                           frameon=False, borderaxespad=0, borderpad=0, fontsize=8, handletextpad=0.5,
                           handlelength=2.6 if picture.legend_right else 1.7, columnspacing=1.4, labelspacing=0.35)
    for text in legend.get_texts():
        text.set_parse_math(False)
