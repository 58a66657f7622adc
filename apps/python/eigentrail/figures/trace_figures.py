"""Figures of a trace: Campbell diagram, damping, root locus."""

import numpy as np

from ..errors import SceneError
from .curves import damping_percent, oscillates, usual_range, with_ends
from .drawing import excitation
from .loci import BOTTOM, LEFT, MOST_NAMED, NAME, RIGHT, LociFigure, padded
from .picture import Axis, Line, Marks, Span
from .separation import Operation
from .style import ANGULAR, EVENTS, GREY, INK, MARGIN, OPERATION, TOO_CLOSE, mode_colour, number


def of_oscillations(figure):
    """A function of a mode: its places where it oscillates, and those next to them."""
    return lambda mode: with_ends(oscillates(figure.curves.s[:, mode])) & np.isfinite(figure.curves.s[:, mode])


def frequency(figure):
    return lambda mode: np.abs(figure.curves.s[:, mode].imag) / figure.factor


def damping(figure):
    return lambda mode: damping_percent(figure.curves.s[:, mode])


def along(figure):
    return lambda mode: figure.curves.parameter


def harmonics_of(figure, asked):
    """Harmonics to draw and their frequency: parameter and rad/s; none where the parameter has no excitation and none were
    asked for."""
    found = excitation(figure.loci)
    if found is None:
        if asked:
            raise SceneError(
                f"harmonics need an angular velocity or a frequency as the parameter ({', '.join(ANGULAR)}), or an excitation "
                f"in the scene's [trace]; the parameter {figure.parameter} has the unit {figure.parameter_unit!r}")
        return [], None
    if asked is None:
        values = [value for kind, _, _, value, _ in figure.event_table() if kind == "resonance"]
        asked = sorted({float(value) for value in [*values, *found.harmonics] if np.isfinite(value) and value > 0})
    asked = [float(n) for n in np.atleast_1d(asked)]
    if any(not np.isfinite(n) or n <= 0 for n in asked):
        raise SceneError(f"harmonics={asked}: expected positive numbers")
    return asked, found


def campbell_picture(loci, harmonics=None, unit=None, log=False, size=None):
    """Damped frequency over the parameter with rays of harmonics; the damping ratio below."""
    figure = LociFigure(loci, unit)
    harmonics, source = harmonics_of(figure, harmonics)
    shown, modes = of_oscillations(figure), oscillating(figure)
    low, high = frequency_range(figure, modes, shown, harmonics, source, log)
    modes = [mode for mode in modes if np.nanmin(np.where(shown(mode), frequency(figure)(mode), np.nan)) < high]
    events = [*figure.event_table(), *ray_crossings(figure, modes, harmonics, source)]
    operation = Operation.of(loci)
    words = [OPERATION[2], MARGIN[2], EVENTS[TOO_CLOSE][1]] if operation.ranges else []
    picture, top = figure.begin(size or (9.0, 6.5), modes, ["resonance", *words] if harmonics else words)
    right, middle = picture.width - RIGHT - figure.name_width(modes), BOTTOM + 0.3 * (top - BOTTOM)
    above = picture.add(LEFT, middle + 0.18, right, top, figure.parameter_axis(),
                        Axis(f"damped frequency, {figure.unit}", low, high, log))
    above.x.title, above.x.shown = "", False
    below = picture.add(LEFT, BOTTOM, right, middle, figure.parameter_axis(),
                        Axis("damping ratio, %", *damping_range(figure, modes, shown)))
    for panel in picture.panels:
        add_operation(figure, panel, operation, events)
    rays = add_rays(figure, above, harmonics, source)
    add_curves(figure, above, modes, frequency(figure), lambda mode: 1 / figure.factor, shown)
    add_curves(figure, below, modes, damping(figure), lambda mode: 100 / np.abs(figure.curves.s[:, mode]), shown)
    events = [(TOO_CLOSE if kind == "resonance" and operation.is_too_close(p, s) else kind, p, s, *more)
              for kind, p, s, *more in events]
    room = figure.add_events(above, lambda p, s: (p, abs(s.imag) / figure.factor), events=events, before=rays)
    figure.add_events(below, damping_place, labelled=False, events=events)
    figure.add_names(above, room, modes, along(figure), frequency(figure), shown)
    return figure.finish(picture)


