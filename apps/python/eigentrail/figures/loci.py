"""What the figures of a trace have in common: lines of modes with their names, events, stable ranges."""

import numpy as np

from ..errors import SceneError
from ..selection import mode_names
from .curves import DASHED, DOTTED, SOLID, Curves, damping_percent, oscillates, parts, runs, with_ends, without_rounding
from .labels import HEIGHT, Room, spread, text_width
from .picture import Area, Axis, Label, Line, Marks, Picture, Span
from .style import (ANGULAR, FAINT, GREY, INK, OTHER_EVENT, PARTIAL_RANGE, RANGES, TOO_CLOSE, WARNING, event_kinds, mode_colour,
                    mode_symbol, number, with_unit)

MOST_NAMED = 14        # modes with their names at the ends of the lines; more have numbers on the lines
MOST_NAMES_LISTED = 80
MANY = 30              # more modes than this have thin lines
NAME, SMALL = 8.0, 7.0  # sizes of texts in points
LONGEST_NAME = 26
MARKS_PER_LINE = 4
OF_FREQUENCY = ("crossing", "veering")  # events that say nothing about damping
CROWDED = 25           # more events than this have small marks and labels, those of frequency the smallest
CANDIDATES = 24       # places of a line at which its number is tried
DASH = {SOLID: "solid", DASHED: "dash", DOTTED: "dot"}
STYLE_WORDS = {DASHED: "identity not certified", DOTTED: "backward whirl"}
ERROR_WORDS = "error of the data"
LEFT, RIGHT, BOTTOM, TOP = 0.8, 0.25, 0.6, 0.18  # margins in inches
TITLE, LEGEND_ROW = 0.22, 0.185


