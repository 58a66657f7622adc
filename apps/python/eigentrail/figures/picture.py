"""The description of a figure that does not depend on a drawing library.

A `Picture` has panels with axes, and on these lines, marks, bands, spans, cells and labels in data coordinates. All places
are decided here, so that the renderers only translate. Sizes are in inches, marks and texts in points (1/72 inch).
"""

from dataclasses import dataclass, field
from typing import Any, Optional

import numpy as np

Numbers = Any  # an array or a list of numbers


@dataclass
class Axis:
    title: str
    low: float
    high: float
    log: bool = False
    ticks: Optional[list[tuple[float, str]]] = None  # places with their texts; None: those of the library
    shown: bool = True

    def share(self, value):
        """Where a value lies: 0 at the low end, 1 at the high end. Values and result may be arrays."""
        with np.errstate(divide="ignore", invalid="ignore"):
            value, low, high = (np.log10(one) if self.log else np.asarray(one, float) for one in (value, self.low, self.high))
        return (value - low) / (high - low)

    def value(self, share):
        """The value at a share of the axis."""
        if self.log:
            return self.low * (self.high / self.low) ** share
        return self.low + share * (self.high - self.low)


@dataclass
class Line:
    """A line; NaN separates parts. `dash`: solid, dash or dot."""
    x: Numbers
    y: Numbers
    colour: str
    width: float = 1.6
    dash: str = "solid"
    name: str = ""  # what it shows, for readers and tests
    legend: Optional[str] = None
    clip: bool = True


@dataclass
class Marks:
    """Marks with plotly's names of symbols; `-open`: not filled."""
    x: Numbers
    y: Numbers
    symbol: str
    colour: str
    size: float = 6.0
    name: str = ""
    texts: Optional[list[str]] = None  # one per mark
    legend: Optional[str] = None
    legend_line: str = ""  # dash of the line on which the legend shows the mark; empty: no line


@dataclass
class Area:
    """A filled polygon."""
    x: Numbers
    y: Numbers
    colour: str
    opacity: float = 0.15
    name: str = ""
    legend: Optional[str] = None


@dataclass
class Span:
    """A shaded interval of the horizontal axis over the whole height."""
    low: float
    high: float
    colour: str
    opacity: float
    legend: Optional[str] = None


@dataclass
class Cells:
    """Coloured cells about the values x (columns) and y (rows), ascending. `kind` (rows, columns): index into `colours`."""
    x: Numbers
    y: Numbers
    kind: Numbers
    colours: list[str]
    names: list[str]


@dataclass
class Label:
    """A text beside a place, shifted by dx and dy points. `align`: left, center or right of the text is at the place."""
    x: float
    y: float
    text: str
    colour: str = "#1a1a1a"
    size: float = 8.0
    align: str = "left"
    dx: float = 0.0
    dy: float = 0.0
    halo: bool = False  # with a white edge, where lines are below it
    boxed: bool = False  # on a white ground, which hides the line behind it


@dataclass
class Panel:
    """Axes at (left, bottom) with (width, height), in shares of the picture."""
    left: float
    bottom: float
    width: float
    height: float
    x: Axis
    y: Axis
    items: list = field(default_factory=list)
    frame: bool = True
    points: tuple[float, float] = (1.0, 1.0)  # width and height in points

    def place(self, x, y):
        """Points from the lower left corner of data coordinates."""
        return self.x.share(x) * self.points[0], self.y.share(y) * self.points[1]

    def at(self, px, py):
        """Data coordinates of points from the lower left corner."""
        return self.x.value(px / self.points[0]), self.y.value(py / self.points[1])

    def seen(self, x, y, slack=0.0):
        """Of places in data coordinates those in the window, or not farther beside it: their numbers, and points (x, y)."""
        px, py = self.place(x, y)
        with np.errstate(invalid="ignore"):
            inside = (px >= -slack) & (px <= self.points[0] + slack) & (py >= -slack) & (py <= self.points[1] + slack)
        at = np.flatnonzero(inside)
        return at, px[at], py[at]

    def of(self, kind):
        return [item for item in self.items if isinstance(item, kind)]


@dataclass
class Picture:
    width: float
    height: float
    title: str = ""
    panels: list[Panel] = field(default_factory=list)
    legend: list = field(default_factory=list)  # items without data whose `legend` is the text
    legend_columns: int = 6
    legend_right: bool = False  # in a column beside the panels instead of rows above them

    @property
    def left(self):
        """Where titles and legends begin, as a share of the width."""
        return min((panel.left for panel in self.panels), default=0.05)

    @property
    def title_size(self):
        """Size of the title in points: smaller where it is long."""
        room = 72 * self.width * (1 - self.left) - 8
        return min(10.0, room / (0.58 * max(len(self.title), 1)))

    def add(self, left, bottom, right, top, x, y, **more):
        """A panel between margins and heights in inches from the lower left corner of the picture."""
        panel = Panel(left / self.width, bottom / self.height, (right - left) / self.width, (top - bottom) / self.height, x, y,
                      points=(72 * (right - left), 72 * (top - bottom)), **more)
        self.panels.append(panel)
        return panel