def add_operation(figure, panel, operation, events):
    """Shaded operating ranges and their separation margins."""
    critical = [(p, s) for kind, p, s, *_ in events if kind == "resonance"]
    for intervals, (colour, opacity, words) in ((operation.ranges, OPERATION), (operation.strips(critical), MARGIN)):
        for low, high in intervals:
            low, high = max(low, panel.x.low), min(high, panel.x.high)
            if low < high:
                panel.items.append(Span(low, high, colour, opacity))
                figure.explain(Span(0, 0, colour, 2 * opacity, legend=words))


def damping_picture(loci, size=None):
    """Damping ratio of oscillating modes over the parameter."""
    figure = LociFigure(loci)
    shown, modes = of_oscillations(figure), oscillating(figure)
    picture, top = figure.begin(size or (9.0, 5.0), modes)
    panel = picture.add(LEFT, BOTTOM, picture.width - RIGHT - figure.name_width(modes), top, figure.parameter_axis(),
                        Axis("damping ratio, %", *damping_range(figure, modes, shown)))
    add_curves(figure, panel, modes, damping(figure), lambda mode: 100 / np.abs(figure.curves.s[:, mode]), shown)
    room = figure.add_events(panel, damping_place)
    figure.add_names(panel, room, modes, along(figure), damping(figure), shown)
    return figure.finish(picture)


def add_curves(figure, panel, modes, value, error, shown):
    """Everything along the parameter but events and names. `error` of a mode: change of the value per change of s."""
    figure.add_ranges(panel)
    figure.add_folds(panel)
    if panel.y.low < 0 < panel.y.high:
        panel.items.append(Line([panel.x.low, panel.x.high], [0, 0], GREY, 0.8, name="axis"))
    figure.add_bands(panel, modes, value, error, shown)
    figure.add_modes(panel, modes, along(figure), value, shown)


def damping_place(p, s):
    return p, float(damping_percent(np.complex128(s))) if s.imag else np.nan


def oscillating(figure):
    """Modes that oscillate somewhere."""
    modes = [mode for mode in figure.modes if np.sum(oscillates(figure.curves.s[:, mode])) > 2]
    if not modes:
        raise SceneError("no mode of this trace oscillates; root_locus() draws real eigenvalues")
    return modes


def frequency_range(figure, modes, shown, harmonics, source, log):
    """To the highest ray at the end of the range, at least to the lowest mode; to all modes where there are no rays."""
    values = [np.where(shown(mode), frequency(figure)(mode), np.nan) for mode in modes]
    highest = usual_range(np.concatenate(values))[1]
    if harmonics:
        ray = max(harmonics) * float(np.max(source.frequency)) / figure.factor
        lowest = min(np.nanmax(value) for value in values)
        highest = max(ray, 1.05 * lowest)
    if not log:
        return (-0.02 * highest, 1.04 * highest) if highest > 0 else (-0.02, 1.0)
    positive = np.concatenate(values)
    positive = positive[positive > 1e-6 * highest]
    return 0.8 * float(positive.min()), 1.25 * highest


def damping_range(figure, modes, shown):
    low, high = usual_range(np.concatenate([np.where(shown(mode), damping(figure)(mode), np.nan) for mode in modes]))
    if max(abs(low), abs(high)) < 1e-6:
        return -1.0, 1.0
    return padded(min(low, 0.0), max(high, 0.0), 0.06, 0.08)


def add_rays(figure, panel, harmonics, source):
    """Lines of harmonics. Returns a function of the room that gives their names, at their ends in the window."""
    rays = []
    for n in harmonics:
        x, y = np.asarray(source.parameter, float), n * np.asarray(source.frequency, float) / figure.factor
        x, y = (np.interp(np.linspace(0, len(x) - 1, 400), np.arange(len(x)), values) for values in (x, y))
        panel.items.append(Line(x, y, GREY, 1.0, "dot", f"harmonic {number(n)}"))
        px, py = panel.place(x, y)
        with np.errstate(invalid="ignore"):
            seen = (py >= 0) & (py <= panel.points[1]) & (px >= 0) & (px <= panel.points[0])
        rays.append((x[seen], y[seen], f"{number(n)}\u00d7"))

    def names(room):
        found = [room.at_end(x, y, text, NAME, "#444444") for x, y, text in rays if len(x)]
        return [label for label in found if label]

    return names