class LociFigure:
    """What the figures of a trace have in common.

    What they draw of modes are arrays x and y (n, mode) at all places of the curves, NaN where nothing is drawn: `s`, and the
    parameter `p`; of oscillations, and to the places next to them, `frequency` (in `unit`) and `damping` (percent). `damping_per_error`:
    change of the latter per change of s.
    """

    def __init__(self, loci, unit=None):
        self.loci = loci
        self.parameter = loci.attrs["parameter"]
        self.parameter_unit = loci[self.parameter].attrs.get("units", "1")
        self.unit = unit or (self.parameter_unit if self.parameter_unit in ANGULAR else "Hz")
        if self.unit not in ANGULAR:
            raise SceneError(f"unit={unit!r}: expected a unit of frequency: {', '.join(ANGULAR)}")
        self.factor = ANGULAR[self.unit]
        self.curves = Curves(loci)
        self.labels, self.names = mode_names(loci)
        self.s = self.curves.s
        self.p = np.broadcast_to(self.curves.parameter[:, np.newaxis], self.s.shape)
        self.modes = list(np.flatnonzero(np.isfinite(self.s).any(axis=0)))
        self.range = (float(self.p.min()), float(self.p.max()))
        shown = with_ends(oscillates(self.s), self.curves.step) & np.isfinite(self.s)
        self.frequency = np.where(shown, np.abs(self.s.imag) / self.factor, np.nan)
        self.damping = np.where(shown, damping_percent(self.s), np.nan)
        with np.errstate(divide="ignore"):
            self.damping_per_error = 100 / np.abs(self.s)
        self.legend = {}

    # Modes.

    def short_name(self, mode):
        """The name with the number, cut where it is long."""
        name = self.names[mode]
        text = name if name == self.labels[mode] else f"{mode + 1} {name}"
        return text if len(text) <= LONGEST_NAME else text[:LONGEST_NAME - 1] + "\u2026"

    def add_modes(self, panel, modes, x, y):
        """Lines of modes."""
        for mode in modes:
            across, up = x[:, mode], y[:, mode]
            styles = self.curves.styles(mode)
            for style, dash in DASH.items():
                line = parts(across, up, styles, style)
                if len(line[0]):
                    width = 1.6 if len(modes) <= MANY else 1.1
                    panel.items.append(Line(*line, mode_colour(mode), width, dash, f"mode {mode + 1}"))
                    if style in STYLE_WORDS:
                        self.explain(Line([], [], GREY, 1.4, dash, legend=STYLE_WORDS[style]))
            if 1 < len(modes) <= MOST_NAMED:
                self.add_marks_on(panel, mode, across, up)

    def add_marks_on(self, panel, mode, x, y):
        """A few marks on a line, by which lines can be distinguished without colours."""
        inside, px, py = panel.seen(x, y)
        if len(inside) < 2:
            return
        along = _lengths(px, py)
        shift = 0.13 * ((mode * 3) % 5 - 2)
        wanted = along[-1] * (np.arange(MARKS_PER_LINE) + 0.5 + shift) / MARKS_PER_LINE
        at = inside[np.unique(np.abs(along[:, np.newaxis] - wanted).argmin(axis=0))]
        panel.items.append(Marks(x[at], y[at], mode_symbol(mode), mode_colour(mode), 5.0, f"marks of mode {mode + 1}"))

    def add_bands(self, panel, modes, y, per_error):
        """Bands in which values lie as far as the errors of the data tell: the error of s times `per_error`."""
        errors = self.curves.errors()
        if errors is None:
            return
        with np.errstate(invalid="ignore"):
            half = errors * per_error
        for mode in modes:
            for begin, end in runs(np.isfinite(y[:, mode])):
                if end - begin < 2:
                    continue
                p, (low, high) = self.p[begin:end, mode], (y[begin:end, mode] + sign * half[begin:end, mode] for sign in (-1, 1))
                panel.items.append(Area(np.concatenate([p, p[::-1]]), np.concatenate([high, low[::-1]]),
                                        mode_colour(mode), 0.16, f"error of mode {mode + 1}"))
            self.explain(Area([], [], GREY, 0.3, legend=ERROR_WORDS))

    def add_end_names(self, panel, room, modes, x, y):
        """Names of modes: in the margin where a line ends at the right edge, else beside its last place in the window."""
        right, top = panel.points
        ends = []
        for mode in modes:
            _, px, py = panel.seen(x[:, mode], y[:, mode], slack=1)
            last = px.argmax() if len(px) else None
            if last is not None and px[last] > 0.97 * right:
                ends.append((mode, px[last], py[last]))
            elif last is not None:
                self._add_inner_name(panel, room, mode, x[:, mode], y[:, mode])
        heights = spread([py for _, _, py in ends], HEIGHT * NAME, 0.0, top)
        for (mode, px, py), height in zip(ends, heights):
            leader = panel.at(np.array([px, right + 7]), np.array([py, height]))
            panel.items.append(Line(*leader, mode_colour(mode), 0.6, name="leader", clip=False))
            panel.items.append(Label(*panel.at(right, height), self.short_name(mode), mode_colour(mode), NAME, "left", 9))

    def _add_inner_name(self, panel, room, mode, x, y):
        """The name beside the last place of a line in the window at which there is room."""
        _, px, py = panel.seen(x, y)
        if not len(px):
            return
        order = 1 if px[-1] >= px[0] else -1  # so that the last place is on the right
        px, py = px[::order], py[::order]
        along = _lengths(px, py)
        for place in np.arange(along[-1], 0.3 * along[-1] - 1e-9, -max(HEIGHT * NAME, 0.02 * along[-1])):
            at = panel.at(np.interp(place, along, px), np.interp(place, along, py))
            if room.beside(*at, self.short_name(mode), NAME, 4, mode_colour(mode)):
                return

    def add_numbers(self, panel, room, modes, x, y):
        """Numbers of modes on their lines, where there is room."""
        for i, mode in enumerate(modes):
            _, px, py = panel.seen(x[:, mode], y[:, mode])
            if not len(px):
                continue
            along = _lengths(px, py)
            places = along[-1] * (0.04 + 0.92 * ((np.arange(CANDIDATES) + 0.37 * i) % CANDIDATES) / CANDIDATES)
            at = panel.at(np.interp(places, along, px), np.interp(places, along, py))
            if not room.on_line(*at, str(mode + 1), SMALL, mode_colour(mode)):
                room.beside(*panel.at(px[-1], py[-1]), str(mode + 1), SMALL, 5, mode_colour(mode))

    def name_width(self, modes):
        """Inches that names in the right margin need."""
        if len(modes) <= MOST_NAMED:
            return (text_width(max((self.short_name(mode) for mode in modes), key=len, default=""), NAME) + 14) / 72
        return len(self._listed(modes)) * self._column_width(modes) / 72

    def _listed(self, modes, rows=44):
        """Modes in columns of the list of names; empty where modes have no names of their own."""
        named = [mode for mode in modes if self.names[mode] != self.labels[mode]]
        if not named or len(modes) > MOST_NAMES_LISTED:
            return []
        return [modes[i:i + rows] for i in range(0, len(modes), rows)]

    def _column_width(self, modes):
        return text_width(max((self.short_name(mode) for mode in modes), key=len), SMALL) + 8

    def add_list(self, panel, modes):
        """Numbers and names of modes in the right margin."""
        for column, members in enumerate(self._listed(modes)):
            for row, mode in enumerate(members):
                panel.items.append(Label(*panel.at(*panel.points), self.short_name(mode), mode_colour(mode), SMALL, "left",
                                         8 + column * self._column_width(modes), -(row + 0.5) * HEIGHT * SMALL))

    # Events, ranges, rays.

    def event_table(self):
        """Kind, parameter, eigenvalue and value of events."""
        loci = self.loci
        return list(zip(loci.event_kind.values, loci.event_parameter.values, loci.event_eigenvalue.values,
                        loci.event_value.values, loci.event_modes.values))

    def add_names(self, panel, room, modes, x, y, few=None):
        """Names at the ends of the lines, or numbers on them where there are many. `few`: what adds the names of a few."""
        if len(modes) <= MOST_NAMED:
            (few or self.add_end_names)(panel, room, modes, x, y)
        else:
            self.add_numbers(panel, room, modes, x, y)
            self.add_list(panel, modes)

    def add_events(self, panel, place, labelled=True, events=(), before=lambda room: None):
        """Marks of events, and labels where there is room. `place` maps the parameter and s to data coordinates; NaN: none.

        `events`: events instead of those of the file; `before`: adds labels that come first. Returns the room that is left."""
        found = {}
        for kind, p, s, value, _ in events or self.event_table():
            s = complex(without_rounding(np.complex128(s)))
            x, y = place(p, s)
            if np.isfinite(x) and np.isfinite(y) and _within(panel, x, y) and (labelled or kind not in OF_FREQUENCY):
                found.setdefault(kind, []).append((x, y, event_label(kind, p, value)))
        count = sum(map(len, found.values()))
        for kind, marks in found.items():
            symbol, words, _ = event_kinds().get(kind, (OTHER_EVENT, kind, False))
            xs, ys, texts = zip(*marks)
            size, colour = (6.0, INK) if count <= CROWDED else (4.5, INK) if kind not in OF_FREQUENCY else (3.5, GREY)
            colour = WARNING if kind == TOO_CLOSE else colour
            panel.items.append(Marks(np.array(xs), np.array(ys), symbol, colour, size, kind, list(texts)))
            self.explain(Marks([], [], symbol, colour, 6.0, legend=words))
        if labelled:
            self._add_intervals(panel, place)
        room = Room(panel)
        before(room)
        for kind in event_kinds() if labelled else ():
            for x, y, text in found.get(kind, ()):
                if text:
                    room.beside(x, y, text, NAME if count <= CROWDED else SMALL, 5)
        return room

    def _add_intervals(self, panel, place):
        """Bars over the values of the parameter between which events lie as far as the errors of the data tell."""
        if "event_interval" not in self.loci or panel.x.title not in ("", self.parameter_axis().title):
            return
        for (_, p, s, _, _), (low, high) in zip(self.event_table(), self.loci.event_interval.values.reshape(-1, 2)):
            _, y = place(p, s)
            if np.isfinite([low, high, y]).all() and high > low and _within(panel, p, y):
                panel.items.append(Line([low, high], [y, y], GREY, 1.0, name="interval of the event"))
                panel.items.append(Marks([low, high], [y, y], "line-ns-open", GREY, 6.0, "interval of the event"))

    def add_folds(self, panel):
        """Vertical lines where the path turns back or branches and no mode is at the place."""
        for kind, p, s, _, modes in self.event_table():
            if kind in ("fold", "branch_point"):
                panel.items.append(Line([p, p], [panel.y.low, panel.y.high], GREY, 0.8, "dot", kind))

    def ranges(self):
        """Per stable range: where it begins and ends, and its colour, opacity and words."""
        loci = self.loci
        if "stable_kind" not in loci.variables:
            return []
        whole = loci.stable_whole.values if "stable_whole" in loci.variables else np.zeros(loci.stable_kind.shape)
        return [(begin, end, RANGES.get(kind, (FAINT, 0.2, kind)) if of_all else PARTIAL_RANGE)
                for kind, of_all, begin, end in zip(loci.stable_kind.values, whole, loci.stable_from.values, loci.stable_to.values)]

    def add_ranges(self, panel):
        """Shaded ranges on which no mode grows."""
        for begin, end, (colour, opacity, words) in self.ranges():
            panel.items.append(Span(min(begin, end), max(begin, end), colour, opacity))
            self.explain(Span(0, 0, colour, min(2.2 * opacity, 1.0), legend=words))

    def explain(self, item):
        """Adds an entry to the legend, once."""
        self.legend.setdefault(item.legend, item)

    # Frame.

    def begin(self, size, modes, further=()):
        """The picture, and the height (inches) at which panels end below the title and the legend. `further`: texts that the
        legend has besides those of events, ranges and styles of lines."""
        return framed(self.loci, size, self._legend_texts(modes) + list(further))

    def _legend_texts(self, modes):
        loci = self.loci
        texts = [words for kind, (_, words, _) in event_kinds().items() if kind in set(loci.event_kind.values)]
        texts += sorted({words for _, _, (_, _, words) in self.ranges()})
        texts += [] if self.curves.errors() is None else [ERROR_WORDS]
        styles = {style for mode in modes for style in self.curves.styles(mode)}
        return texts + [words for style, words in STYLE_WORDS.items() if style in styles]

    def parameter_axis(self):
        low, high = self.range
        pad = 0.01 * (high - low) or 0.01 * abs(low) or 0.01
        return Axis(with_unit(self.parameter, self.parameter_unit), low - pad, high + pad)

    def finish(self, picture):
        """Adds the legend."""
        picture.legend = list(self.legend.values())
        return picture


def _lengths(x, y):
    """Lengths (n) of a polygon up to its places."""
    return np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])


def framed(data, size, texts):
    """A picture with the title of a Dataset, and the height (inches) at which panels end below it and a legend of these texts."""
    picture = Picture(*size, title=str(data.attrs.get("title", "")))
    widest = max((text_width(text, NAME) + 34 for text in texts), default=1)
    columns = picture.legend_columns = max(min(int(72 * (size[0] - LEFT) // widest), len(texts)), 1)
    return picture, size[1] - TOP - (TITLE if picture.title else 0) - LEGEND_ROW * -(-len(texts) // columns)


def event_label(kind, p, value):
    """A short label; empty for kinds that have only a mark."""
    place = number(p)
    if kind in ("resonance", TOO_CLOSE):
        return f"{number(value)}\u00d7 {place}"
    if kind in ("damping_ratio", "extremum"):
        return f"{number(100 * value, 3)} % at {place}" if kind == "damping_ratio" else ""
    if kind == "log_decrement":
        return f"\u03b4 {number(value, 3)} at {place}"
    _, words, labelled = event_kinds().get(kind, ("", "", False))
    return f"{words} {place}" if labelled else ""


def _within(panel, x, y):
    a, b = panel.x.share(x), panel.y.share(y)
    return -0.001 <= a <= 1.001 and -0.001 <= b <= 1.001


def padded(low, high, below, above):
    size = high - low
    if size <= 1e-12 * max(abs(low), abs(high), 1e-300):
        size = 0.1 * max(abs(low), abs(high)) or 1.0
    return low - below * size, high + above * size