def ray_crossings(figure, modes, harmonics, source):
    """Crossings of rays and modes that are no events of the file."""
    known = [(p, value) for kind, p, _, value, _ in figure.event_table() if kind == "resonance"]
    size = figure.range[1] - figure.range[0]
    found = []
    for n in harmonics:
        def excess(p, s, n=n):
            return np.where(oscillates(s), np.abs(s.imag), np.nan) - n * np.interp(p, *_ascending(source))
        for mode, p, s in zip(*figure.curves.crossings(modes, excess)):
            if not any(abs(p - q) < 1e-6 * size and n == value for q, value in known):
                found.append(("resonance", p, s, n, str(mode + 1)))
    return found


def _ascending(source):
    order = np.argsort(source.parameter)
    return np.asarray(source.parameter, float)[order], np.asarray(source.frequency, float)[order]


def root_locus_picture(loci, unit=None, size=None):
    """Im s over Re s, upper half plane: a ring where a mode begins, a dot where it ends."""
    figure = LociFigure(loci, unit)
    s, modes = figure.curves.s, figure.modes

    def real(mode):
        return s[:, mode].real

    def imag(mode):
        return np.abs(s[:, mode].imag) / figure.factor

    def shown(mode):
        return np.isfinite(s[:, mode])

    low, high = usual_range(np.concatenate([real(mode) for mode in modes]))
    top_value = usual_range(np.concatenate([imag(mode) for mode in modes]))[1]
    if max(abs(low), abs(high)) < 1e-7 * top_value * figure.factor:
        low, high = -1e-3 * top_value * figure.factor, 1e-3 * top_value * figure.factor
    figure.explain(Marks([], [], "circle-open", INK, 5.0, legend="begins"))
    figure.explain(Marks([], [], "circle", INK, 5.0, legend="ends"))
    picture, top = figure.begin(size or (9.0, 6.0), modes, ["begins", "ends"])
    named = figure.name_width(modes) if len(modes) > MOST_NAMED else 0
    panel = picture.add(LEFT, BOTTOM, picture.width - RIGHT - named, top,
                        Axis("Re s, 1/s", *padded(min(low, 0.0), max(high, 0.0), 0.05, 0.07)),
                        Axis(f"damped frequency Im s, {figure.unit}", *padded(0.0, top_value or 1.0, 0.03, 0.05)))
    panel.items.append(Line([0, 0], [panel.y.low, panel.y.high], "#555555", 1.0, name="axis"))
    figure.add_modes(panel, modes, real, imag, shown)
    ends = [(begin, end) for mode in modes for begin, end in _pieces(shown(mode), mode)]
    size_of_ends = 5.0 if len(ends) <= 40 else 3.5
    for pick, symbol in ((0, "circle-open"), (1, "circle")):
        at = [(real(mode)[piece[pick]], imag(mode)[piece[pick]]) for piece, mode in ends]
        panel.items.append(Marks(*(np.array(values) for values in zip(*at)), symbol, INK, size_of_ends, ("begins", "ends")[pick]))
    room = figure.add_events(panel, lambda p, s: (s.real, abs(s.imag) / figure.factor))
    if len(modes) <= MOST_NAMED:
        for (_, end), mode in ends:
            label = room.beside(real(mode)[end], imag(mode)[end], figure.short_name(mode), NAME, 5, mode_colour(mode))
            if label:
                panel.items.append(label)
    else:
        figure.add_numbers(panel, room, modes, real, imag, shown)
        figure.add_list(panel, modes)
    return figure.finish(picture)


def _pieces(mask, mode):
    """First and last place of every part of a mask (n), with the mode."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(int), [0]])))
    return [((begin, end - 1), mode) for begin, end in edges.reshape(-1, 2) if end - begin > 2]
